#include "experiments/command/command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "alea/core/error.hpp"
#include "alea/io/atomic_file.hpp"
#include "experiments/command/number_check.hpp"

namespace alea::command {
namespace {

using Clock = std::chrono::steady_clock;

struct Bar {
  bool terminal = false;
  std::string stage;
  Clock::time_point stage_start;
  Clock::time_point last_line;
};

void print_bar(Bar& bar, std::uint64_t done, std::uint64_t total, double elapsed_s) {
  const double share = total > 0 ? static_cast<double>(done) / static_cast<double>(total) : 0;
  const double remaining_s = share > 0 ? elapsed_s * (1 - share) / share : 0;
  const double rate = elapsed_s > 0 ? static_cast<double>(done) / elapsed_s : 0;
  if (bar.terminal) {
    const int width = 30;
    const int filled = static_cast<int>(share * width);
    fmt::print(stderr, "\r{:<24} [{:#<{}}{:.<{}}] {:3.0f} %  {:.3g}/s  {:.0f} s left \x1b[K",
               bar.stage, "", filled, "", width - filled, share * 100, rate, remaining_s);
    if (done >= total) fmt::print(stderr, "\n");
  } else if (elapsed_s <= 0) {
    fmt::print(stderr, "{}: {} of {}\n", bar.stage, done, total);
  } else {
    fmt::print(stderr, "{}: {} of {} ({:.3g}/s, {:.0f} s left)\n", bar.stage, done, total, rate,
               remaining_s);
  }
  std::fflush(stderr);
}

}  // namespace

void add_common_options(CLI::App& app, CommonOptions& options) {
  app.add_option("--json", options.json,
                 "Write the result as JSON to this file ('-': standard output)");
  app.add_option("--threads", options.threads,
                 "Threads (0: all cores); the result is the same for any number")
      ->check(not_negative())
      ->capture_default_str();
  app.add_option("--seed", options.seed, "Seed of every random choice")
      ->check(not_negative())
      ->capture_default_str();
  app.add_flag("--quiet", options.quiet, "No progress on standard error");
}

void write_json(const CommonOptions& options, const nlohmann::json& result) {
  if (options.json.empty()) return;
  // Names out of a damaged file need not be UTF-8.
  const std::string text =
      result.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  if (options.json != "-") {
    write_file_atomically(options.json, text);
    return;
  }
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw input_error(
        "standard output: cannot write the JSON result; is the disk full or the pipe closed?");
}

ProgressCallback make_progress(const CommonOptions& options) {
  if (options.quiet) return {};
  auto bar = std::make_shared<Bar>();
  bar->terminal = ::isatty(STDERR_FILENO) == 1;
  return [bar](const std::string& stage, std::uint64_t done, std::uint64_t total) {
    const auto now = Clock::now();
    if (stage != bar->stage) *bar = {bar->terminal, stage, now, {}};
    const double interval_s = bar->terminal ? 0.1 : 10.0;
    const bool due = std::chrono::duration<double>(now - bar->last_line).count() >= interval_s;
    if (!due && done < total) return;
    bar->last_line = now;
    print_bar(*bar, done, total, std::chrono::duration<double>(now - bar->stage_start).count());
  };
}

std::string one_line(std::string text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    // 0xC2 0x80 to 0xC2 0x9F: the second set of control characters in UTF-8.
    const bool second =
        byte == 0xC2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xA0;
    if (byte < 0x20 || byte == 0x7F || second) text[i] = '?';
  }
  return text;
}

int report_refusal(const Refusal& refusal) {
  fmt::print(stderr, "alea: refused ({}): {}\n", to_string(refusal.code), refusal.message);
  return exit_refused;
}

std::optional<std::array<double, 3>> parse_point(const std::string& option,
                                                 const std::string& text) {
  if (text.empty()) return std::nullopt;
  std::array<double, 3> point{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (int i = 0; i < 3; ++i) {
    const auto [next, error] = std::from_chars(at, end, point[i]);
    const bool separated = i < 2 ? next != end && *next == ',' : next == end;
    if (error != std::errc{} || !separated || !std::isfinite(point[i]))
      throw usage_error(fmt::format("{}: '{}' is not X,Y,Z in metres; write e.g. {}=1.5,-2,0",
                                    option, text, option));
    at = next + 1;
  }
  return point;
}

}  // namespace alea::command
