#include "experiments/engine/pictures.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include "experiments/engine/build_info.hpp"

namespace alea::experiments {

std::string draw_pictures(const std::string& folder) {
  const std::string script = data_dir() + "/scripts/plot.py";
  const pid_t child = ::fork();
  if (child == 0) {
    // Debian's matplotlib serves the system's own Python, which need not be the first on the PATH.
    ::execl("/usr/bin/python3", "python3", script.c_str(), folder.c_str(), nullptr);
    ::_exit(127);
  }
  int status = -1;
  if (child > 0) ::waitpid(child, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
  return "no pictures: " + script + " failed; run scripts/setup figures, then python3 " + script +
         " " + folder;
}

}  // namespace alea::experiments
