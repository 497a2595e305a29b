#include "experiments/die/errata.hpp"

#include "experiments/die/acceptance.hpp"

namespace alea::experiments::die {
namespace {

// The acceptance topics already compute these numbers; here they stand as a table. A name that
// begins with blanks goes on with the row above.
ResultTable table_of(ResultTable table,
                     void (*topic)(const acceptance::Options&, const acceptance::Report&),
                     const acceptance::Options& options) {
  std::string row;
  topic(options, [&](const acceptance::Cell& cell) {
    const bool continued = cell.name.starts_with("  ");
    if (!continued) row = cell.name;
    const Interval ours{cell.interval.low, cell.value, cell.interval.high};
    table.cells.push_back({row, continued ? cell.name.substr(2) : "rotation", cell.unit, "", ours,
                           Verdict::ours, ""});
  });
  return table;
}

}  // namespace

ResultTable errata_table(std::uint64_t seed) {
  return table_of({"errata",
                   "Errata: what each misprint does to a perfect die",
                   "Half a metre, stations at 6 and 8 m, no noise.",
                   {}},
                  acceptance::run_errata, {1, seed});
}

ResultTable frame_rule_table(std::uint64_t dice, std::uint64_t seed) {
  return table_of({"frame_rules",
                   "What the rule of the frame leaks of a die's tilts",
                   "Median over noise-free dice and its 95 % interval.",
                   {}},
                  acceptance::run_leak, {dice, seed});
}

}  // namespace alea::experiments::die
