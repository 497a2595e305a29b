#include "alea/report/picture.hpp"

#include <fmt/format.h>
#include <png.h>

#include "alea/core/error.hpp"
#include "alea/io/atomic_file.hpp"

namespace alea {

Rgb Picture::at(int x, int y) const {
  const std::size_t i = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                             static_cast<std::size_t>(x));
  return {samples[i], samples[i + 1], samples[i + 2]};
}

std::string encode_png(const Picture& picture) {
  if (picture.width <= 0 || picture.height <= 0)
    throw usage_error("encode_png: the picture has no pixels");
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  const auto encode = [&](void* memory, png_alloc_size_t& bytes) {
    if (png_image_write_to_memory(&image, memory, &bytes, 0, picture.samples.data(), 0, nullptr) ==
        0)
      throw usage_error(fmt::format("encode_png: {}", image.message));
  };
  png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string out(bytes, '\0');
  encode(out.data(), bytes);
  out.resize(bytes);
  return out;
}

void write_png(const std::filesystem::path& path, const Picture& picture) {
  write_file_atomically(path, encode_png(picture));
}

}  // namespace alea
