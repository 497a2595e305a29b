#pragma once

#include <string>

#include "alea/checkerboard/board.hpp"

namespace alea {

/// One PDF page on which the checkerboard has its true size (1:1), with a light margin of half a
/// cell, a cross of hair lines at its centre outside of the pattern, and a ruler to check the
/// printer's scale by. Printed without "fit to page" the cells measure what they say.
std::string checkerboard_pdf(const BoardSpec& board);

/// The six facets of a die of this edge (m), a page each at 1:1: pips of 0.09 edges radius, 0.25
/// edges apart, an outline to cut along.
std::string pips_pdf(double edge_m);

}  // namespace alea
