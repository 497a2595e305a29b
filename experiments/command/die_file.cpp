#include "experiments/command/die_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "alea/core/angle.hpp"
#include "alea/core/error.hpp"

namespace alea::command {
namespace {

using nlohmann::json;

/// A facet's plane; its offset is NaN where the file leaves it open.
Plane read_plane(const std::string& path, const std::string& pips, const json& entry) {
  try {
    const json& normal = entry.at("normal");
    const Eigen::Vector3d direction(normal.at(0).get<double>(), normal.at(1).get<double>(),
                                    normal.at(2).get<double>());
    const json& offset = entry.at("offset_m");
    Plane plane{direction, offset.is_null() ? std::nan("") : offset.get<double>()};
    const double length = plane.normal.norm();
    if (!plane.normal.allFinite() || std::isinf(plane.offset_m) || std::abs(length - 1) > 1e-3)
      throw input_error(fmt::format(
          "{}: planes.{}: the normal must have unit length and all numbers be finite", path, pips));
    plane.normal /= length;
    return plane;
  } catch (const json::exception&) {
    throw input_error(
        fmt::format("{}: planes.{}: needs normal [3] and offset_m, or null", path, pips));
  }
}

/// Open offsets become the mean of the known ones: a start for what a registration must find.
void fill_open_offsets(DieShape& shape, double half_edge_m) {
  double sum = 0, count = 0;
  for (const auto& facet : shape.facets)
    if (facet && !std::isnan(facet->offset_m)) sum += facet->offset_m, ++count;
  for (auto& facet : shape.facets)
    if (facet && std::isnan(facet->offset_m))
      facet->offset_m = count > 0 ? sum / count : half_edge_m;
}

ShapeMatrix read_covariance(const std::string& path, const json& rows) {
  const auto bad = [&](const std::string& why) {
    return input_error(
        fmt::format("{}: covariance: {}; it has 18 rows of 18 numbers or null (a, b, "
                    "c of the facets 1 to 6) and no negative variance",
                    path, why));
  };
  if (!rows.is_array() || rows.size() != 18) throw bad("not 18 rows");
  ShapeMatrix out = ShapeMatrix::Zero();
  for (int i = 0; i < 18; ++i) {
    const json& row = rows[static_cast<std::size_t>(i)];
    if (!row.is_array() || row.size() != 18) throw bad(fmt::format("row {}", i + 1));
    for (int j = 0; j < 18; ++j) {
      const json& value = row[static_cast<std::size_t>(j)];
      if (value.is_null()) continue;
      if (!value.is_number()) throw bad(fmt::format("row {}", i + 1));
      out(i, j) = value.get<double>();
    }
  }
  if (!out.allFinite() || (out.diagonal().array() < 0).any() || out.isZero(0))
    throw bad("no covariance");
  if (!out.isApprox(out.transpose(), 1e-6)) throw bad("not symmetric");
  return out;
}

/// Whether the length between a facet and its opposite is known; a facet seen without its opposite
/// only places the frame.
bool offset_known(const DieAdjustment& adjusted, int pips) {
  const bool both = adjusted.shape.facet(pips) && adjusted.shape.facet(opposite_pips(pips));
  return !both || adjusted.length_determined[die_axis(pips)];
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

GivenShape read_die_file(const std::string& path, double half_edge_m) {
  json document = read_json_file(path, "a die shape (DIE.json)");
  if (document.is_object() && document.contains("die") && document["die"].is_object())
    document = json(document["die"]);
  if (!document.is_object() || !document.contains("planes") || !document["planes"].is_object())
    throw input_error(fmt::format(
        "{}: no planes; a die shape has planes {{\"1\": {{normal, offset_m}}, ... \"6\"}}", path));
  GivenShape given;
  int known = 0;
  bool open = false;
  for (int pips = 1; pips <= 6; ++pips) {
    const std::string key = std::to_string(pips);
    const json& planes = document["planes"];
    if (!planes.contains(key) || planes[key].is_null()) continue;
    const Plane plane = read_plane(path, key, planes[key]);
    given.shape.facets[static_cast<std::size_t>(pips - 1)] = plane;
    open = open || std::isnan(plane.offset_m);
    ++known;
  }
  if (known < 3)
    throw input_error(fmt::format("{}: {} planes; a die shape needs three or more", path, known));
  if (document.contains("covariance") && !document["covariance"].is_null())
    given.covariance = read_covariance(path, document["covariance"]);
  if (open && !given.covariance)
    throw input_error(
        fmt::format("{}: an offset_m is null, but there is no covariance to say so", path));
  fill_open_offsets(given.shape, half_edge_m);
  return given;
}

json die_json(const DieAdjustment& adjusted, Chirality hand) {
  json planes = json::object(), edges = json::object(), deviations = json::object();
  json angles = json::object(), angle_deviations = json::object();
  std::array<bool, 18> known{};
  for (int pips = 1; pips <= 6; ++pips) {
    json& entry = planes[std::to_string(pips)] = nullptr;
    const auto& plane = adjusted.shape.facet(pips);
    if (!plane) continue;
    const bool offset = offset_known(adjusted, pips);
    entry = {{"normal", {plane->normal.x(), plane->normal.y(), plane->normal.z()}},
             {"offset_m", offset ? json(plane->offset_m) : json(nullptr)}};
    for (int k = 0; k < 3; ++k)
      known[static_cast<std::size_t>(3 * (pips - 1) + k)] = k < 2 || offset;
  }
  for (const AdjustedEdge& edge : adjusted.edges) {
    const std::string name = fmt::format("{}-{}", edge.edge.first_pips, edge.edge.second_pips);
    edges[name] = edge.length_m ? json(*edge.length_m) : json(nullptr);
    deviations[name] = edge.sd_m ? json(*edge.sd_m) : json(nullptr);
  }
  for (const AdjustedAngle& angle : adjusted.angles) {
    const std::string name = fmt::format("{}-{}", angle.edge.first_pips, angle.edge.second_pips);
    angles[name] = angle.angle_rad ? json(*angle.angle_rad * deg_per_rad) : json(nullptr);
    angle_deviations[name] = angle.sd_rad ? json(*angle.sd_rad * deg_per_rad) : json(nullptr);
  }
  json covariance = json::array();
  for (std::size_t i = 0; i < 18; ++i) {
    json row = json::array();
    for (std::size_t j = 0; j < 18; ++j)
      row.push_back(known[i] && known[j]
                        ? json(adjusted.shape_covariance(static_cast<int>(i), static_cast<int>(j)))
                        : json(nullptr));
    covariance.push_back(row);
  }
  return {{"planes", planes},
          {"edges_m", edges},
          {"edges_sd_m", deviations},
          {"angles_deg", angles},
          {"angles_sd_deg", angle_deviations},
          {"covariance", covariance},
          {"chirality", to_string(hand)}};
}

}  // namespace alea::command
