#include "alea/pipeline/measure_checkerboard.hpp"

#include "alea/checkerboard/board_finder.hpp"
#include "alea/sphere/sphere_match.hpp"

namespace alea {
namespace {

Result<std::vector<BoardMeasurement>> all_by_coloured_icp(
    const Cloud& cloud, const MeasureCheckerboardOptions& options) {
  auto found = find_boards(cloud, options.target);
  if (!found) return found;
  std::vector<BoardMeasurement> measured;
  std::optional<Refusal> refusal;
  for (const BoardMeasurement& target : *found) {
    ColouredBoardOptions coloured = options.coloured;
    RigidTransform start;
    start.rotation << target.axes, target.normal;
    start.translation = target.centre_m;
    coloured.start = start;
    auto one = measure_by_coloured_icp(cloud, target.centre_m, options.target, coloured);
    if (one)
      measured.push_back(*one);
    else
      refusal = one.refusal();
  }
  if (measured.empty()) return *refusal;
  return measured;
}

/// A centre with its covariance is what the matching of spheres needs.
std::vector<SphereFit> centres_of(const std::vector<BoardMeasurement>& targets) {
  std::vector<SphereFit> centres;
  for (const BoardMeasurement& target : targets) {
    SphereFit centre;
    centre.centre_m = target.centre_m;
    centre.covariance = target.covariance.value_or(Eigen::Matrix3d::Zero());
    centre.points = target.points;
    centres.push_back(centre);
  }
  return centres;
}

}  // namespace

const char* to_string(BoardMethod method) {
  return method == BoardMethod::likelihood ? "likelihood" : "coloured_icp";
}

Result<std::vector<BoardMeasurement>> measure_checkerboard(
    const Cloud& cloud, const MeasureCheckerboardOptions& options) {
  const bool coloured = options.method == BoardMethod::coloured_icp;
  if (!options.near_m)
    return coloured ? all_by_coloured_icp(cloud, options) : find_boards(cloud, options.target);
  auto one = coloured
                 ? measure_by_coloured_icp(cloud, *options.near_m, options.target, options.coloured)
                 : measure_by_likelihood(cloud, *options.near_m, options.target);
  if (!one) return one.refusal();
  return std::vector{*one};
}

Result<CheckerboardsRegistered> register_checkerboards(const Cloud& master, const Cloud& slave,
                                                       const BoardOptions& target) {
  auto in_master = find_boards(master, target);
  if (!in_master) return in_master.refusal();
  auto in_slave = find_boards(slave, target);
  if (!in_slave) return in_slave.refusal();
  auto match = match_and_register(centres_of(*in_master), centres_of(*in_slave));
  if (!match) {
    Refusal refusal = match.refusal();
    for (std::size_t at; (at = refusal.message.find("sphere")) != std::string::npos;)
      refusal.message.replace(at, 6, "target");
    return refusal;
  }
  CheckerboardsRegistered result;
  result.master_from_slave = match->master_from_slave;
  result.covariance = match->covariance;
  for (const SpherePair& pair : match->pairs) result.pairs.emplace_back(pair.master, pair.slave);
  result.residual_m = match->residual_m;
  result.master = std::move(*in_master);
  result.slave = std::move(*in_slave);
  return result;
}

}  // namespace alea
