#include "experiments/command/die_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "alea/core/error.hpp"

namespace alea::command {
namespace {

using nlohmann::json;

Plane read_plane(const std::string& path, const std::string& pips, const json& entry) {
  try {
    const json& normal = entry.at("normal");
    const Eigen::Vector3d direction(normal.at(0).get<double>(), normal.at(1).get<double>(),
                                    normal.at(2).get<double>());
    Plane plane{direction, entry.at("offset_m").get<double>()};
    const double length = plane.normal.norm();
    if (!plane.normal.allFinite() || !std::isfinite(plane.offset_m) || std::abs(length - 1) > 1e-3)
      throw input_error(fmt::format(
          "{}: planes.{}: the normal must have unit length and all numbers be finite", path, pips));
    plane.normal /= length;
    return plane;
  } catch (const json::exception&) {
    throw input_error(
        fmt::format("{}: planes.{}: needs normal [3] and offset_m, or null", path, pips));
  }
}

}  // namespace

json read_json_file(const std::string& path, const std::string& expectation) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw input_error(fmt::format("{}: cannot read; {} is needed", path, expectation));
  try {
    return json::parse(file);
  } catch (const json::exception& error) {
    throw input_error(
        fmt::format("{}: not JSON ({}); {} is needed", path, error.what(), expectation));
  }
}

DieShape read_die_file(const std::string& path) {
  json document = read_json_file(path, "a die shape (DIE.json)");
  if (document.is_object() && document.contains("die") && document["die"].is_object())
    document = json(document["die"]);
  if (!document.is_object() || !document.contains("planes") || !document["planes"].is_object())
    throw input_error(fmt::format(
        "{}: no planes; a die shape has planes {{\"1\": {{normal, offset_m}}, ... \"6\"}}", path));
  DieShape shape;
  int known = 0;
  for (int pips = 1; pips <= 6; ++pips) {
    const std::string key = std::to_string(pips);
    const json& planes = document["planes"];
    if (!planes.contains(key) || planes[key].is_null()) continue;
    shape.facets[static_cast<std::size_t>(pips - 1)] = read_plane(path, key, planes[key]);
    ++known;
  }
  if (known < 3)
    throw input_error(fmt::format("{}: {} planes; a die shape needs three or more", path, known));
  return shape;
}

}  // namespace alea::command
