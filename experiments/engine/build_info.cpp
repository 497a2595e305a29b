#include "experiments/engine/build_info.hpp"

#include "alea_commit.hpp"

namespace alea::experiments {

std::string build_commit() {
  return ALEA_COMMIT;
}

std::string data_dir() {
  return ALEA_DATA_DIR;
}

}  // namespace alea::experiments
