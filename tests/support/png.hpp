#pragma once

#include <string>

#include "alea/report/picture.hpp"

namespace alea::testing {

/// The picture in the bytes of a PNG file; without pixels where they are not one.
Picture decode_png(const std::string& bytes);

/// Share of a picture's pixels that have this colour, within `tolerance` in every channel.
double colour_share(const Picture& picture, Rgb colour, int tolerance = 0);

}  // namespace alea::testing
