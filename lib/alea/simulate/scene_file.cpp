#include "alea/simulate/scene_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "alea/io/toml_table.hpp"
#include "alea/simulate/scene_file_parts.hpp"

namespace alea {
namespace {

double read_intensity(const TomlTable& table, double missing) {
  return table.number("intensity", missing, Allowed::not_negative);
}

Patch read_patch(const TomlTable& table, std::size_t number) {
  Patch patch;
  patch.id = table.text("id", fmt::format("patch {}", number));
  patch.corner_m = table.vector3("corner_m");
  patch.side_u_m = table.vector3("side_u_m");
  patch.side_v_m = table.vector3("side_v_m");
  const double area = patch.side_u_m.norm() * patch.side_v_m.norm();
  if (!(area > 0)) table.fail("side_u_m", "two sides of positive length");
  if (std::abs(patch.side_u_m.dot(patch.side_v_m)) > 1e-6 * area)
    table.fail("side_v_m", "a side at right angles to side_u_m");
  patch.intensity = read_intensity(table, patch.intensity);
  patch.role = static_cast<PatchRole>(table.choice("role", 0, {"scenery", "check", "calibration"}));
  table.finish();
  return patch;
}

Box read_box(const TomlTable& table, std::size_t number) {
  Box box;
  box.id = table.text("id", fmt::format("box {}", number));
  box.size_m = read_size(table, "size_m", box.size_m);
  box.scene_from_box = read_pose(table, "centre_m");
  box.intensity = read_intensity(table, box.intensity);
  table.finish();
  return box;
}

Cylinder read_cylinder(const TomlTable& table, std::size_t number) {
  Cylinder cylinder;
  cylinder.id = table.text("id", fmt::format("cylinder {}", number));
  cylinder.base_m = table.vector3("base_m");
  cylinder.axis_m = table.vector3("axis_m", cylinder.axis_m);
  if (!(cylinder.axis_m.norm() > 0)) table.fail("axis_m", "an axis of positive length");
  cylinder.radius_m = table.number("radius_m", cylinder.radius_m, Allowed::positive);
  if (table.has("top_radius_m"))
    cylinder.top_radius_m = table.number("top_radius_m", 0, Allowed::not_negative);
  cylinder.intensity = read_intensity(table, cylinder.intensity);
  table.finish();
  return cylinder;
}

Sphere read_sphere(const TomlTable& table, std::size_t number) {
  Sphere sphere;
  sphere.id = table.text("id", fmt::format("sphere {}", number));
  sphere.centre_m = table.vector3("centre_m");
  sphere.radius_m = table.number("radius_m", sphere.radius_m, Allowed::positive);
  sphere.intensity = read_intensity(table, sphere.intensity);
  table.finish();
  return sphere;
}

Checkerboard read_checkerboard(const TomlTable& table, std::size_t number) {
  Checkerboard board;
  board.id = table.text("id", fmt::format("checkerboard {}", number));
  board.scene_from_board = read_pose(table, "centre_m");
  board.columns = static_cast<int>(table.integer("columns", board.columns, 1, 1000));
  board.rows = static_cast<int>(table.integer("rows", board.rows, 1, 1000));
  board.cell_m = table.number("cell_m", board.cell_m, Allowed::positive);
  board.margin_m = table.number("margin_m", board.margin_m, Allowed::not_negative);
  board.dark_intensity =
      table.number("dark_intensity", board.dark_intensity, Allowed::not_negative);
  board.light_intensity =
      table.number("light_intensity", board.light_intensity, Allowed::not_negative);
  board.plate_intensity =
      table.number("plate_intensity", board.plate_intensity, Allowed::not_negative);
  table.finish();
  return board;
}

/// The triangles of a mesh as it stands in its file or in the scene, in the mesh's own frame.
TriangleMesh read_triangles(const TomlTable& table, const std::filesystem::path& folder) {
  if (table.has("file")) {
    if (table.has("vertices_m")) table.fail("vertices_m", "either this or a file");
    return read_mesh((folder / table.text("file", "")).string());
  }
  TriangleMesh mesh;
  mesh.vertices = table.vectors("vertices_m");
  for (const Eigen::Vector3d& corners : table.vectors("triangles")) {
    const Eigen::Array3d whole = corners.array().floor();
    if ((whole != corners.array()).any() || whole.minCoeff() < 0 ||
        whole.maxCoeff() >= static_cast<double>(mesh.vertices.size()))
      table.fail("triangles", "three vertices each, counted from 0");
    mesh.triangles.push_back({static_cast<std::uint32_t>(whole[0]),
                              static_cast<std::uint32_t>(whole[1]),
                              static_cast<std::uint32_t>(whole[2])});
  }
  if (mesh.triangles.empty()) table.fail("", "a file, or vertices_m and triangles");
  return mesh;
}

Mesh read_mesh_table(const TomlTable& table, std::size_t number,
                     const std::filesystem::path& folder) {
  const std::string id = table.text("id", fmt::format("mesh {}", number));
  TriangleMesh body = read_triangles(table, folder);
  const double scale = table.number("scale", 1, Allowed::positive);
  const RigidTransform scene_from_mesh = read_pose(table, "position_m");
  const double intensity = read_intensity(table, 0.5);
  table.finish();
  for (Eigen::Vector3d& vertex : body.vertices) vertex = scene_from_mesh * (scale * vertex);
  return build_mesh(id, std::move(body), intensity);
}

void set_roles(const TomlTable& table, const std::string& key, PatchRole role,
               std::vector<Patch>& faces) {
  for (const std::string& id : table.texts(key)) {
    const auto face = std::find_if(faces.begin(), faces.end(),
                                   [&id](const Patch& patch) { return patch.id == id; });
    if (face == faces.end())
      table.fail(key, "some of floor, ceiling, wall -x, wall +x, wall -y, wall +y");
    face->role = role;
  }
}

/// Floor, ceiling and four walls of a room, as patches whose normals look inside.
std::vector<Patch> read_room(const TomlTable& table) {
  table.require("size_m");
  const Eigen::Vector3d low = table.vector3("corner_m");
  const Eigen::Vector3d size = read_size(table, "size_m", Eigen::Vector3d::Zero());
  const double intensity = read_intensity(table, 0.5);
  const Eigen::Vector3d x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
  std::vector<Patch> faces;
  const auto add = [&](const char* id, const Eigen::Vector3d& corner, const Eigen::Vector3d& u,
                       const Eigen::Vector3d& v) {
    faces.push_back({id, corner, u, v, intensity, PatchRole::scenery});
  };
  add("floor", low, x, y);
  if (table.flag("ceiling", true)) add("ceiling", low + z, y, x);
  add("wall -x", low, y, z);
  add("wall +x", low + x, z, y);
  add("wall -y", low, z, x);
  add("wall +y", low + y, x, z);
  set_roles(table, "check", PatchRole::check, faces);
  set_roles(table, "calibration", PatchRole::calibration, faces);
  table.finish();
  return faces;
}

template <typename Object, typename Read>
void read_all(const TomlTable& file, const char* key, Read read, std::vector<Object>& out) {
  for (const TomlTable& table : file.tables(key)) out.push_back(read(table, out.size() + 1));
}

std::vector<std::pair<std::string, BoundingBall>> targets_of(const Scene& scene) {
  std::vector<std::pair<std::string, BoundingBall>> targets;
  const auto add = [&targets](const auto& objects) {
    for (const auto& object : objects) targets.emplace_back(object.id, bounding_ball(object));
  };
  for (const Die& die : scene.dice) targets.emplace_back(die.model.id, bounding_ball(die));
  add(scene.patches);
  add(scene.boxes);
  add(scene.cylinders);
  add(scene.spheres);
  add(scene.checkerboards);
  add(scene.meshes);
  return targets;
}

}  // namespace

Scene load_scene(const std::filesystem::path& path) {
  const TomlTable file = TomlTable::read(path);
  file.text("title", "");
  file.table("plan");  // what `alea plan` asks for; read by load_plan
  Scene scene;
  if (const auto room = file.table("room")) scene.patches = read_room(*room);
  read_all(file, "die", read_die, scene.dice);
  read_all(file, "patch", read_patch, scene.patches);
  read_all(file, "box", read_box, scene.boxes);
  read_all(file, "cylinder", read_cylinder, scene.cylinders);
  read_all(file, "sphere", read_sphere, scene.spheres);
  read_all(file, "checkerboard", read_checkerboard, scene.checkerboards);
  const auto read_one = [&path](const TomlTable& table, std::size_t number) {
    return read_mesh_table(table, number, path.parent_path());
  };
  read_all(file, "mesh", read_one, scene.meshes);
  Scanner scanner;
  if (const auto table = file.table("scanner")) scanner = read_scanner(*table, scanner);
  const auto targets = targets_of(scene);
  for (const TomlTable& table : file.tables("station")) {
    Station station = read_station(table, scene.stations.size() + 1, scanner, targets);
    for (const Station& other : scene.stations)
      if (other.name == station.name) table.fail("name", "a name that no other station has");
    scene.stations.push_back(std::move(station));
  }
  file.finish();
  if (scene.stations.empty()) file.fail("station", "at least one [[station]]");
  return scene;
}

}  // namespace alea
