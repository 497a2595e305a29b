#include "alea/pipeline/register_die.hpp"

#include <fmt/format.h>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/pipeline/die_joint.hpp"
#include "alea/pipeline/die_stages.hpp"
#include "alea/pipeline/slave_run.hpp"
#include "alea/pipeline/stopwatch.hpp"

namespace alea {
namespace {

void require_intensity(const Cloud& cloud, const char* scan) {
  if (!cloud.has_intensity())
    throw input_error(fmt::format(
        "{}: no intensity, so the pips cannot be read; give a scan with intensity", scan));
}

/// One slave before the scans are adjusted together.
void run_pair(const std::vector<Observed>& observed, std::size_t slave,
              const DieRegistrationOptions& options, SlaveRun& run, Registration& out) {
  add_sighting_notes(observed[0].sighting, observed[slave].sighting, out);
  run.refusal = sighting_refusal(observed[0].sighting, observed[slave].sighting);
  Stopwatch watch;
  if (!run.refusal) choose_pair(observed[0], observed[slave], observed.size() > 2, options, run);
  if (run.refusal)
    out.ambiguity =
        open_orientations(observed[0].sighting, observed[slave].sighting, options.levelled);
  if (!run.pair) return;
  out.timing_s.emplace_back("transform", watch.lap_s());
}

void run_calibration(const std::vector<Observed>& observed, std::size_t slave,
                     const DieRegistrationOptions& options, SlaveRun& run, Registration& out) {
  if (!run.pair || run.tied_by_others) return;
  Stopwatch watch;
  find_planes(observed[0], observed[slave], options, run);
  if (options.calibrate) calibrate(observed[0], observed[slave], options, run);
  out.timing_s.emplace_back("calibration", watch.lap_s());
}

/// What `register_die` found of every slave.
struct AllRuns {
  std::vector<Observed> observed;
  std::vector<SlaveRun> runs;
  std::vector<Registration> results;
};

AllRuns register_all(const Cloud& master, std::span<const Cloud> slaves,
                     const DieRegistrationOptions& options) {
  require_intensity(master, "master");
  for (const Cloud& slave : slaves) require_intensity(slave, "slave");
  Stopwatch total, watch;
  AllRuns all{observe_all(master, slaves, options), std::vector<SlaveRun>(slaves.size()),
              std::vector<Registration>(slaves.size())};
  const auto each = [&](auto stage) {
    parallel_chunks(slaves.size(), 1, [&](std::size_t r, std::size_t) {
      stage(all.observed, r + 1, options, all.runs[r], all.results[r]);
    });
  };
  each(run_pair);
  const bool together = options.method == DieMethod::adjustment;
  if (together) agree_on_one_die(all.observed, options, all.runs);
  each(run_calibration);
  watch.lap_s();
  if (together) adjust_together(all.runs, options);
  const double adjustment_s = watch.lap_s();
  each([&](const auto& observed, std::size_t slave, const auto&, SlaveRun& run, Registration& out) {
    out.method = to_string(options.method);
    if (together) out.timing_s.emplace_back("adjustment", adjustment_s);
    out.refusal = run.refusal;
    if (!run.refusal) conclude(observed[0], observed[slave], options, run, out);
  });
  const double total_s = total.lap_s();
  for (Registration& out : all.results) out.timing_s.emplace_back("total", total_s);
  return all;
}

}  // namespace

const char* to_string(DieMethod method) {
  switch (method) {
    case DieMethod::paper:
      return "paper";
    case DieMethod::paper_literal:
      return "paper_literal";
    case DieMethod::closed_form:
      return "closed_form";
    case DieMethod::adjustment:
      return "adjustment";
  }
  return "unknown";
}

bool is_published(DieMethod method) {
  return method == DieMethod::paper || method == DieMethod::paper_literal;
}

std::vector<StagedDieRegistration> register_die_in_stages(const Cloud& master,
                                                          std::span<const Cloud> slaves,
                                                          const DieRegistrationOptions& options) {
  AllRuns all = register_all(master, slaves, options);
  std::vector<StagedDieRegistration> staged(slaves.size());
  for (std::size_t r = 0; r < slaves.size(); ++r) {
    DieStages& stages = staged[r].stages;
    stages.master = all.observed[0].cloud;
    stages.of_master = all.observed[0].sighting;
    stages.slave = std::move(all.observed[r + 1].cloud);
    stages.of_slave = std::move(all.observed[r + 1].sighting);
    stages.pair = std::move(all.runs[r].pair);
    stages.planes = std::move(all.runs[r].planes);
    staged[r].registration = std::move(all.results[r]);
  }
  return staged;
}

std::vector<Registration> register_die(const Cloud& master, std::span<const Cloud> slaves,
                                       const DieRegistrationOptions& options) {
  return register_all(master, slaves, options).results;
}

Registration register_die(const Cloud& master, const Cloud& slave,
                          const DieRegistrationOptions& options) {
  return register_die(master, std::span(&slave, 1), options).front();
}

}  // namespace alea
