#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "alea/core/parallel.hpp"
#include "alea/pipeline/register_die.hpp"
#include "experiments/die/acceptance.hpp"
#include "experiments/die/faulty_scene.hpp"
#include "experiments/engine/wilson.hpp"

namespace alea::acceptance {
namespace {

using experiments::die::draw_faulty_scans;
using experiments::die::Fault;
using experiments::die::fault_names;
using experiments::die::FaultyScans;

/// The refusal's code, or empty where a transform was given.
std::string outcome(Fault fault, std::uint64_t seed, std::uint64_t number) {
  const FaultyScans scans = draw_faulty_scans(fault, seed, number);
  // A station whose window saw nothing has no scan to register.
  if (scans.master.size() == 0 || scans.slave.size() == 0) return "empty_scan";
  DieRegistrationOptions options;
  options.edge_m = scans.edge_m;
  const Registration result = register_die(scans.master, scans.slave, options);
  return result.master_from_slave ? "" : to_string(result.refusal->code);
}

std::vector<std::string> outcomes(Fault fault, std::uint64_t seed, std::uint64_t trials) {
  std::vector<std::string> out(trials);
  parallel_chunks(trials, 1, [&](std::size_t i, std::size_t) {
    out[i] = outcome(fault, seed, i * (fault_names.size() + 1) + static_cast<std::size_t>(fault));
  });
  return out;
}

/// 95 % interval of a share that was met k times in n.
Interval wilson(double k, double n) {
  return wilson_interval(k / n, n, 1.96);
}

void report_codes(const std::vector<std::string>& codes, const Report& report) {
  std::map<std::string, int> counts;
  for (const std::string& code : codes) ++counts[code.empty() ? "registered" : code];
  for (const auto& [code, count] : counts)
    report({fmt::format("  {}", code), 1.0 * count, {}, {}, codes.size(), "", Judgement::shown});
}

}  // namespace

void run_die_refusals(const Options& options, const Report& report) {
  const std::uint64_t all = options.trials_or(1000);
  double transforms = 0;
  for (std::size_t f = 0; f < fault_names.size(); ++f) {
    const std::uint64_t n = all / fault_names.size() + (f < all % fault_names.size() ? 1 : 0);
    if (n == 0) continue;
    const auto codes = outcomes(static_cast<Fault>(f), options.seed, n);
    const auto given = static_cast<double>(std::count(codes.begin(), codes.end(), ""));
    transforms += given;
    const auto total = static_cast<double>(n);
    report({fmt::format("{}: transforms given", fault_names[f]),
            given,
            {wilson(given, total).low * total, wilson(given, total).high * total},
            at_most(0),
            n,
            "",
            Judgement::point});
    report_codes(codes, report);
  }
  report({"all scenes without a valid die: transforms given",
          transforms,
          {wilson(transforms, 1.0 * all).low * all, wilson(transforms, 1.0 * all).high * all},
          at_most(0),
          all,
          "",
          Judgement::point});
  const std::uint64_t controls = std::max<std::uint64_t>(1, all / 10);
  const auto codes = outcomes(Fault::none, options.seed, controls);
  const auto registered = static_cast<double>(std::count(codes.begin(), codes.end(), ""));
  report({"control, the same scenes with a valid die: share registered", registered / controls,
          wilson(registered, 1.0 * controls), at_least(0.95), controls, "", Judgement::point});
  report_codes(codes, report);
}

}  // namespace alea::acceptance
