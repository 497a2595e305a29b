#include "alea/simulate/mesh.hpp"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "alea/core/error.hpp"

namespace alea {

/// Owns what Embree holds of one mesh. Single precision is counted from the mesh's own centre, so
/// that a scene far from the origin loses nothing.
class MeshTree {
 public:
  explicit MeshTree(const TriangleMesh& mesh)
      // One thread builds the tree: where two triangles tie, the answer depends on it.
      : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& vertex : mesh.vertices) box.extend(vertex);
    centre_m_ = box.center();
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh.vertices.size()));
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        vertices[3 * i + static_cast<std::size_t>(axis)] =
            static_cast<float>(mesh.vertices[i][axis] - centre_m_[axis]);
    auto* const triangles = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), mesh.triangles.size()));
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      std::copy(mesh.triangles[i].begin(), mesh.triangles[i].end(), triangles + 3 * i);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene_);
  }
  ~MeshTree() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  MeshTree(const MeshTree&) = delete;
  MeshTree& operator=(const MeshTree&) = delete;

  /// The triangle that the ray meets first, nearer than `farthest_m`; the count's maximum for none.
  std::uint32_t first_triangle(const Ray& ray, double farthest_m) const {
    const Eigen::Vector3f origin = (ray.origin - centre_m_).cast<float>();
    const Eigen::Vector3f direction = ray.direction.cast<float>();
    RTCRayHit query{};
    query.ray.org_x = origin.x();
    query.ray.org_y = origin.y();
    query.ray.org_z = origin.z();
    query.ray.dir_x = direction.x();
    query.ray.dir_y = direction.y();
    query.ray.dir_z = direction.z();
    query.ray.tnear = 0;
    query.ray.tfar = static_cast<float>(farthest_m) * 1.00001F;
    query.ray.mask = std::numeric_limits<unsigned>::max();
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_, &context, &query);
    return query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<std::uint32_t>::max()
                                                       : query.hit.primID;
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
  Eigen::Vector3d centre_m_;
};

Mesh build_mesh(std::string id, TriangleMesh body, double intensity) {
  if (body.triangles.empty())
    throw input_error(fmt::format("mesh '{}': no triangles; it needs at least one", id));
  for (const Eigen::Vector3d& vertex : body.vertices)
    if (!vertex.allFinite())
      throw input_error(fmt::format("mesh '{}': a vertex is not finite", id));
  for (const auto& triangle : body.triangles)
    for (const std::uint32_t corner : triangle)
      if (corner >= body.vertices.size())
        throw input_error(fmt::format("mesh '{}': a triangle names vertex {} of {}", id, corner,
                                      body.vertices.size()));
  auto tree = std::make_shared<const MeshTree>(body);
  return {std::move(id), std::move(body), intensity, std::move(tree)};
}

void intersect(const Mesh& mesh, std::uint32_t index, const Ray& ray, Hit& hit) {
  const std::uint32_t found = mesh.tree->first_triangle(ray, hit.range_m);
  if (found >= mesh.body.triangles.size()) return;
  const auto& triangle = mesh.body.triangles[found];
  const Eigen::Vector3d& corner = mesh.body.vertices[triangle[0]];
  const Eigen::Vector3d across =
      (mesh.body.vertices[triangle[1]] - corner).cross(mesh.body.vertices[triangle[2]] - corner);
  const double approach = across.dot(ray.direction);
  if (approach == 0) return;
  const double range_m = across.dot(corner - ray.origin) / approach;
  if (!(range_m > 0 && range_m < hit.range_m)) return;
  hit = {range_m, across.normalized(), mesh.intensity, {SurfaceKind::mesh, index, 0}};
}

}  // namespace alea
