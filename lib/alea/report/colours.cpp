#include "alea/report/colours.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace alea::colours {

Rgb categorical(std::size_t number) {
  static constexpr std::array<Rgb, 20> palette{{
      {31, 119, 180},  {255, 127, 14},  {44, 160, 44},   {214, 39, 40},   {148, 103, 189},
      {140, 86, 75},   {227, 119, 194}, {188, 189, 34},  {23, 190, 207},  {127, 127, 127},
      {174, 199, 232}, {255, 187, 120}, {152, 223, 138}, {255, 152, 150}, {197, 176, 213},
      {196, 156, 148}, {247, 182, 210}, {219, 219, 141}, {158, 218, 229}, {199, 199, 199},
  }};
  return palette[number % palette.size()];
}

Rgb mixed(Rgb a, Rgb b, double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  const auto channel = [s](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround((1 - s) * from + s * to));
  };
  return {channel(a.red, b.red), channel(a.green, b.green), channel(a.blue, b.blue)};
}

Rgb grey(double value) {
  return mixed(black, white, value);
}

Rgb diverging(double value) {
  constexpr Rgb low{33, 87, 172}, centre{247, 247, 247}, high{190, 24, 43};
  return value < 0 ? mixed(centre, low, -value) : mixed(centre, high, value);
}

}  // namespace alea::colours
