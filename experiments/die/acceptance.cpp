#include "experiments/die/acceptance.hpp"

namespace alea::acceptance {

std::vector<Topic> die_topics() {
  return {};
}

}  // namespace alea::acceptance
