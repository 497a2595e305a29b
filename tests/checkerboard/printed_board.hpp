#pragma once

#include "alea/checkerboard/board_finder.hpp"
#include "alea/simulate/scene.hpp"

namespace alea {

/// The board as the simulator takes it.
inline Checkerboard printed(const BoardSpec& board) {
  Checkerboard out;
  out.columns = board.columns;
  out.rows = board.rows;
  out.cell_m = board.cell_m;
  return out;
}

inline BoardOptions options_for(const BoardSpec& board) {
  BoardOptions options;
  options.board = board;
  return options;
}

}  // namespace alea
