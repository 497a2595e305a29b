#include <fmt/format.h>

#include <cmath>

#include "alea/core/angle.hpp"
#include "alea/core/parallel.hpp"
#include "alea/die/closed_form.hpp"
#include "alea/die/ideal_observation.hpp"
#include "alea/die/paper_registration.hpp"
#include "alea/evaluate/fisher_bound.hpp"
#include "experiments/die/skewed_die.hpp"
#include "experiments/die/statements.hpp"

namespace alea::experiments::die {
namespace {

std::optional<RigidTransform> by_paper(const SkewedDie& die) {
  PaperRegistrationOptions options;
  options.dimensions = {0.5, 0.5, 0.5, 0};
  const auto result = register_paper(die.master, die.slave, options);
  return result ? std::optional(result->master_from_slave) : std::nullopt;
}

std::optional<RigidTransform> by_closed_form(const SkewedDie& die) {
  ClosedFormOptions options;
  options.edge_m = die.shared_edge_m;
  const auto result = register_closed_form(die.master, die.slave, options);
  return result ? std::optional(result->master_from_slave) : std::nullopt;
}

using Estimate = std::optional<RigidTransform> (*)(const SkewedDie&);

// Lets the slave see the corner opposite to the master's, in the die's own frame: no facet shared.
void show_opposite_corner(SkewedDie& die) {
  std::array<int, 3> pips{};
  for (int k = 0; k < 3; ++k) pips[k] = opposite_pips(die.master.facets[2 - k].pips);
  die.slave = observe_exactly(die.shape, pips, {});
  ClosedFormOptions options;
  options.shape = die.shape;
  die.master_from_slave = (*register_closed_form(die.master, die.slave, options)).master_from_slave;
  die.shared_edge_m.reset();
}

// Rotation errors (deg) of noise-free dice; refused ones are counted apart.
struct Rotations {
  std::vector<double> angles_deg;
  std::size_t refused = 0;
};

Rotations rotations(const SkewedDieOptions& geometry, Estimate estimate, std::size_t dice,
                    std::uint64_t seed, bool opposite_corner = false) {
  std::vector<double> angles(dice, std::nan(""));
  parallel_chunks(dice, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t trial = begin; trial < end; ++trial) {
      SkewedDie die = draw_skewed_die(geometry, seed, trial);
      if (opposite_corner) show_opposite_corner(die);
      const auto transform = estimate(die);
      if (transform) angles[trial] = pose_error(*transform, die).rotation_rad / deg;
    }
  });
  Rotations result;
  for (const double angle : angles) {
    if (std::isfinite(angle))
      result.angles_deg.push_back(angle);
    else
      ++result.refused;
  }
  return result;
}

Cell rotation_cell(const std::string& row, const std::string& column, const Rotations& rotations,
                   double accepted_deg) {
  Cell cell{row, column, "deg", "0", std::nullopt, Verdict::differs, ""};
  if (rotations.angles_deg.empty()) {
    cell.note = "refused: one shared facet or none needs a known shape";
    cell.verdict = Verdict::ours;
    return cell;
  }
  cell.ours = central_interval(rotations.angles_deg);
  cell.verdict = cell.ours->high <= accepted_deg ? Verdict::agrees : Verdict::differs;
  return cell;
}

// "The quality of the die's manufacture is not a factor": noise-free, so every degree is the die's.
void add_quality_cells(std::size_t dice, std::uint64_t seed, std::vector<Cell>& cells) {
  for (const double tilt_deg : {0.1, 0.25, 0.5, 1.0}) {
    SkewedDieOptions geometry;
    geometry.tilt_sd_rad = tilt_deg * deg;
    const std::string row = fmt::format("facet tilts of {:g} deg", tilt_deg);
    cells.push_back(rotation_cell(row, "manufacture is not a factor: rotation, equations 1-8",
                                  rotations(geometry, by_paper, dice, seed), 0.005));
    cells.push_back(rotation_cell(row, "manufacture is not a factor: rotation, closed form",
                                  rotations(geometry, by_closed_form, dice, seed), 0.005));
  }
}

// "No overlapping facets needed": one shared facet, and none, against two.
void add_overlap_cells(std::size_t dice, std::uint64_t seed, std::vector<Cell>& cells) {
  struct Case {
    const char* name;
    double separation_deg;
    bool opposite_corner;
  };
  for (const Case& one :
       {Case{"two facets shared", 90, false}, Case{"one facet shared", 180, false},
        Case{"no facet shared", 90, true}}) {
    SkewedDieOptions geometry;
    geometry.tilt_sd_rad = 0.4 * deg;
    geometry.separation_rad = one.separation_deg * deg;
    cells.push_back(rotation_cell(one.name, "no overlap needed: rotation, equations 1-8",
                                  rotations(geometry, by_paper, dice, seed, one.opposite_corner),
                                  0.005));
    cells.push_back(
        rotation_cell(one.name, "no overlap needed: rotation, closed form",
                      rotations(geometry, by_closed_form, dice, seed, one.opposite_corner), 0.005));
  }
}

// "Up to about twelve metres", "approximately 6 m": the bound at those ranges; the paper states no
// accuracy that would make a range effective.
void add_range_cells(std::vector<Cell>& cells) {
  struct Die {
    double edge_m;
    const char* printed;
    double range_m;
  };
  for (const Die& die : {Die{0.5, "12", 12}, Die{0.3, "6", 6}}) {
    DieBoundCase geometry;
    geometry.edge_m = die.edge_m;
    geometry.range_m = die.range_m;
    geometry.shape_known = false;
    const double ring_mm = 1e3 * die_bound(geometry).ring10_m;
    cells.push_back({fmt::format("{:g} m die", die.edge_m),
                     fmt::format("effective to {} m: bound on a ring of 10 m there", die.printed),
                     "mm", die.printed + std::string(" m"), Interval{ring_mm, ring_mm, ring_mm},
                     Verdict::undecidable,
                     "depends on the accuracy that makes a range effective; 0.3 mrad assumed"});
  }
}

}  // namespace

ResultTable shape_statements(std::size_t dice, std::uint64_t seed) {
  ResultTable table{"shape_statements", "Statements of the text against exact dice", "", {}};
  table.note = fmt::format("{} noise-free dice a cell, stations at 6 m", dice);
  add_quality_cells(dice, seed, table.cells);
  add_overlap_cells(dice, seed, table.cells);
  add_range_cells(table.cells);
  return table;
}

}  // namespace alea::experiments::die
