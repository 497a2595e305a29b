#include "experiments/command/reading.hpp"

#include <fmt/format.h>

#include <sstream>

#include "alea/core/error.hpp"

namespace alea::command {
namespace {

std::vector<std::string> split_names(const std::string& list) {
  std::vector<std::string> names;
  std::istringstream in(list);
  for (std::string name; std::getline(in, name, ',');) {
    if (name.empty())
      throw usage_error(
          fmt::format("--columns: an empty name in '{}'; write e.g. x,y,z,intensity", list));
    names.push_back(name);
  }
  return names;
}

}  // namespace

void add_reading_options(CLI::App& app, ReadingOptions& options) {
  app.add_option("--unit", options.unit, "Unit of length in the input: m, mm or ft (0.3048 m)")
      ->check(CLI::IsMember({"m", "mm", "ft"}))
      ->capture_default_str();
  app.add_option("--columns", options.columns,
                 "Columns of a text input, e.g. x,y,z,intensity,red,green,blue,nx,ny,nz; other "
                 "names are skipped");
  app.add_flag("--apply-pose", options.apply_pose,
               "Move the points by the pose in the file (E57, PTX); several scans of one file "
               "always are");
}

ReadOptions read_options(const ReadingOptions& options) {
  ReadOptions out;
  out.unit_m = options.unit == "mm" ? 0.001 : options.unit == "ft" ? 0.3048 : 1;
  out.columns = split_names(options.columns);
  out.apply_pose = options.apply_pose;
  return out;
}

}  // namespace alea::command
