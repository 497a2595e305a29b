#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace alea {

/// Four rows of four numbers as the program writes a transform.
inline Eigen::Matrix4d matrix_of(const nlohmann::json& rows) {
  Eigen::Matrix4d matrix;
  for (int i = 0; i < 16; ++i) matrix(i / 4, i % 4) = rows[i / 4][i % 4];
  return matrix;
}

}  // namespace alea
