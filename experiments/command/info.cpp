#include <fmt/format.h>

#include "experiments/command/command.hpp"
namespace alea::command {
void add_info(CLI::App&, int&) {}
}  // namespace alea::command
