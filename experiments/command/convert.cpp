#include <fmt/format.h>

#include <memory>
#include <utility>

#include "alea/core/parallel.hpp"
#include "alea/io/cloud_file.hpp"
#include "experiments/command/command.hpp"
#include "experiments/command/reading.hpp"

namespace alea::command {
namespace {

struct Convert {
  std::string in;
  std::string out;
  CommonOptions common;
  ReadingOptions reading;
  ThinningOptions thinning;
};

int run(const Convert& convert) {
  const ThreadLimit limit(convert.common.threads);
  ReadOptions options = read_options(convert.reading);
  options.accept_non_rigid_pose = true;
  thin(convert.thinning, options);
  std::vector<ScanFile> scans = read_scans(convert.in, options);
  const std::vector<std::string> warnings = pose_warnings(scans);
  write_scans(convert.out, std::move(scans), options);
  for (const std::string& warning : warnings) fmt::print(stderr, "alea: warning: {}\n", warning);
  return exit_done;
}

}  // namespace

void add_convert(CLI::App& app, int& exit_code) {
  auto convert = std::make_shared<Convert>();
  CLI::App* sub = app.add_subcommand("convert", "Writes a scan in another format, in metres");
  sub->add_option("in", convert->in, "Scan to read; file.e57#2 is the second one")->required();
  sub->add_option("out", convert->out, "File to write; the extension names the format")->required();
  add_reading_options(*sub, convert->reading);
  add_thinning_options(*sub, convert->thinning);
  sub->add_option("--threads", convert->common.threads, "Threads (0: all cores)")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  sub->callback([convert, &exit_code] { exit_code = run(*convert); });
}

}  // namespace alea::command
