#include "experiments/command/reading.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include "alea/core/error.hpp"
#include "alea/io/field_role.hpp"
#include "alea/io/text_lines.hpp"

namespace alea::command {
namespace {

std::vector<std::string> split_names(const std::string& list) {
  std::vector<std::string> names;
  std::istringstream in(list);
  for (std::string name; std::getline(in, name, ',');) {
    if (name.empty())
      throw usage_error(
          fmt::format("an empty value in '{}'; separate values by single commas", list));
    names.push_back(name);
  }
  return names;
}

void check_columns(const std::vector<std::string>& columns) {
  if (columns.empty()) return;
  if (!channels_of(columns).positions)
    throw usage_error(fmt::format("--columns: no x, y and z among {}; write e.g. x,y,z,intensity",
                                  fmt::join(columns, ",")));
  const std::vector<std::optional<FieldRole>> roles = roles_of(columns);
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (!roles[i] && role_of(columns[i]))
      throw usage_error(
          fmt::format("--columns: '{}' has been named before; call a column 'skip' "
                      "to leave it out",
                      columns[i]));
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

void add_thinning_options(CLI::App& app, ThinningOptions& options) {
  app.add_option("--decimate", options.decimate,
                 "Keep every N-th of the valid points inside the crop")
      ->check(CLI::Range(1U, std::numeric_limits<std::uint32_t>::max()))
      ->capture_default_str();
  app.add_option("--crop", options.crop,
                 "Keep the points inside this box (m, the scan's own frame): "
                 "--crop=XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX");
}

void thin(const ThinningOptions& options, ReadOptions& out) {
  out.keep_every = options.decimate;
  if (options.crop.empty()) return;
  std::vector<double> values;
  for (const std::string& word : split_names(options.crop)) {
    const std::optional<double> value = parse_number(word);
    if (!value || !std::isfinite(*value))
      throw usage_error(fmt::format("--crop: '{}' is not a number of metres", word));
    values.push_back(*value);
  }
  if (values.size() != 6)
    throw usage_error("--crop: expected XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX in metres");
  out.crop_m = Eigen::AlignedBox3d(Eigen::Vector3d(values[0], values[1], values[2]),
                                   Eigen::Vector3d(values[3], values[4], values[5]));
  if (out.crop_m->isEmpty()) throw usage_error("--crop: a minimum lies above its maximum");
}

ReadOptions read_options(const ReadingOptions& options) {
  ReadOptions out;
  out.unit_m = options.unit == "mm" ? 0.001 : options.unit == "ft" ? 0.3048 : 1;
  out.columns = split_names(options.columns);
  check_columns(out.columns);
  out.apply_pose = options.apply_pose;
  return out;
}

}  // namespace alea::command
