#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace alea {

/// A colour of a picture, 8 bits each.
struct Rgb {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  bool operator==(const Rgb&) const = default;
};

/// An 8-bit picture: red, green, blue, row by row from the upper left.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> samples;  ///< 3 * width * height

  Rgb at(int x, int y) const;
};

/// The bytes of a PNG file; the same picture gives the same bytes. Throws Error(usage) for a
/// picture without pixels.
std::string encode_png(const Picture& picture);

/// Writes a PNG file, whole or not at all. Throws Error(input) where it cannot be written.
void write_png(const std::filesystem::path& path, const Picture& picture);

}  // namespace alea
