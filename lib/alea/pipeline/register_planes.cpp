#include "alea/pipeline/register_planes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "alea/cloud/canonical_order.hpp"
#include "alea/core/parallel.hpp"
#include "alea/evaluate/check_planes.hpp"
#include "alea/pipeline/check_plane_roles.hpp"
#include "alea/pipeline/plane_hypotheses.hpp"
#include "alea/pipeline/plane_solution.hpp"
#include "alea/pipeline/stopwatch.hpp"
#include "alea/transform/reference_point.hpp"

namespace alea {
namespace {

constexpr int rounds = 3;  // of pairing and solving
// Lead in common points that settles it; where a rival joins as many planes, less one, the
// stations' places alone change the counts by more than half, so it takes more.
constexpr double clear_lead = 1.25, clear_lead_over_like = 2;

struct ScanPlanes {
  Cloud cloud;
  std::vector<PlaneRegion> regions;
};

ScanPlanes planes_of(const Cloud& scan, const PlaneRegistrationOptions& options) {
  ScanPlanes out;
  out.cloud = canonical_order(scan);
  if (!out.cloud.scanner_position) out.cloud.scanner_position = Eigen::Vector3d(0, 0, 0);
  out.regions = detect_planes(out.cloud, {.detector = options.planes, .seed = options.seed});
  return out;
}

struct Solved {
  std::vector<CommonPlane> planes;
  std::vector<CheckPlaneRole> roles;
  PlaneSolution solution;
  double points = 0;  ///< that speak for it
};

/// Pairs planes and solves, in turns, from one start.
Result<Solved> solve_from(const ScanPlanes& master, const ScanPlanes& slave,
                          const RigidTransform& start, const PlaneRegistrationOptions& options) {
  Solved out;
  out.solution.master_from_slave = start;
  for (int round = 0; round < rounds; ++round) {
    out.planes = find_common_planes(master.cloud, master.regions, slave.cloud, slave.regions,
                                    out.solution.master_from_slave);
    out.roles = options.check_plane_centroids_m.empty()
                    ? std::vector(out.planes.size(), CheckPlaneRole::calibration)
                    : named_check_planes(out.planes, options.check_plane_centroids_m);
    const Result<PlaneSolution> solution =
        solve_planes(planes_with_role(out.planes, out.roles, CheckPlaneRole::calibration),
                     out.solution.master_from_slave);
    if (!solution) return solution.refusal();
    out.solution = *solution;
  }
  for (const CommonPlane& plane : out.planes)
    out.points +=
        static_cast<double>(std::min(plane.indices_master.size(), plane.indices_slave.size()));
  return out;
}

bool same_solution(const Solved& a, const Solved& b) {
  const Vector6d change = left_difference(
      a.solution.master_from_slave, b.solution.master_from_slave, a.solution.covariance.about_m);
  return change.head<3>().norm() < 0.01 && change.tail<3>().norm() < 0.05;
}

/// Whether the data support another transform about as well as the best.
bool rivals(const Solved& best, const Solved& other) {
  const bool alike = other.planes.size() + 1 >= best.planes.size();
  return !same_solution(best, other) &&
         best.points < (alike ? clear_lead_over_like : clear_lead) * other.points;
}

/// The best of the transforms that the planes' angles allow.
Result<Solved> solve_by_search(const ScanPlanes& master, const ScanPlanes& slave,
                               const PlaneRegistrationOptions& options) {
  std::vector<Solved> solved;
  std::optional<Refusal> refusal;
  // Check planes are named in the master frame of the right transform: a wrong one need not have
  // them.
  PlaneRegistrationOptions every_plane = options;
  every_plane.check_plane_centroids_m.clear();
  for (const PlaneHypothesis& hypothesis : plane_hypotheses(master.regions, slave.regions)) {
    Result<Solved> candidate = solve_from(master, slave, hypothesis.master_from_slave, every_plane);
    if (candidate)
      solved.push_back(*std::move(candidate));
    else if (!refusal)
      refusal = candidate.refusal();
  }
  if (solved.empty())
    return refusal.value_or(Refusal{
        RefusalCode::no_match,
        fmt::format("no three planes of the scans ({} and {}) have the same angles between them; "
                    "give --initial FILE",
                    master.regions.size(), slave.regions.size())});
  std::stable_sort(solved.begin(), solved.end(),
                   [](const Solved& a, const Solved& b) { return a.points > b.points; });
  for (std::size_t i = 1; i < solved.size(); ++i)
    if (rivals(solved[0], solved[i]))
      return Refusal{RefusalCode::ambiguous_target,
                     "two transforms make the planes agree about as well (a room looks the same "
                     "when it is turned); give --initial FILE"};
  if (options.check_plane_centroids_m.empty()) return std::move(solved[0]);
  return solve_from(master, slave, solved[0].solution.master_from_slave, options);
}

}  // namespace

Registration register_planes(const Cloud& master_scan, const Cloud& slave_scan,
                             const PlaneRegistrationOptions& options) {
  Stopwatch total, watch;
  Registration out;
  out.method = "planes";
  ScanPlanes master, slave;
  parallel_pair([&] { master = planes_of(master_scan, options); },
                [&] { slave = planes_of(slave_scan, options); });
  out.timing_s.emplace_back("planes", watch.lap_s());
  const Result<Solved> solved = options.initial
                                    ? solve_from(master, slave, *options.initial, options)
                                    : solve_by_search(master, slave, options);
  out.timing_s.emplace_back("transform", watch.lap_s());
  if (solved) {
    out.master_from_slave = solved->solution.master_from_slave;
    const TransformCovariance& covariance = solved->solution.covariance;
    out.covariance = moved_to(covariance, reference_point(covariance.about_m));
    for (std::size_t i = 0; i < solved->planes.size(); ++i) {
      out.check_planes.push_back(evaluate_check_plane(master.cloud, slave.cloud, solved->planes[i],
                                                      *out.master_from_slave));
      out.check_planes.back().role = solved->roles[i];
    }
    if (options.check_plane_centroids_m.empty())
      out.warnings.push_back(
          "no_check_planes: every plane took part in the solution, so their residuals prove "
          "nothing; hold some out with --check-planes");
  } else {
    out.refusal = solved.refusal();
  }
  out.timing_s.emplace_back("total", total.lap_s());
  return out;
}

}  // namespace alea
