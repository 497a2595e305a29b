#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace alea {

/// Triangles between vertices (m), counterclockwise as seen from outside where the file says so.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into `vertices`
};

/// Reads a mesh by its extension: OBJ (v and f lines, relative indices too), OFF, PLY (ascii and
/// binary). A face of more than three corners becomes a fan. Normals, textures and colours are
/// skipped. Throws Error(input) with file, line or byte, and expectation.
TriangleMesh read_mesh(const std::string& path);

/// The fan of a face given by its corners. Throws Error(input) naming `where` for fewer than three
/// corners or one that is not below `vertex_count`.
void add_face(const std::vector<std::int64_t>& corners, std::size_t vertex_count,
              const std::string& where, TriangleMesh& mesh);

}  // namespace alea
