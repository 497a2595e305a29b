#pragma once

#include <string>

namespace alea::testing {

struct ShellRun {
  int exit_code = -1;
  std::string output;  ///< standard output and standard error, as they came
};

/// Runs one line of sh and waits for it.
ShellRun run_shell(const std::string& line);

}  // namespace alea::testing
