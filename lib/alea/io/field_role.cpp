#include "alea/io/field_role.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "alea/core/error.hpp"

namespace alea {
namespace {

const std::map<std::string, FieldRole, std::less<>>& roles() {
  using enum FieldRole;
  static const std::map<std::string, FieldRole, std::less<>> names{
      {"x", x},
      {"y", y},
      {"z", z},
      {"cartesianx", x},
      {"cartesiany", y},
      {"cartesianz", z},
      {"intensity", intensity},
      {"scalar_intensity", intensity},
      {"reflectance", intensity},
      {"scalar_reflectance", intensity},
      {"i", intensity},
      {"red", red},
      {"r", red},
      {"diffuse_red", red},
      {"colorred", red},
      {"green", green},
      {"g", green},
      {"diffuse_green", green},
      {"colorgreen", green},
      {"blue", blue},
      {"b", blue},
      {"diffuse_blue", blue},
      {"colorblue", blue},
      {"rgb", rgb},
      {"rgba", rgb},
      {"nx", nx},
      {"normal_x", nx},
      {"normalx", nx},
      {"nor:normalx", nx},
      {"ny", ny},
      {"normal_y", ny},
      {"normaly", ny},
      {"nor:normaly", ny},
      {"nz", nz},
      {"normal_z", nz},
      {"normalz", nz},
      {"nor:normalz", nz},
      {"row", row},
      {"rowindex", row},
      {"column", column},
      {"col", column},
      {"columnindex", column},
  };
  return names;
}

// Lower case, without a unit of metres behind the name.
std::string plain_name(std::string_view name) {
  for (const std::string_view unit : {"[m]", "(m)"}) {
    if (!name.ends_with(unit)) continue;
    name.remove_suffix(unit.size());
    while (name.ends_with(' ') || name.ends_with('_')) name.remove_suffix(1);
    break;
  }
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

}  // namespace

std::optional<FieldRole> role_of(std::string_view name) {
  const auto found = roles().find(plain_name(name));
  if (found == roles().end()) return std::nullopt;
  return found->second;
}

std::vector<std::optional<FieldRole>> roles_of(const std::vector<std::string>& names) {
  std::vector<std::optional<FieldRole>> out;
  for (const std::string& name : names) {
    const std::optional<FieldRole> role = role_of(name);
    const bool taken = role && std::find(out.begin(), out.end(), role) != out.end();
    out.push_back(taken ? std::nullopt : role);
  }
  using enum FieldRole;
  const auto has = [&](FieldRole role) {
    return std::find(out.begin(), out.end(), std::optional(role)) != out.end();
  };
  if (has(red) && has(green) && has(blue))
    std::replace(out.begin(), out.end(), std::optional(rgb), std::optional<FieldRole>());
  return out;
}

void check_names(const std::string& place, const std::vector<std::string>& names) {
  std::vector<std::string> seen;
  for (const std::string& name : names) {
    if (!role_of(name)) continue;
    const std::string plain = plain_name(name);
    if (std::find(seen.begin(), seen.end(), plain) != seen.end())
      throw input_error(
          fmt::format("{}: two columns are called '{}'; expected one of each name", place, name));
    seen.push_back(plain);
  }
}

Channels channels_of(const std::vector<std::string>& names) {
  const auto has = [&](std::initializer_list<FieldRole> wanted) {
    return std::all_of(wanted.begin(), wanted.end(), [&](FieldRole role) {
      return std::any_of(names.begin(), names.end(),
                         [&](const std::string& name) { return role_of(name) == role; });
    });
  };
  using enum FieldRole;
  return {has({x, y, z}), has({intensity}), has({nx, ny, nz}),
          has({red, green, blue}) || has({rgb}), has({row, column})};
}

}  // namespace alea
