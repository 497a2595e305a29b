#include "experiments/command/control_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "alea/core/error.hpp"
#include "alea/io/text_lines.hpp"

namespace alea::command {
namespace {

NamedPoint parse_line(const std::string& path, int number, std::string line) {
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == ',' || c == ';' || c == '\t'; }, ' ');
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  const auto bad = [&](const std::string& why) {
    return input_error(fmt::format(
        "{}: line {}: {}; write: name X Y Z [standard deviation], metres", path, number, why));
  };
  if (words.size() != 4 && words.size() != 5) throw bad(fmt::format("{} words", words.size()));
  std::vector<double> values;
  for (std::size_t k = 1; k < words.size(); ++k) {
    const std::optional<double> value = parse_number(words[k]);
    if (!value || !std::isfinite(*value)) throw bad(fmt::format("'{}' is no number", words[k]));
    values.push_back(*value);
  }
  NamedPoint point{words[0], {values[0], values[1], values[2]}, std::nullopt};
  if (values.size() == 4) {
    if (!(values[3] > 0)) throw bad("the standard deviation must be positive");
    point.sd_m = values[3];
  }
  return point;
}

}  // namespace

void add_control_options(CLI::App& app, ControlOptions& options) {
  app.add_option("--control", options.control_file,
                 "Control points in the site's system (one a line: name X Y Z [sd], m): the result "
                 "is tied to it, with residuals; three or more");
  app.add_option("--targets", options.targets_file,
                 "The same points as measured in the master's frame (name x y z [sd], m): target "
                 "centres or picked points, matched by name");
}

std::vector<NamedPoint> read_named_points(const std::string& path) {
  std::ifstream file(path);
  if (!file)
    throw input_error(fmt::format("{}: cannot read; a file of named points is needed", path));
  std::vector<NamedPoint> points;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    line.erase(std::remove(line.begin(), line.end(), '\r'), line.end());
    const auto first = line.find_first_not_of(" \t");
    if (first == std::string::npos || line[first] == '#') continue;
    points.push_back(parse_line(path, number, line));
  }
  if (points.empty())
    throw input_error(fmt::format("{}: no point; write: name X Y Z [sd], metres", path));
  return points;
}

void tie_to_control(const ControlOptions& options, const std::vector<NamedPoint>& measured,
                    std::vector<Registration>& registrations) {
  if (options.control_file.empty()) return;
  const auto tie = tie_to_site(
      read_named_points(options.control_file),
      options.targets_file.empty() ? measured : read_named_points(options.targets_file));
  for (Registration& registration : registrations) {
    if (!registration.master_from_slave) continue;
    if (tie) {
      registration.site = *tie;
      continue;
    }
    registration.refusal = tie.refusal();
    registration.master_from_slave.reset();
    registration.covariance.reset();
  }
}

}  // namespace alea::command
