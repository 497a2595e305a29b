#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "alea/core/error.hpp"
#include "alea/core/seed.hpp"
#include "alea/io/cloud_file.hpp"

namespace alea::testing {

/// A cloud with every array, far from the origin; rows and columns are a grid of seven columns.
inline Cloud full_cloud(std::size_t n, bool wide_colours) {
  RandomStream random({4, 0, 0, 0, Purpose::test});
  Cloud cloud;
  for (std::size_t i = 0; i < n; ++i) {
    cloud.positions.emplace_back(5e5 + random.normal(), 5e6 + random.normal(), random.normal());
    cloud.intensity.push_back(static_cast<float>(random.uniform()));
    cloud.normals.push_back(Eigen::Vector3d(random.normal(), random.normal(), random.normal())
                                .normalized()
                                .cast<float>());
    Colour colour{};
    for (std::uint16_t& value : colour)
      value =
          static_cast<std::uint16_t>(wide_colours ? random.below(65536) : random.below(256) * 257);
    cloud.colours.push_back(colour);
    cloud.rows.push_back(static_cast<int>(i / 7));
    cloud.columns.push_back(static_cast<int>(i % 7));
  }
  return cloud;
}

inline void expect_same(const Cloud& a, const Cloud& b) {
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.intensity, b.intensity);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.colours, b.colours);
  EXPECT_EQ(a.rows, b.rows);
  EXPECT_EQ(a.columns, b.columns);
}

/// The message of the Error(input) that reading a file throws.
inline std::string error_of(const std::string& path, const ReadOptions& options = {}) {
  try {
    read_cloud(path, options);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    return error.what();
  }
  return "no error";
}

}  // namespace alea::testing
