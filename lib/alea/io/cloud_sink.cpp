#include "alea/io/cloud_sink.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <mutex>

#include "alea/core/parallel.hpp"

namespace alea {
namespace {

// Small enough for its points to stay in a core's cache while they are scaled and checked.
constexpr std::size_t chunk_points = 1 << 12;

bool is_finite(const Eigen::Vector3d& p) {
  return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
}

// Asks for large pages before the memory is touched: a tenth of the page faults of a large cloud.
template <typename T>
void reserve_large(std::vector<T>& values, std::size_t count) {
  values.reserve(count);
  constexpr std::uintptr_t page = 4096;
  const auto begin = (reinterpret_cast<std::uintptr_t>(values.data()) + page - 1) / page * page;
  const auto end = reinterpret_cast<std::uintptr_t>(values.data() + values.capacity());
  if (end > begin + (std::uintptr_t{4} << 20))
    ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

}  // namespace

CloudSink::CloudSink(const Channels& channels, const ReadOptions& options)
    : channels_(channels), options_(options) {}

void CloudSink::reserve(std::size_t count) {
  if (options_.crop_m || options_.keep_every > 1) return;
  reserve_large(cloud_.positions, count);
  if (channels_.intensity) reserve_large(cloud_.intensity, count);
  if (channels_.normals) reserve_large(cloud_.normals, count);
  if (channels_.colours) reserve_large(cloud_.colours, count);
  if (channels_.grid) {
    reserve_large(cloud_.rows, count);
    reserve_large(cloud_.columns, count);
  }
}

void CloudSink::resize(std::size_t count) {
  cloud_.positions.resize(count);
  if (channels_.intensity) cloud_.intensity.resize(count);
  if (channels_.normals) cloud_.normals.resize(count);
  if (channels_.colours) cloud_.colours.resize(count);
  if (channels_.grid) {
    cloud_.rows.resize(count);
    cloud_.columns.resize(count);
  }
}

void CloudSink::append(std::size_t count, const Fill& fill) {
  std::vector<std::size_t> sizes(count / chunk_points, chunk_points);
  sizes.push_back(count % chunk_points);
  append_pieces(sizes, [&](Cloud& cloud, std::size_t at, std::size_t piece) {
    const std::size_t begin = piece * chunk_points;
    return fill(cloud, at, begin, begin + sizes[piece]);
  });
}

void CloudSink::append_pieces(const std::vector<std::size_t>& sizes, const FillPiece& fill) {
  const std::size_t kept = cloud_.size();
  std::vector<std::size_t> begins{kept};
  for (const std::size_t size : sizes) begins.push_back(begins.back() + size);
  resize(begins.back());
  std::mutex mutex;
  DroppedPoints dropped;
  std::size_t not_finite = 0;
  parallel_chunks(sizes.size(), 1, [&](std::size_t piece, std::size_t) {
    if (sizes[piece] == 0) return;
    const DroppedPoints here = fill(cloud_, begins[piece], piece);
    const std::size_t bad = scale_and_check(begins[piece], begins[piece + 1]);
    if (bad == 0) return;
    const std::lock_guard lock(mutex);
    not_finite += bad;
    dropped.invalid += here.invalid;
    dropped.missing += here.missing;
  });
  cloud_.dropped.invalid += dropped.invalid;
  cloud_.dropped.missing += dropped.missing;
  cloud_.dropped.non_finite += not_finite - dropped.invalid - dropped.missing;
  if (not_finite > 0 || options_.crop_m || options_.keep_every > 1) compact(kept, begins.back());
}

std::size_t CloudSink::scale_and_check(std::size_t begin, std::size_t end) {
  if (options_.unit_m != 1)
    for (std::size_t i = begin; i < end; ++i) cloud_.positions[i] *= options_.unit_m;
  // Zero times a number is zero, times infinity or NaN it is NaN: one sum tells of them all.
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = begin; i < end; ++i) sum += 0.0 * cloud_.positions[i];
  if (sum.allFinite()) return 0;
  return static_cast<std::size_t>(
      std::count_if(cloud_.positions.begin() + static_cast<std::ptrdiff_t>(begin),
                    cloud_.positions.begin() + static_cast<std::ptrdiff_t>(end),
                    [](const Eigen::Vector3d& p) { return !is_finite(p); }));
}

void CloudSink::compact(std::size_t begin, std::size_t end) {
  std::size_t to = begin;
  for (std::size_t i = begin; i < end; ++i) {
    const Eigen::Vector3d& p = cloud_.positions[i];
    if (!is_finite(p) || (options_.crop_m && !options_.crop_m->contains(p))) continue;
    if (candidates_++ % options_.keep_every != 0) continue;
    cloud_.positions[to] = p;
    if (channels_.intensity) cloud_.intensity[to] = cloud_.intensity[i];
    if (channels_.normals) cloud_.normals[to] = cloud_.normals[i];
    if (channels_.colours) cloud_.colours[to] = cloud_.colours[i];
    if (channels_.grid) {
      cloud_.rows[to] = cloud_.rows[i];
      cloud_.columns[to] = cloud_.columns[i];
    }
    ++to;
  }
  resize(to);
}

Cloud CloudSink::take() {
  Cloud out = std::move(cloud_);
  cloud_ = {};
  return out;
}

}  // namespace alea
