#include "alea/io/cloud_sink.hpp"

#include <cmath>
#include <mutex>

#include "alea/core/parallel.hpp"

namespace alea {
namespace {

constexpr std::size_t chunk_points = 1 << 14;

bool is_finite(const Eigen::Vector3d& p) {
  return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
}

}  // namespace

CloudSink::CloudSink(const Channels& channels, const ReadOptions& options)
    : channels_(channels), options_(options) {}

void CloudSink::reserve(std::size_t count) {
  if (options_.crop_m || options_.keep_every > 1) return;
  cloud_.positions.reserve(count);
  if (channels_.intensity) cloud_.intensity.reserve(count);
  if (channels_.normals) cloud_.normals.reserve(count);
  if (channels_.colours) cloud_.colours.reserve(count);
  if (channels_.grid) {
    cloud_.rows.reserve(count);
    cloud_.columns.reserve(count);
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
  std::size_t bad = 0;
  for (std::size_t i = begin; i < end; ++i) {
    if (options_.unit_m != 1) cloud_.positions[i] *= options_.unit_m;
    if (!is_finite(cloud_.positions[i])) ++bad;
  }
  return bad;
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
