#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "alea/core/error.hpp"
#include "alea/io/cloud_file.hpp"
#include "alea/io/input_file.hpp"
#include "alea/io/mesh_file.hpp"
#include "alea/io/ply_faces.hpp"
#include "alea/io/text_lines.hpp"

namespace alea {
namespace {

/// The lines of a text file that say something: comments after # are cut off, empty lines skipped.
class MeshLines {
 public:
  explicit MeshLines(const InputFile& file) : file_(file) {}

  bool next() {
    while (offset_ < file_.bytes().size()) {
      const TextLine line = line_at(file_.bytes(), offset_);
      offset_ = line.next;
      ++number_;
      words_ = split_values(line.text.substr(0, line.text.find('#')));
      if (!words_.empty()) return true;
    }
    return false;
  }
  const std::vector<std::string_view>& words() const { return words_; }
  std::string where() const { return fmt::format("{}:{}", file_.path(), number_); }

  Eigen::Vector3d point(std::size_t first) const {
    Eigen::Vector3d point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto value = first + axis < words_.size() ? parse_number(words_[first + axis])
                                                      : std::optional<double>();
      if (!value || !std::isfinite(*value))
        throw input_error(where() + ": expected a vertex of three finite numbers");
      point[static_cast<Eigen::Index>(axis)] = *value;
    }
    return point;
  }
  std::int64_t whole(std::string_view word) const {
    const auto value = parse_number(word);
    if (!value || *value != std::floor(*value) || std::abs(*value) > 4e9)
      throw input_error(fmt::format("{}: '{}' is no whole number", where(), word));
    return static_cast<std::int64_t>(*value);
  }

 private:
  const InputFile& file_;
  std::size_t offset_ = 0;
  std::size_t number_ = 0;
  std::vector<std::string_view> words_;
};

TriangleMesh read_obj(const InputFile& file) {
  TriangleMesh mesh;
  MeshLines lines(file);
  while (lines.next()) {
    const auto& words = lines.words();
    if (words[0] == "v") mesh.vertices.push_back(lines.point(1));
    if (words[0] != "f") continue;
    std::vector<std::int64_t> corners;
    for (std::size_t i = 1; i < words.size(); ++i) {
      // vertex/texture/normal; counted from one, backwards where negative.
      const std::int64_t index = lines.whole(words[i].substr(0, words[i].find('/')));
      corners.push_back(index < 0 ? static_cast<std::int64_t>(mesh.vertices.size()) + index
                                  : index - 1);
    }
    add_face(corners, mesh.vertices.size(), lines.where(), mesh);
  }
  return mesh;
}

std::int64_t count_of(const MeshLines& lines, std::size_t word) {
  const std::int64_t count =
      word < lines.words().size() ? lines.whole(lines.words()[word]) : std::int64_t{-1};
  if (count < 0)
    throw input_error(lines.where() + ": expected the counts of vertices, faces and edges");
  return count;
}

TriangleMesh read_off(const InputFile& file) {
  MeshLines lines(file);
  if (!lines.next() || lines.words()[0] != "OFF")
    throw input_error(file.path() + ": an OFF file begins with the word OFF");
  const bool same_line = lines.words().size() > 1;
  if (!same_line && !lines.next())
    throw input_error(lines.where() + ": expected the counts of vertices, faces and edges");
  const std::size_t at = same_line ? 1 : 0;
  const std::int64_t vertices = count_of(lines, at), faces = count_of(lines, at + 1);
  const auto need_line = [&](const char* what) {
    if (!lines.next())
      throw input_error(fmt::format("{}: the file ends before the last {}", lines.where(), what));
  };
  TriangleMesh mesh;
  for (std::int64_t i = 0; i < vertices; ++i) {
    need_line("vertex");
    mesh.vertices.push_back(lines.point(0));
  }
  for (std::int64_t i = 0; i < faces; ++i) {
    need_line("face");
    const std::int64_t corners = count_of(lines, 0);
    std::vector<std::int64_t> face;
    for (std::int64_t k = 1; k <= corners && k < static_cast<std::int64_t>(lines.words().size());
         ++k)
      face.push_back(lines.whole(lines.words()[static_cast<std::size_t>(k)]));
    if (static_cast<std::int64_t>(face.size()) != corners)
      throw input_error(fmt::format("{}: expected {} corners of a face", lines.where(), corners));
    add_face(face, mesh.vertices.size(), lines.where(), mesh);
  }
  return mesh;
}

TriangleMesh read_ply_mesh(const InputFile& file) {
  const Cloud vertices = read_cloud(file.path());
  if (vertices.dropped.non_finite + vertices.dropped.invalid + vertices.dropped.missing > 0)
    throw input_error(file.path() + ": a mesh needs finite vertices; some are not");
  TriangleMesh mesh;
  mesh.vertices = vertices.positions;
  for (const PlyFace& face : read_ply_faces(file))
    add_face(face.corners, mesh.vertices.size(), face.where, mesh);
  return mesh;
}

}  // namespace

void add_face(const std::vector<std::int64_t>& corners, std::size_t vertex_count,
              const std::string& where, TriangleMesh& mesh) {
  if (corners.size() < 3)
    throw input_error(
        fmt::format("{}: a face of {} corners; it needs three", where, corners.size()));
  for (const std::int64_t corner : corners)
    if (corner < 0 || corner >= static_cast<std::int64_t>(vertex_count))
      throw input_error(fmt::format("{}: a face names vertex {}, but there are {} (counted from 0)",
                                    where, corner, vertex_count));
  for (std::size_t i = 2; i < corners.size(); ++i)
    mesh.triangles.push_back({static_cast<std::uint32_t>(corners[0]),
                              static_cast<std::uint32_t>(corners[i - 1]),
                              static_cast<std::uint32_t>(corners[i])});
}

TriangleMesh read_mesh(const std::string& path) {
  std::string extension = path.substr(std::min(path.rfind('.'), path.size()));
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const InputFile file(path);
  TriangleMesh mesh;
  if (extension == ".obj")
    mesh = read_obj(file);
  else if (extension == ".off")
    mesh = read_off(file);
  else if (extension == ".ply")
    mesh = read_ply_mesh(file);
  else
    throw input_error(path + ": not a mesh file; give .obj, .off or .ply");
  if (mesh.triangles.empty()) throw input_error(path + ": no faces; a mesh needs triangles");
  file.check_unchanged();
  return mesh;
}

}  // namespace alea
