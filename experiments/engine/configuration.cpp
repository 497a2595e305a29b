#include "experiments/engine/configuration.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "alea/core/error.hpp"
#include "alea/core/version.hpp"

namespace alea::experiments {
namespace {

nlohmann::json to_json(const SweepValue& value) {
  return std::visit([](const auto& v) { return nlohmann::json(v); }, value);
}

SweepValue value_from(const nlohmann::json& json) {
  if (json.is_string()) return json.get<std::string>();
  return json.get<double>();
}

/// What one configuration says of a key, short enough for a line.
std::string short_text(const nlohmann::json& json, const std::string& key) {
  const std::string text = json.contains(key) ? json.at(key).dump() : "nothing";
  constexpr std::size_t most = 60;
  return text.size() <= most ? text : text.substr(0, most) + "...";
}

/// The first key that two objects do not share, with what both say.
std::string difference(const nlohmann::json& stored, const nlohmann::json& wanted) {
  nlohmann::json keys = stored;
  keys.update(wanted);
  for (const auto& [key, ignored] : keys.items()) {
    if (stored.value(key, nlohmann::json()) == wanted.value(key, nlohmann::json())) continue;
    if (key == "base" && stored.contains(key))
      return "base." + difference(stored[key], wanted[key]);
    return fmt::format("{} is {} there and {} now", key, short_text(stored, key),
                       short_text(wanted, key));
  }
  return "";
}

}  // namespace

std::string configuration_of(const SweepSpec& spec) {
  nlohmann::json base, axes = nlohmann::json::array();
  for (const auto& [name, value] : spec.base) base[name] = to_json(value);
  for (const SweepAxis& axis : spec.axes) {
    nlohmann::json values = nlohmann::json::array();
    for (const SweepValue& value : axis.values) values.push_back(to_json(value));
    axes.push_back({{"name", axis.name}, {"values", values}});
  }
  return nlohmann::json{{"schema", sweep_schema}, {"alea", version()},
                        {"sweep", spec.name},     {"experiment", spec.experiment},
                        {"base", base},           {"axes", axes},
                        {"trials", spec.trials},  {"estimators", spec.estimators},
                        {"seed", spec.seed},      {"smoke", spec.smoke}}
      .dump();
}

SweepSpec spec_from(const std::string& configuration) {
  try {
    const nlohmann::json json = nlohmann::json::parse(configuration);
    SweepSpec spec;
    spec.name = spec.title = json.at("sweep").get<std::string>();
    spec.experiment = json.at("experiment").get<std::string>();
    for (const auto& [name, value] : json.at("base").items()) spec.base[name] = value_from(value);
    for (const nlohmann::json& axis : json.at("axes")) {
      spec.axes.push_back({axis.at("name").get<std::string>(), {}});
      for (const nlohmann::json& value : axis.at("values"))
        spec.axes.back().values.push_back(value_from(value));
    }
    spec.estimators = json.at("estimators").get<std::vector<std::string>>();
    spec.trials = json.at("trials").get<std::uint64_t>();
    spec.seed = json.at("seed").get<std::uint64_t>();
    spec.smoke = json.at("smoke").get<bool>();
    return spec;
  } catch (const nlohmann::json::exception&) {
    throw input_error(
        "store: its configuration cannot be read; it is damaged or made by another "
        "version of alea");
  }
}

std::string configuration_difference(const std::string& stored, const std::string& wanted) {
  return difference(nlohmann::json::parse(stored), nlohmann::json::parse(wanted));
}

}  // namespace alea::experiments
