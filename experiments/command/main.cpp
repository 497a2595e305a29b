#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>

#include "alea/core/error.hpp"
#include "alea/core/version.hpp"
#include "alea/io/atomic_file.hpp"
#include "alea/io/input_file.hpp"
#include "experiments/command/calibrate.hpp"
#include "experiments/command/command.hpp"
#include "experiments/command/sweep.hpp"

namespace {

using namespace alea::command;

// Ctrl-C ends at once: unfinished files go, finished ones are whole, since every file is renamed
// into place.
extern "C" void on_interrupt(int) {
  alea::remove_unfinished_files();
  ::_exit(exit_interrupted);
}

// A mapped input that another program cuts short while it is read: one line and the exit code for
// bad input, with calls that a signal handler may make.
extern "C" void on_bus_error(int, siginfo_t* info, void*) {
  const char* path = alea::mapped_path_of(info->si_addr);
  alea::remove_unfinished_files();
  if (path == nullptr) ::_exit(exit_internal);
  const char* const parts[] = {
      "alea: ", path, ": became shorter while it was read; read it again when it is complete\n"};
  for (const char* part : parts)
    if (::write(STDERR_FILENO, part, std::strlen(part)) < 0) break;
  ::_exit(exit_input);
}

void install_handlers() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  // A write beyond the limit on a file's size then fails like one on a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  struct sigaction action {};
  action.sa_sigaction = on_bus_error;
  action.sa_flags = SA_SIGINFO;
  ::sigaction(SIGBUS, &action, nullptr);
}

int run(int argc, char** argv) {
  CLI::App app{"alea: registers laser scans by geometry that can be checked"};
  app.set_version_flag("--version", std::string("alea ") + alea::version());
  app.require_subcommand(1);
  int exit_code = exit_done;
  for (const AddSubcommand add : {
           add_info,
           add_convert,
           add_merge,
           add_evaluate,
           add_apply,
           add_transform,
           add_simulate,
           add_plan,
           add_calibrate,
           add_register,
           add_measure,
           add_print,
           add_acceptance,
           add_reproduce,
           add_sweep,
       })
    add(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    const auto is_first = [&](const CLI::App* sub) { return sub->check_name(argv[1]); };
    const auto subcommands = app.get_subcommands({});
    const bool unknown = argc > 1 && argv[1][0] != '-' &&
                         std::none_of(subcommands.begin(), subcommands.end(), is_first);
    const std::string what =
        unknown ? fmt::format("'{}' is not a subcommand", argv[1]) : error.what();
    fmt::print(stderr, "alea: {}; --help tells more\n", one_line(what));
    return exit_usage;
  }
  return exit_code;
}

// What was printed and could not be written (disk full) is no result.
void flush_output() {
  std::cout.flush();
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout)
    throw alea::input_error(
        fmt::format("standard output: cannot write: {}; is the disk full or the pipe closed?",
                    std::strerror(errno)));
}

}  // namespace

int main(int argc, char** argv) {
  install_handlers();
  try {
    const int exit_code = run(argc, argv);
    flush_output();
    return exit_code;
  } catch (const alea::Error& error) {
    fmt::print(stderr, "alea: {}\n", one_line(error.what()));
    return error.kind() == alea::ErrorKind::usage ? exit_usage : exit_input;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "alea: out of memory; thin large scans with `alea convert --decimate`\n");
    return exit_internal;
  } catch (const std::exception& error) {
    if (std::ferror(stdout) != 0) {
      fmt::print(stderr, "alea: standard output: cannot write: {}\n", one_line(error.what()));
      return exit_input;
    }
    fmt::print(stderr, "alea: internal error: {}; please report it with the command line\n",
               one_line(error.what()));
    return exit_internal;
  }
}
