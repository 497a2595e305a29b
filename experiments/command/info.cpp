#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "alea/cloud/spacing.hpp"
#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/core/version.hpp"
#include "alea/io/cloud_file.hpp"
#include "experiments/command/command.hpp"
#include "experiments/command/reading.hpp"

namespace alea::command {
namespace {

struct Info {
  std::string path;
  CommonOptions common;
  ReadingOptions reading;
  ThinningOptions thinning;
};

nlohmann::json vector_json(const std::optional<Eigen::Vector3d>& v) {
  if (!v) return nullptr;
  return {v->x(), v->y(), v->z()};
}

std::optional<Eigen::AlignedBox3d> bounds(const Cloud& cloud) {
  if (cloud.empty()) return std::nullopt;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : cloud.positions) box.extend(p);
  return box;
}

// Every field of every scan, in the order met.
std::vector<std::string> all_fields(const std::vector<ScanFile>& scans) {
  std::vector<std::string> fields;
  for (const ScanFile& scan : scans)
    for (const std::string& field : scan.fields)
      if (std::find(fields.begin(), fields.end(), field) == fields.end()) fields.push_back(field);
  return fields;
}

// Where each scanner stood, in the frame that the points are reported in.
nlohmann::json scanner_positions(const std::vector<ScanFile>& scans, bool applied) {
  nlohmann::json out = nlohmann::json::array();
  for (const ScanFile& scan : scans) {
    std::optional<Eigen::Vector3d> position = scan.cloud.scanner_position;
    if (position && scan.pose && applied)
      position = (*scan.pose * position->homogeneous()).head<3>().eval();
    out.push_back(vector_json(position));
  }
  return out;
}

void print(const Info& info, const nlohmann::json& result) {
  const auto text = [&](const char* key) {
    return result.at(key).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  };
  fmt::print("{}\n", info.path);
  fmt::print("points            {}\n", text("points"));
  fmt::print("dropped           {}\n", text("dropped"));
  fmt::print("scans             {}\n", text("scans"));
  fmt::print("fields            {}\n", text("fields"));
  fmt::print("min               {} m\n", text("min_m"));
  fmt::print("max               {} m\n", text("max_m"));
  fmt::print("spacing           {} m\n", text("spacing_m"));
  fmt::print("scanner position  {} m\n", text("scanner_position_m"));
  for (const auto& warning : result.at("warnings"))
    fmt::print("warning           {}\n", warning.get<std::string>());
}

int run(const Info& info) {
  std::error_code ignored;
  if (!info.common.json.empty() &&
      std::filesystem::equivalent(info.common.json, info.path, ignored))
    throw usage_error(
        fmt::format("--json: {} is the scan itself; name another file", info.common.json));
  const ThreadLimit limit(info.common.threads);
  ReadOptions options = read_options(info.reading);
  options.accept_non_rigid_pose = true;
  thin(info.thinning, options);
  std::vector<ScanFile> scans = read_scans(info.path, options);
  const bool applied = scans.size() > 1 || options.apply_pose;
  nlohmann::json result{{"alea", version()},
                        {"file", info.path},
                        {"scans", scans.size()},
                        {"fields", all_fields(scans)},
                        {"scanner_position_m", scanner_positions(scans, applied)},
                        {"warnings", pose_warnings(scans)}};
  const Cloud cloud = merged_scans(std::move(scans), options);
  const std::optional<Eigen::AlignedBox3d> box = bounds(cloud);
  const std::optional<double> spacing = median_spacing_m(cloud);
  result["points"] = cloud.size();
  result["dropped"] = {{"non_finite", cloud.dropped.non_finite},
                       {"invalid", cloud.dropped.invalid},
                       {"missing", cloud.dropped.missing}};
  result["min_m"] = box ? vector_json(box->min()) : nullptr;
  result["max_m"] = box ? vector_json(box->max()) : nullptr;
  result["spacing_m"] = spacing ? nlohmann::json(*spacing) : nullptr;
  if (info.common.json != "-") print(info, result);
  write_json(info.common, result);
  return exit_done;
}

}  // namespace

void add_info(CLI::App& app, int& exit_code) {
  auto info = std::make_shared<Info>();
  CLI::App* sub = app.add_subcommand("info",
                                     "Points, extent (m), fields, spacing (m) and scanner "
                                     "position (m) of a scan");
  sub->add_option("cloud", info->path,
                  "PLY, PCD, XYZ, TXT, CSV, PTS, PTX, E57 or LAS; file.e57#2 is the second scan")
      ->required();
  add_reading_options(*sub, info->reading);
  add_thinning_options(*sub, info->thinning);
  add_common_options(*sub, info->common);
  sub->callback([info, &exit_code] { exit_code = run(*info); });
}

}  // namespace alea::command
