#include "alea/io/field_role.hpp"

#include <algorithm>
#include <cctype>
#include <map>

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

}  // namespace

std::optional<FieldRole> role_of(std::string_view name) {
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto found = roles().find(lower);
  if (found == roles().end()) return std::nullopt;
  return found->second;
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
