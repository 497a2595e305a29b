#include "experiments/engine/acceptance.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "alea/core/parallel.hpp"
#include "experiments/command/command.hpp"

namespace alea::command {
namespace {

struct AcceptanceOptions {
  CommonOptions common;
  std::string topic = "all";
  std::uint64_t trials = 0;
};

nlohmann::json to_json(const acceptance::Cell& cell) {
  return {{"name", cell.name},
          {"value", cell.value},
          {"unit", cell.unit},
          {"interval", {cell.interval.low, cell.interval.high}},
          {"limit", {cell.limit.low, cell.limit.high}},  // null: none on that side
          {"pass", cell.passes()},
          {"judged", cell.judgement != acceptance::Judgement::shown},
          {"n", cell.n}};
}

int run_acceptance(const AcceptanceOptions& options) {
  const ThreadLimit threads(options.common.threads);
  nlohmann::json cells = nlohmann::json::array();
  int failed = 0;
  for (const acceptance::Topic& topic : acceptance::topics_named(options.topic)) {
    fmt::print("# {}.{}: {}\n", topic.issue, topic.name, topic.what);
    const auto start = std::chrono::steady_clock::now();
    topic.run({options.trials, options.common.seed}, [&](const acceptance::Cell& cell) {
      fmt::print("{}\n", acceptance::to_line(cell));
      std::fflush(stdout);
      cells.push_back(to_json(cell));
      cells.back()["topic"] = topic.issue + "." + topic.name;
      if (!cell.passes()) ++failed;
    });
    fmt::print("# {:.1f} s\n",
               std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  write_json(options.common, {{"cells", cells}, {"failed", failed}});
  fmt::print("acceptance {}: {} of {} cells failed\n", options.topic, failed, cells.size());
  return failed == 0 ? exit_done : exit_failed;
}

}  // namespace

void add_acceptance(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<AcceptanceOptions>();
  CLI::App* sub = app.add_subcommand(
      "acceptance", "Run acceptance experiments: one line a number, exit 1 where one fails");
  sub->group("");  // not part of what a user needs, so not in the list of --help
  sub->add_option("topic", options->topic, "all, an issue (die, ...) or one topic")
      ->capture_default_str();
  sub->add_option("--trials", options->trials, "Trials a cell (0: as the acceptance line says)")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  add_common_options(*sub, options->common);
  sub->callback([options, &exit_code] { exit_code = run_acceptance(*options); });
}

}  // namespace alea::command
