#include "alea/io/cloud_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>

#include "alea/core/error.hpp"
#include "alea/io/formats.hpp"

namespace alea {
namespace {

struct Source {
  std::string path;
  std::size_t scan = 0;  ///< counted from one; 0 for all
};

// "file.e57#2" is scan 2, unless a file of exactly this name exists.
Source parse_source(const std::string& path) {
  const auto mark = path.rfind('#');
  std::error_code ignored;
  if (mark == std::string::npos || std::filesystem::exists(path, ignored)) return {path};
  Source source{path.substr(0, mark)};
  const char* const end = path.data() + path.size();
  const auto [next, error] = std::from_chars(path.data() + mark + 1, end, source.scan);
  if (error == std::errc{} && next == end && source.scan != 0) return source;
  if (!std::filesystem::exists(source.path, ignored)) return {path};
  throw input_error(fmt::format("{}: '{}' is not the number of a scan; expected #1, #2, ...",
                                source.path, path.substr(mark)));
}

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension.empty() ? extension : extension.substr(1);
}

bool is_text(const std::string& extension) {
  return extension == "xyz" || extension == "txt" || extension == "csv" || extension == "asc";
}

// Formats that are known and not read, with what to do about it.
void refuse_known(const InputFile& file, const std::string& extension) {
  const std::string_view bytes = file.bytes();
  const auto refuse = [&](const char* format, const char* advice) {
    throw input_error(fmt::format("{}: {} is not read; {}", file.path(), format, advice));
  };
  if (extension == "laz") refuse("LAZ (compressed LAS)", "decompress it to LAS first");
  if (bytes.starts_with("OFF") || bytes.starts_with("COFF") || extension == "off")
    refuse("OFF (a mesh)", "export the points as PLY");
  if (bytes.starts_with("# vtk") || extension == "vtk" || extension == "vtp")
    refuse("VTK", "export the points as PLY");
  if (extension == "obj") refuse("OBJ (a mesh)", "export the points as PLY");
}

bool keeps_poses(const std::string& extension) {
  return extension == "ptx" || extension == "e57";
}

// Not an initializer list, which would copy the points.
std::vector<ScanFile> alone(ScanFile scan) {
  std::vector<ScanFile> scans;
  scans.push_back(std::move(scan));
  return scans;
}

std::vector<ScanFile> read_format(const InputFile& file, const ReadOptions& options) {
  const std::string_view bytes = file.bytes();
  const std::string extension = extension_of(file.path());
  refuse_known(file, extension);
  if (bytes.starts_with("ASTM-E57") || extension == "e57") return read_e57(file, options);
  if (bytes.starts_with("LASF") || extension == "las") return alone(read_las(file, options));
  if (bytes.starts_with("ply") || extension == "ply") return alone(read_ply(file, options));
  if (bytes.starts_with("# .PCD") || bytes.starts_with("VERSION") || extension == "pcd")
    return alone(read_pcd(file, options));
  if (extension == "ptx") return read_ptx(file, options);
  if (extension == "pts") return read_pts(file, options);
  if (is_text(extension)) return alone(read_xyz(file, options));
  throw input_error(fmt::format(
      "{}: unknown format '{}'; expected ply, pcd, xyz, txt, csv, asc, pts, ptx, e57 or "
      "las",
      file.path(), extension));
}

}  // namespace

void check_scan_count(const std::string& path, std::size_t scans) {
  if (scans <= scan_limit) return;
  throw input_error(
      fmt::format("{}: more than {} scans; split the file or merge its scans", path, scan_limit));
}

std::vector<ScanFile> read_scans(const std::string& path, const ReadOptions& options) {
  const Source source = parse_source(path);
  const InputFile file(source.path);
  std::vector<ScanFile> scans = read_format(file, options);
  file.check_unchanged();
  if (source.scan == 0) return scans;
  if (source.scan > scans.size())
    throw input_error(fmt::format("{}: scan {} of {}; the number after # counts from 1",
                                  source.path, source.scan, scans.size()));
  return alone(std::move(scans[source.scan - 1]));
}

Cloud read_cloud(const std::string& path, const ReadOptions& options) {
  return merged_scans(read_scans(path, options), options);
}

void write_cloud(const std::string& path, const Cloud& cloud) {
  const std::string extension = extension_of(path);
  if (extension == "ply") return write_ply(path, cloud);
  if (extension == "pcd") return write_pcd(path, cloud);
  if (is_text(extension)) return write_xyz(path, cloud, extension == "csv" ? ',' : ' ');
  if (keeps_poses(extension)) return write_scans(path, {{cloud, std::nullopt, "", {}}});
  throw input_error(
      fmt::format("{}: cannot write format '{}'; expected ply, pcd, xyz, txt, csv, asc, ptx or e57",
                  path, extension));
}

void write_scans(const std::string& path, std::vector<ScanFile> scans, const ReadOptions& options) {
  const std::string extension = extension_of(path);
  if (!keeps_poses(extension)) return write_cloud(path, merged_scans(std::move(scans), options));
  if (options.apply_pose) {
    for (ScanFile& scan : scans) {
      const std::string name = scan.name;
      scan = {merged_scans(alone(std::move(scan)), options), std::nullopt, name, {}};
    }
  }
  extension == "ptx" ? write_ptx(path, scans) : write_e57(path, scans);
}

}  // namespace alea
