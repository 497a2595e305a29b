#pragma once

#include <array>
#include <cstdint>

namespace alea {

/// Philox4x32-10: four 32-bit words from a 128-bit counter and a 64-bit key.
/// Salmon, Moraes, Dror, Shaw 2011, Parallel random numbers: as easy as 1, 2, 3 (SC'11),
/// doi 10.1145/2063384.2063405.
std::array<std::uint32_t, 4> philox4x32(const std::array<std::uint32_t, 4>& counter,
                                        const std::array<std::uint32_t, 2>& key);

/// What a random stream is for. A stream of one purpose never touches another's numbers.
enum class Purpose : std::uint32_t {
  range_noise,
  grazing_noise,
  surface_noise,
  angular_noise,
  footprint,
  intensity_noise,
  die_shape,
  scene_layout,
  station,
  plane_detector,
  sampling,
  bootstrap,
  test,
  experiment,
  mixed_pixel
};

/// Names a stream: the same key gives the same numbers on every machine, for any thread count and
/// any order.
struct StreamKey {
  std::uint64_t seed = 1;
  std::uint32_t experiment = 0;
  std::uint64_t trial = 0;
  std::uint32_t scan = 0;
  Purpose purpose = Purpose::test;
};

/// Random access into a counter-based stream: element i is a pure function of (key, i).
class RandomStream {
 public:
  explicit RandomStream(const StreamKey& key);

  /// Two independent uniforms in (0, 1) for element `index`.
  std::array<double, 2> uniform2_at(std::uint64_t index) const;
  /// Two independent standard normals for element `index` (Box and Muller 1958).
  std::array<double, 2> normal2_at(std::uint64_t index) const;

  double uniform_at(std::uint64_t index) const { return uniform2_at(index)[0]; }
  double normal_at(std::uint64_t index) const { return normal2_at(index)[0]; }

  /// Sequential use: the next element of the stream.
  double uniform() { return uniform_at(next_++); }
  double normal() { return normal_at(next_++); }
  /// Uniform integer in [0, n), n > 0.
  std::uint64_t below(std::uint64_t n);

 private:
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 2> high_;
  std::uint64_t next_ = 0;
};

}  // namespace alea
