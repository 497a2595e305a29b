#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/io/field_role.hpp"
#include "alea/io/scan_file.hpp"

namespace alea {

/// Collects the points of a scan batch by batch: scales them to metres, counts and leaves out what
/// is not finite, invalid or missing, crops and decimates. Memory is taken for what is kept and one
/// batch more.
class CloudSink {
 public:
  /// Writes points [begin, end) of a batch to the cloud's arrays from index `at` on. A point that
  /// the file marks as invalid or missing gets a NaN as its first coordinate and is counted in the
  /// result.
  using Fill = std::function<DroppedPoints(Cloud& cloud, std::size_t at, std::size_t begin,
                                           std::size_t end)>;

  CloudSink(const Channels& channels, const ReadOptions& options);

  /// Takes memory for `count` points to come, unless most of them will be left out.
  void reserve(std::size_t count);
  /// Adds a batch of `count` points; `fill` is called for chunks side by side.
  void append(std::size_t count, const Fill& fill);
  /// The same with pieces of the given sizes: `fill` writes piece `piece` from index `at` on.
  using FillPiece = std::function<DroppedPoints(Cloud& cloud, std::size_t at, std::size_t piece)>;
  void append_pieces(const std::vector<std::size_t>& sizes, const FillPiece& fill);
  /// The cloud; the sink is empty afterwards.
  Cloud take();

 private:
  void resize(std::size_t count);
  /// Applies the unit to points [begin, end); returns how many are not finite.
  std::size_t scale_and_check(std::size_t begin, std::size_t end);
  void compact(std::size_t begin, std::size_t end);

  Cloud cloud_;
  Channels channels_;
  ReadOptions options_;
  std::uint64_t candidates_ = 0;  ///< valid points inside the crop so far
};

/// Points in one batch of a binary reader.
inline constexpr std::size_t batch_points = std::size_t{1} << 21;

}  // namespace alea
