#pragma once

#include <string>

namespace alea::testing {

/// The root of the repository that these tests were built from. A function and not a macro on the
/// command line, so that the other units compile alike in every clone and the compiler's cache
/// serves them all.
std::string source_dir();

/// The built program `alea`.
std::string program_path();

}  // namespace alea::testing
