#include "alea/core/version.hpp"

namespace alea {

const char* version() {
  return ALEA_VERSION;
}

}  // namespace alea
