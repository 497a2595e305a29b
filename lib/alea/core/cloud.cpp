#include "alea/core/cloud.hpp"

namespace alea {
namespace {

template <typename T>
std::vector<T> gather(const std::vector<T>& values, const std::vector<std::uint32_t>& indices) {
  std::vector<T> out;
  if (values.empty()) return out;
  out.reserve(indices.size());
  for (const std::uint32_t i : indices) out.push_back(values[i]);
  return out;
}

}  // namespace

Cloud subset(const Cloud& cloud, const std::vector<std::uint32_t>& indices) {
  Cloud out;
  out.positions = gather(cloud.positions, indices);
  out.intensity = gather(cloud.intensity, indices);
  out.normals = gather(cloud.normals, indices);
  out.colours = gather(cloud.colours, indices);
  out.rows = gather(cloud.rows, indices);
  out.columns = gather(cloud.columns, indices);
  out.scanner_position = cloud.scanner_position;
  return out;
}

}  // namespace alea
