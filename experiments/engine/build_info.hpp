#pragma once

#include <string>

namespace alea::experiments {

/// The commit that the program was built from, "-dirty" after it where sources had changed,
/// "unknown" outside a git clone.
std::string build_commit();

}  // namespace alea::experiments
