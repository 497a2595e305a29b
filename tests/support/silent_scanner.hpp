#pragma once

#include "alea/simulate/scanner.hpp"

namespace alea::testing {

/// A scanner without noise of any cause.
inline Scanner silent() {
  Scanner scanner;
  scanner.noise = {0, 0, 0, 0};
  scanner.intensity_noise = 0;
  return scanner;
}

}  // namespace alea::testing
