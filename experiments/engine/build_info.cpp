#include "experiments/engine/build_info.hpp"

#include "alea_commit.hpp"

namespace alea::experiments {

std::string build_commit() {
  return ALEA_COMMIT;
}

}  // namespace alea::experiments
