#include "tests/support/png.hpp"

#include <png.h>

#include <cstdlib>

namespace alea::testing {

Picture decode_png(const std::string& bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) return {};
  image.format = PNG_FORMAT_RGB;
  Picture picture{static_cast<int>(image.width), static_cast<int>(image.height),
                  std::vector<std::uint8_t>(PNG_IMAGE_SIZE(image))};
  if (png_image_finish_read(&image, nullptr, picture.samples.data(), 0, nullptr) == 0) return {};
  return picture;
}

double colour_share(const Picture& picture, Rgb colour, int tolerance) {
  double found = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const Rgb at = picture.at(x, y);
      found += std::abs(at.red - colour.red) <= tolerance &&
               std::abs(at.green - colour.green) <= tolerance &&
               std::abs(at.blue - colour.blue) <= tolerance;
    }
  }
  return found / (picture.width * picture.height);
}

}  // namespace alea::testing
