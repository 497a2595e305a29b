#pragma once

#include <vector>

#include "experiments/engine/acceptance.hpp"

namespace alea::acceptance {

/// The topics of the die, in the order in which they run. A new topic is one function declared here
/// and one line in acceptance.cpp.
std::vector<Topic> die_topics();

}  // namespace alea::acceptance
