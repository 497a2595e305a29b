#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "alea/core/parallel.hpp"
#include "alea/core/seed.hpp"
#include "alea/pipeline/register_die.hpp"
#include "experiments/die/acceptance.hpp"
#include "experiments/die/faulty_scene.hpp"
#include "experiments/engine/shuffled_order.hpp"

namespace alea::acceptance {
namespace {

using experiments::die::draw_faulty_scans;
using experiments::die::Fault;
using experiments::die::FaultyScans;

Cloud shuffled(const Cloud& cloud, std::uint64_t seed, std::uint64_t number) {
  const RandomStream stream({seed, 26, number, 0, Purpose::experiment});
  return subset(cloud, experiments::shuffled_order(cloud.size(), stream));
}

/// Every number of a registration; compared bit by bit.
std::vector<double> numbers_of(const Registration& r) {
  std::vector<double> out;
  const auto add = [&out](const auto& matrix) {
    for (Eigen::Index k = 0; k < matrix.size(); ++k) out.push_back(matrix.reshaped()[k]);
  };
  if (!r.master_from_slave) return out;
  add(r.master_from_slave->matrix());
  if (r.covariance) add(r.covariance->covariance), add(r.covariance->about_m);
  if (r.ambiguity) out.push_back(r.ambiguity->log_likelihood_margin);
  for (const FacetReport& facet : r.die->facets) {
    add(facet.plane.normal);
    out.insert(out.end(), {facet.plane.offset_m, facet.rmse_m, facet.pip_probability,
                           static_cast<double>(facet.points)});
  }
  for (const CheckPlane& plane : r.check_planes) {
    add(plane.centroid_m), add(plane.normal);
    out.insert(out.end(), {plane.alone_master_m, plane.alone_slave_m, plane.union_m,
                           plane.slave_to_master_m, plane.offset_m, plane.tilt_rad});
  }
  return out;
}

std::vector<double> register_with(int threads, const Cloud& master, const Cloud& slave,
                                  const DieRegistrationOptions& options) {
  const ThreadLimit limit(threads);
  return numbers_of(register_die(master, slave, options));
}

/// How often a repetition departs from the first run, by what was changed.
struct Departures {
  double again = 0, threads = 0, order = 0, registered = 0;
};

Departures repeat(PlaneDetector detector, std::uint64_t seed, std::uint64_t trials) {
  Departures out;
  for (std::uint64_t trial = 0; trial < trials; ++trial) {
    const FaultyScans scans = draw_faulty_scans(Fault::none, seed, trial);
    DieRegistrationOptions options;
    options.edge_m = scans.edge_m;
    options.planes = detector;
    const auto first = register_with(1, scans.master, scans.slave, options);
    out.registered += first.empty() ? 0 : 1;
    out.again += register_with(1, scans.master, scans.slave, options) != first;
    out.threads += register_with(2, scans.master, scans.slave, options) != first;
    out.order += register_with(2, shuffled(scans.master, seed, trial),
                               shuffled(scans.slave, seed, trial + trials), options) != first;
  }
  return out;
}

}  // namespace

void run_repeatability(const Options& options, const Report& report) {
  const std::uint64_t trials = options.trials_or(20);
  for (const PlaneDetector detector :
       {PlaneDetector::cells, PlaneDetector::ndt_ransac, PlaneDetector::efficient_ransac,
        PlaneDetector::region_growing}) {
    const Departures found = repeat(detector, options.seed, trials);
    const auto count = [&](const char* what, double value, const Limit& limit, Judgement judged) {
      report({fmt::format("{}: {}", to_string(detector), what),
              value,
              {value, value},
              limit,
              trials,
              "",
              judged});
    };
    count("registered", found.registered, {}, Judgement::shown);
    count("another run differs in a bit", found.again, at_most(0), Judgement::point);
    count("two threads differ in a bit", found.threads, at_most(0), Judgement::point);
    count("shuffled points differ in a bit", found.order, at_most(0), Judgement::point);
  }
}

}  // namespace alea::acceptance
