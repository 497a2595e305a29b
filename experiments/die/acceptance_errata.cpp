#include <fmt/format.h>

#include <cmath>
#include <string>

#include "alea/core/angle.hpp"
#include "alea/die/paper_registration.hpp"
#include "experiments/die/acceptance.hpp"
#include "experiments/die/skewed_die.hpp"

namespace alea::acceptance {
namespace {

using experiments::die::draw_skewed_die;
using experiments::die::pose_error;
using experiments::die::PoseError;
using experiments::die::SkewedDie;
using experiments::die::SkewedDieOptions;

/// A misprint with the damage that the study's section 3 prints for it at 90 and 180 deg.
struct Misprint {
  std::string name;
  PrintedErrors errors;
  std::array<double, 2> rotation_deg;
  std::array<double, 2> at_die_mm;
};

PrintedErrors only(bool PrintedErrors::*error, bool direct) {
  PrintedErrors errors;
  errors.*error = true;
  errors.direct_pairing = direct;
  return errors;
}

std::vector<Misprint> misprints() {
  return {
      {"corrected", {}, {0, 0}, {0, 0}},
      {"(3) left-handed, scanner to scanner",
       only(&PrintedErrors::left_handed_axes, true),
       {180, 0},
       {707, 1000}},
      {"(3) left-handed, two fits",
       only(&PrintedErrors::left_handed_axes, false),
       {96, 141},
       {1269, 1795}},
      {"(5), (8) without the corner",
       only(&PrintedErrors::no_corner, false),
       {0, 0},
       {9464, 13228}},
      {"(4) turns the wrong way", only(&PrintedErrors::reversed_turn, false), {180, 0}, {707, 0}},
      {"(7) offset of opposite stations",
       only(&PrintedErrors::opposite_offset, false),
       {0, 0},
       {500, 0}},
  };
}

PoseError damage(const SkewedDie& die, const PrintedErrors& errors) {
  PaperRegistrationOptions options;
  options.dimensions = {0.5, 0.5, 0.5};
  options.up_pips = 1;
  options.errors = errors;
  return pose_error((*register_paper(die.master, die.slave, options)).master_from_slave, die);
}

Cell exact_cell(const std::string& name, double value, const std::string& unit) {
  Cell cell;
  cell.name = name;
  cell.value = value;
  cell.interval = {value, value};
  cell.n = 1;
  cell.unit = unit;
  return cell;
}

}  // namespace

void run_errata(const Options&, const Report& report) {
  for (int k = 0; k < 2; ++k) {
    SkewedDieOptions geometry;
    geometry.separation_rad = (k + 1) * 90 * deg;
    geometry.distance_m = {6, 8};
    const SkewedDie die = draw_skewed_die(geometry, 1, 0);
    for (const Misprint& misprint : misprints()) {
      const PoseError error = damage(die, misprint.errors);
      const std::string name = fmt::format("{} deg: {}", (k + 1) * 90, misprint.name);
      Cell rotation = exact_cell(name, error.rotation_rad / deg, "deg");
      rotation.limit = within(misprint.rotation_deg[k], 0.5);
      report(rotation);
      Cell shift = exact_cell("  displacement at the die", error.at_die_m * 1e3, "mm");
      // Without the corner the damage is the distance to it: where the stations stood is not said.
      const bool by_distance = misprint.errors.no_corner;
      shift.limit = within(misprint.at_die_mm[k], by_distance ? 0.01 * misprint.at_die_mm[k] : 0.6);
      report(shift);
    }
    const PoseError literal = damage(die, PrintedErrors::as_printed());
    Cell rotation = exact_cell(fmt::format("{} deg: all as printed", (k + 1) * 90),
                               literal.rotation_rad / deg, "deg");
    rotation.judgement = Judgement::shown;
    report(rotation);
    Cell shift = exact_cell("  displacement at the die", literal.at_die_m * 1e3, "mm");
    shift.judgement = Judgement::shown;
    report(shift);
  }
}

}  // namespace alea::acceptance
