#include "experiments/command/register.hpp"

namespace alea::command {

void add_register(CLI::App& app, int& exit_code) {
  CLI::App* parent = app.add_subcommand("register", "Find the rigid transform between scans");
  parent->require_subcommand(1);
  for (const AddSubcommand add :
       {add_register_die, add_register_spheres, add_register_planes, add_register_checkerboards,
        add_register_markerless, add_register_network})
    add(*parent, exit_code);
}

}  // namespace alea::command
