#include "experiments/engine/sweep_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "alea/core/error.hpp"
#include "alea/io/toml_table.hpp"

namespace alea::experiments {
namespace {

constexpr std::int64_t most_trials = 1'000'000'000;
constexpr std::uint64_t most_cells = 100'000;

std::string expectation_of(const SweepParameter& parameter) {
  if (!parameter.words.empty()) return fmt::format("of {}", fmt::join(parameter.words, ", "));
  return fmt::format("from {:g} to {:g}", parameter.low, parameter.high);
}

const SweepParameter* find(const SweepExperiment& experiment, const std::string& name) {
  const auto& all = experiment.parameters;
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& p) { return p.name == name; });
  return found == all.end() ? nullptr : &*found;
}

bool allowed(const SweepParameter& parameter, const SweepValue& value) {
  if (value.index() != parameter.value.index()) return false;
  if (const auto* const number = std::get_if<double>(&value))
    return *number >= parameter.low && *number <= parameter.high;
  return std::find(parameter.words.begin(), parameter.words.end(), std::get<std::string>(value)) !=
         parameter.words.end();
}

SweepSettings read_base(const TomlTable& file, const SweepExperiment& experiment) {
  SweepSettings base;
  const auto table = file.table("base");
  for (const SweepParameter& parameter : experiment.parameters) {
    SweepValue value = parameter.value;
    if (table && table->has(parameter.name)) {
      if (const auto* const number = std::get_if<double>(&parameter.value))
        value = table->number(parameter.name, *number);
      else
        value = table->text(parameter.name, "");
      if (!allowed(parameter, value)) table->fail(parameter.name, expectation_of(parameter));
    }
    base[parameter.name] = value;
  }
  if (table) table->finish();
  return base;
}

std::vector<SweepValue> read_values(const TomlTable& table, const std::string& key,
                                    const SweepParameter& parameter) {
  std::vector<SweepValue> values;
  if (std::holds_alternative<double>(parameter.value)) {
    for (const double number : table.numbers(key)) values.emplace_back(number);
  } else {
    for (const std::string& word : table.texts(key)) values.emplace_back(word);
  }
  if (values.empty()) table.fail(key, "at least one value");
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!allowed(parameter, values[i])) table.fail(key, "values " + expectation_of(parameter));
    if (std::count(values.begin(), values.end(), values[i]) > 1) table.fail(key, "no value twice");
  }
  return values;
}

std::vector<SweepAxis> read_axes(const TomlTable& file, const SweepExperiment& experiment,
                                 bool smoke) {
  std::vector<SweepAxis> axes;
  std::set<std::string> names;
  for (const TomlTable& table : file.tables("axis")) {
    table.require("name");
    table.require("values");
    const std::string name = table.text("name", "");
    const SweepParameter* const parameter = find(experiment, name);
    if (parameter == nullptr || !names.insert(name).second)
      table.fail("name",
                 fmt::format("a parameter of the experiment '{}', each once", experiment.name));
    std::vector<SweepValue> values = read_values(table, "values", *parameter);
    if (table.has("smoke_values")) {
      std::vector<SweepValue> few = read_values(table, "smoke_values", *parameter);
      if (smoke) values = std::move(few);
    }
    table.finish();
    axes.push_back({name, std::move(values)});
  }
  return axes;
}

std::vector<std::string> read_estimators(const TomlTable& file, const SweepExperiment& experiment) {
  const std::vector<std::string> estimators = file.texts("estimators");
  const auto& known = experiment.estimators;
  std::set<std::string> seen;
  bool right = !estimators.empty();
  for (const std::string& name : estimators)
    right = right && std::find(known.begin(), known.end(), name) != known.end() &&
            seen.insert(name).second;
  if (!right)
    file.fail("estimators", fmt::format("at least one of {}, each once", fmt::join(known, ", ")));
  return estimators;
}

/// Values that are allowed one by one may still not go together.
void check_cells(const SweepSpec& spec, const SweepExperiment& experiment,
                 const std::filesystem::path& path) {
  if (experiment.check == nullptr) return;
  for (std::uint64_t cell = 0; cell < spec.cells(); ++cell) {
    try {
      experiment.check(spec.settings(cell));
    } catch (const Error& error) {
      throw input_error(fmt::format("{}: cell {}: {}", path.string(), cell, error.what()));
    }
  }
}

}  // namespace

std::uint64_t SweepSpec::cells() const {
  std::uint64_t count = 1;
  for (const SweepAxis& axis : axes) count *= axis.values.size();
  return count;
}

std::vector<SweepValue> SweepSpec::axis_values(std::uint64_t cell) const {
  std::vector<SweepValue> values(axes.size());
  for (std::size_t a = axes.size(); a-- > 0;) {
    values[a] = axes[a].values[cell % axes[a].values.size()];
    cell /= axes[a].values.size();
  }
  return values;
}

SweepSettings SweepSpec::settings(std::uint64_t cell) const {
  SweepSettings settings = base;
  const std::vector<SweepValue> values = axis_values(cell);
  for (std::size_t a = 0; a < axes.size(); ++a) settings[axes[a].name] = values[a];
  return settings;
}

SweepSpec load_sweep(const std::filesystem::path& path, bool smoke) {
  const TomlTable file = TomlTable::read(path);
  for (const char* const key : {"schema", "name", "experiment", "estimators", "trials"})
    file.require(key);
  if (file.integer("schema", sweep_schema, 0, 1'000'000) != sweep_schema)
    file.fail("schema", fmt::format("{}, the version that this program reads", sweep_schema));
  SweepSpec spec;
  spec.smoke = smoke;
  spec.name = file.text("name", "");
  const bool plain = std::all_of(spec.name.begin(), spec.name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
  if (spec.name.empty() || !plain) file.fail("name", "lower case letters, digits and _");
  spec.title = file.text("title", spec.name);
  std::vector<std::string> names;
  for (const SweepExperiment& known : sweep_experiments()) names.push_back(known.name);
  const SweepExperiment& experiment = sweep_experiments()[file.choice("experiment", 0, names)];
  spec.experiment = experiment.name;
  spec.base = read_base(file, experiment);
  spec.axes = read_axes(file, experiment, smoke);
  spec.estimators = read_estimators(file, experiment);
  spec.trials = static_cast<std::uint64_t>(file.integer("trials", 1, 1, most_trials));
  const auto smoke_trials =
      file.integer("smoke_trials", std::min<std::int64_t>(10, spec.trials), 1, most_trials);
  if (smoke) spec.trials = static_cast<std::uint64_t>(smoke_trials);
  spec.seed = static_cast<std::uint64_t>(
      file.integer("seed", 1, 0, std::numeric_limits<std::int64_t>::max()));
  file.finish();
  if (spec.cells() > most_cells || spec.units() > 10'000'000'000)
    throw input_error(fmt::format(
        "{}: {} cells of {} trials; at most {} cells and 1e10 trials in all fit one sweep",
        path.string(), spec.cells(), spec.trials, most_cells));
  check_cells(spec, experiment, path);
  return spec;
}

}  // namespace alea::experiments
