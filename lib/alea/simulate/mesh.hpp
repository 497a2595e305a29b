#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "alea/io/mesh_file.hpp"
#include "alea/simulate/ray.hpp"

namespace alea {

class MeshTree;

/// A surface of triangles, seen from both sides.
struct Mesh {
  std::string id;
  TriangleMesh body;  ///< scene frame
  double intensity = 0.5;
  std::shared_ptr<const MeshTree> tree;  ///< of `body`; made by build_mesh
};

/// Builds the search tree of a mesh (Embree). Throws Error(input) naming the mesh where it has no
/// triangle, a vertex that is not finite or an index that names no vertex.
Mesh build_mesh(std::string id, TriangleMesh body, double intensity = 0.5);

/// Moves `hit` to where the ray meets the mesh, if that is nearer and in front of the origin. The
/// tree finds the triangle in single precision; the range is that of the triangle's plane in
/// double.
void intersect(const Mesh& mesh, std::uint32_t index, const Ray& ray, Hit& hit);

}  // namespace alea
