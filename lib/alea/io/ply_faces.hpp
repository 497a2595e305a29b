#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "alea/io/input_file.hpp"

namespace alea {

/// One face of a PLY file and where it stands, for messages.
struct PlyFace {
  std::vector<std::int64_t> corners;
  std::string where;
};

/// The lists vertex_indices (or vertex_index) of the element `face`; empty where a PLY file has
/// none. Throws Error(input) for a file that ends early or holds what is no index.
std::vector<PlyFace> read_ply_faces(const InputFile& file);

}  // namespace alea
