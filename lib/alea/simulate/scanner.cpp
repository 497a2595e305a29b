#include "alea/simulate/scanner.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>
#include <utility>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/simulate/ray_caster.hpp"
#include "alea/simulate/scan_noise.hpp"

namespace alea {
namespace {

struct Angle {
  double cosine;
  double sine;
};

std::vector<Angle> angles_of(const AngleRange& range) {
  std::vector<Angle> angles(range.count());
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double angle = range.start_rad + static_cast<double>(i) * range.step_rad;
    angles[i] = {std::cos(angle), std::sin(angle)};
  }
  return angles;
}

/// Points of the unit disc in hexagonal rings about its centre, with the disc's second moment 1/4.
std::vector<Eigen::Vector2d> beam_pattern(int rings) {
  std::vector<Eigen::Vector2d> points{Eigen::Vector2d::Zero()};
  double sum = 0;
  for (int k = 1; k <= rings; ++k) {
    for (int i = 0; i < 6 * k; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.5 * k) / (6 * k);
      points.emplace_back(k * std::cos(angle), k * std::sin(angle));
      sum += k * k;
    }
  }
  const double scale = sum > 0 ? std::sqrt(static_cast<double>(points.size()) / (2 * sum)) : 1;
  for (Eigen::Vector2d& point : points) point *= scale;
  return points;
}

/// The columns in which at least one candidate can be met, as disjoint ascending intervals (ends
/// included).
std::vector<std::pair<std::int64_t, std::int64_t>> covered_columns(
    const std::vector<Candidate>& candidates) {
  std::vector<std::pair<std::int64_t, std::int64_t>> intervals;
  for (const Candidate& c : candidates) intervals.emplace_back(c.first_column, c.last_column);
  std::sort(intervals.begin(), intervals.end());
  std::vector<std::pair<std::int64_t, std::int64_t>> merged;
  for (const auto& interval : intervals) {
    if (merged.empty() || interval.first > merged.back().second + 1)
      merged.push_back(interval);
    else
      merged.back().second = std::max(merged.back().second, interval.second);
  }
  return merged;
}

/// Scans rows of the grid; holds what all rays of a scan share.
class RowScanner {
 public:
  RowScanner(const Scene& scene, const Station& station, const SimulationKey& key)
      : station_(station),
        caster_(scene, station),
        noise_(station.scanner, key),
        columns_(angles_of(station.azimuth)),
        rows_(angles_of(station.elevation)) {
    const Scanner& scanner = station.scanner;
    if (scanner.beam_diameter_m > 0 || scanner.beam_divergence_rad > 0)
      beam_ = beam_pattern(scanner.beam_rings);
  }

  void scan_row(std::int64_t row, bool with_truth, SimulatedScan& out) const {
    const std::vector<Candidate> candidates = caster_.candidates(row);
    for (auto [first, last] : covered_columns(candidates)) {
      while (first <= last && !may_hit(candidates, row, first)) ++first;
      while (first <= last && !may_hit(candidates, row, last)) --last;
      for (std::int64_t column = first; column <= last; ++column)
        measure(candidates, row, column, with_truth, out);
    }
  }

 private:
  /// What the scanner reports of a ray, scan frame.
  Eigen::Vector3d direction(std::int64_t row, std::int64_t column) const {
    const Angle a = columns_[column], e = rows_[row];
    return {e.cosine * a.cosine, e.cosine * a.sine, e.sine};
  }

  bool may_hit(const std::vector<Candidate>& candidates, std::int64_t row,
               std::int64_t column) const {
    const RigidTransform& pose = station_.scene_from_scan;
    return caster_.may_hit(candidates, column,
                           {pose.translation, pose.rotation * direction(row, column)});
  }

  void measure(const std::vector<Candidate>& candidates, std::int64_t row, std::int64_t column,
               bool with_truth, SimulatedScan& out) const {
    const Angle a = columns_[column], e = rows_[row];
    const auto number =
        static_cast<std::uint64_t>(row) * columns_.size() + static_cast<std::uint64_t>(column);
    const Eigen::Vector3d reported = direction(row, column);
    const Eigen::Vector3d to_left(-a.sine, a.cosine, 0);
    const Eigen::Vector3d up(-e.sine * a.cosine, -e.sine * a.sine, e.cosine);
    const Eigen::Vector2d off = noise_.angles_rad(number);
    const Eigen::Matrix3d& turn = station_.scene_from_scan.rotation;
    const Eigen::Vector3d beam =
        (reported + off.x() * e.cosine * to_left + off.y() * up).normalized();
    const Ray centre{station_.scene_from_scan.translation, turn * beam};
    const Hit hit = caster_.cast(candidates, column, centre);
    const Scanner& scanner = station_.scanner;
    if (!(hit.range_m >= scanner.min_range_m && hit.range_m <= scanner.max_range_m)) return;
    double range = hit.range_m, intensity = hit.intensity;
    if (!beam_.empty()) {
      const Echo echo = widened(candidates, column, centre, turn * to_left, turn * up, hit);
      if (scanner.mixed_pixels) range = echo.range_m;
      intensity = echo.intensity;
    }
    const double cosine = std::abs(hit.normal.dot(centre.direction));
    const ScanNoise::Error error = noise_.at(number, hit.range_m, cosine);
    out.cloud.positions.push_back((range + error.range_m) * reported);
    out.cloud.intensity.push_back(static_cast<float>(intensity + error.intensity));
    if (with_truth) out.truth.push_back({hit.surface, hit.range_m, cosine});
  }

  struct Echo {
    double range_m;
    double intensity;
  };

  /// Means over the sub-rays that return.
  Echo widened(const std::vector<Candidate>& candidates, std::int64_t column, const Ray& centre,
               const Eigen::Vector3d& left, const Eigen::Vector3d& up, const Hit& hit) const {
    const Scanner& scanner = station_.scanner;
    Echo sum{hit.range_m, hit.intensity};
    int returns = 1;
    for (std::size_t i = 1; i < beam_.size(); ++i) {
      const Eigen::Vector3d off = beam_[i].x() * left + beam_[i].y() * up;
      const Ray ray{centre.origin + scanner.beam_diameter_m / 2 * off,
                    (centre.direction + scanner.beam_divergence_rad / 2 * off).normalized()};
      const Hit part = caster_.cast(candidates, column, ray);
      if (!(part.range_m <= scanner.max_range_m)) continue;
      sum.range_m += part.range_m;
      sum.intensity += part.intensity;
      ++returns;
    }
    return {sum.range_m / returns, sum.intensity / returns};
  }

  const Station& station_;
  RayCaster caster_;
  ScanNoise noise_;
  std::vector<Angle> columns_, rows_;
  std::vector<Eigen::Vector2d> beam_;
};

void append(SimulatedScan& to, const SimulatedScan& from) {
  to.cloud.positions.insert(to.cloud.positions.end(), from.cloud.positions.begin(),
                            from.cloud.positions.end());
  to.cloud.intensity.insert(to.cloud.intensity.end(), from.cloud.intensity.begin(),
                            from.cloud.intensity.end());
  to.truth.insert(to.truth.end(), from.truth.begin(), from.truth.end());
}

SimulatedScan simulate(const Scene& scene, const Station& station, const SimulationKey& key,
                       bool with_truth, const ProgressCallback& progress) {
  const std::size_t rows = station.elevation.count(), columns = station.azimuth.count();
  if (rows == 0 || columns == 0)
    throw usage_error(fmt::format(
        "station '{}': empty grid; give stop >= start and a positive step", station.name));
  if (static_cast<double>(rows) * static_cast<double>(columns) > 1e9)
    throw usage_error(fmt::format("station '{}': {} x {} rays; widen the step or narrow the window",
                                  station.name, rows, columns));
  const RowScanner scanner(scene, station, key);
  // Chunks depend on the grid alone; their points are joined in the order of the rows.
  const std::size_t chunk = std::max<std::size_t>(1, 16384 / columns);
  std::vector<SimulatedScan> parts((rows + chunk - 1) / chunk);
  std::uint64_t done = 0;
  std::mutex reporting;
  parallel_chunks(rows, chunk, [&](std::size_t begin, std::size_t end) {
    SimulatedScan& part = parts[begin / chunk];
    for (std::size_t row = begin; row < end; ++row)
      scanner.scan_row(static_cast<std::int64_t>(row), with_truth, part);
    if (!progress) return;
    const std::lock_guard lock(reporting);
    done += end - begin;
    progress(station.name, done, rows);
  });
  SimulatedScan scan;
  for (const SimulatedScan& part : parts) append(scan, part);
  scan.cloud.scanner_position = Eigen::Vector3d::Zero();
  return scan;
}

}  // namespace

Cloud simulate_scan(const Scene& scene, const Station& station, const SimulationKey& key,
                    const ProgressCallback& progress) {
  return simulate(scene, station, key, false, progress).cloud;
}

SimulatedScan simulate_scan_with_truth(const Scene& scene, const Station& station,
                                       const SimulationKey& key, const ProgressCallback& progress) {
  return simulate(scene, station, key, true, progress);
}

}  // namespace alea
