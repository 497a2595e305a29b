#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "alea/io/atomic_file.hpp"
#include "alea/io/binary_output.hpp"
#include "alea/io/formats.hpp"

namespace alea {
namespace {

constexpr std::uint32_t no_point = std::numeric_limits<std::uint32_t>::max();

// The places of a PTX grid, column by column, and which point stands in each.
struct Grid {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<std::uint32_t> points;
};

// One column in the order of the points, for a cloud without a usable grid of its own.
Grid single_column(const Cloud& cloud) {
  Grid grid{cloud.size(), 1, {}};
  for (std::uint32_t i = 0; i < cloud.size(); ++i) grid.points.push_back(i);
  return grid;
}

// The cloud's own grid where no place is taken twice and at most three of four places are empty.
Grid grid_of(const Cloud& cloud) {
  if (cloud.rows.empty()) return single_column(cloud);
  const auto [row_low, row_high] = std::minmax_element(cloud.rows.begin(), cloud.rows.end());
  const auto [low, high] = std::minmax_element(cloud.columns.begin(), cloud.columns.end());
  if (*row_low < 0 || *low < 0) return single_column(cloud);
  Grid grid{static_cast<std::size_t>(*row_high) + 1, static_cast<std::size_t>(*high) + 1, {}};
  if (grid.rows * grid.columns > 4 * cloud.size()) return single_column(cloud);
  grid.points.assign(grid.rows * grid.columns, no_point);
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    std::uint32_t& place = grid.points[static_cast<std::size_t>(cloud.columns[i]) * grid.rows +
                                       static_cast<std::size_t>(cloud.rows[i])];
    if (place != no_point) return single_column(cloud);
    place = i;
  }
  return grid;
}

void write_scan(AtomicFile& file, const ScanFile& scan) {
  const Cloud& cloud = scan.cloud;
  const Grid grid = grid_of(cloud);
  const bool colour = !cloud.colours.empty();
  std::string out = fmt::format("{}\n{}\n", grid.columns, grid.rows) +
                    ptx_pose_lines(scan.pose.value_or(Eigen::Matrix4d::Identity()));
  for (const std::uint32_t i : grid.points) {
    if (i == no_point) {
      out += colour ? "0 0 0 0.5 0 0 0\n" : "0 0 0 0.5\n";
    } else {
      // 0 0 0 would read as a missing return.
      const Eigen::Vector3d& at = cloud.positions[i];
      const Eigen::Vector3d p = at.isZero(0) ? Eigen::Vector3d(1e-300, 0, 0) : at;
      fmt::format_to(std::back_inserter(out), "{} {} {} {}", p.x(), p.y(), p.z(),
                     cloud.has_intensity() ? cloud.intensity[i] : 0.5F);
      if (colour)
        for (const std::uint16_t value : cloud.colours[i])
          fmt::format_to(std::back_inserter(out), " {}", colour_byte(value));
      out += '\n';
    }
    if (out.size() < (1 << 20)) continue;
    file.write(out);
    out.clear();
  }
  file.write(out);
}

}  // namespace

std::string ptx_pose_lines(const Eigen::Matrix4d& pose) {
  std::string out;
  const auto row = [&](int column, int values) {
    for (int i = 0; i < values; ++i)
      fmt::format_to(std::back_inserter(out), "{}{}", pose(i, column), i + 1 < values ? ' ' : '\n');
  };
  row(3, 3);
  for (int axis = 0; axis < 3; ++axis) row(axis, 3);
  for (int column = 0; column < 4; ++column) row(column, 4);
  return out;
}

void write_ptx(const std::string& path, const std::vector<ScanFile>& scans) {
  AtomicFile file(path);
  for (const ScanFile& scan : scans) write_scan(file, scan);
  file.commit();
}

}  // namespace alea
