#pragma once

#include <string>

namespace alea::experiments {

/// The commit that the program was built from, "-dirty" after it where sources had changed,
/// "unknown" outside a git clone.
std::string build_commit();

/// The root of the repository that the program was built from, where the committed sweeps and
/// tables are. A function and not a macro on the command line, so that the other units compile
/// alike in every clone and the compiler's cache serves them all.
std::string data_dir();

}  // namespace alea::experiments
