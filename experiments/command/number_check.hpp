#pragma once

#include <CLI/CLI.hpp>

namespace alea::command {

/// Checks that an option's number is zero or more and says so; CLI's own check prints all digits of
/// the largest number there is.
CLI::Validator not_negative();

}  // namespace alea::command
