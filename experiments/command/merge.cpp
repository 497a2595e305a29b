#include <fmt/format.h>

#include <memory>
#include <utility>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/io/cloud_file.hpp"
#include "experiments/command/command.hpp"
#include "experiments/command/reading.hpp"

namespace alea::command {
namespace {

struct Merge {
  std::vector<std::string> in;
  std::string out;
  CommonOptions common;
  ReadingOptions reading;
};

int run(const Merge& merge) {
  const ThreadLimit limit(merge.common.threads);
  const ReadOptions options = read_options(merge.reading);
  std::vector<ScanFile> scans;
  for (const std::string& path : merge.in) {
    std::vector<ScanFile> of_file = read_scans(path, options);
    for (std::size_t i = 0; i < of_file.size(); ++i) {
      if (of_file[i].pose && !is_rigid(*of_file[i].pose))
        throw input_error(
            fmt::format("{}: the pose of scan {} is not rigid; convert it with --apply-pose first",
                        path, i + 1));
      scans.push_back(std::move(of_file[i]));
    }
  }
  write_scans(merge.out, std::move(scans), options);
  return exit_done;
}

}  // namespace

void add_merge(CLI::App& app, int& exit_code) {
  auto merge = std::make_shared<Merge>();
  CLI::App* sub = app.add_subcommand(
      "merge",
      "Writes scans into one file: E57 and PTX keep them apart with their poses, the "
      "other formats get one cloud in the common frame (metres)");
  sub->add_option("--out", merge->out, "File to write; the extension names the format")->required();
  sub->add_option("scans", merge->in, "Scans to read, in order")->required();
  add_reading_options(*sub, merge->reading);
  sub->add_option("--threads", merge->common.threads, "Threads (0: all cores)")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  sub->callback([merge, &exit_code] { exit_code = run(*merge); });
}

}  // namespace alea::command
