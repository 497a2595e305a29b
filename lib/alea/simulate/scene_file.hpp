#pragma once

#include <filesystem>

#include "alea/simulate/scene.hpp"

namespace alea {

/// Reads a scene and its stations from a TOML file (keys: README.md of this folder; metres, the
/// angles in the unit that their key names). Throws Error(input) with file, line, key, value and
/// expectation for anything else: an unknown key, a wrong type, a size that is not positive, a die
/// that does not close, two stations of one name, no station at all.
Scene load_scene(const std::filesystem::path& file);

}  // namespace alea
