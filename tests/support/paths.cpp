#include "tests/support/paths.hpp"

namespace alea::testing {

std::string source_dir() {
  return ALEA_SOURCE_DIR;
}

std::string program_path() {
  return ALEA_PROGRAM;
}

}  // namespace alea::testing
