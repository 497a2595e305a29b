#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "alea/core/error.hpp"
#include "alea/io/cloud_file.hpp"
#include "alea/io/e57_pages.hpp"

namespace alea::testing {

/// Whole pages with right checksums and the right length in the header, so that what is behind the
/// checksums of an E57 file is reached too.
inline std::string with_e57_checksums(std::string bytes) {
  bytes.resize((bytes.size() + 1023) / 1024 * 1024, '\0');
  const std::uint64_t size = bytes.size();
  if (size > 0) std::memcpy(bytes.data() + 16, &size, sizeof(size));
  for (std::size_t page = 0; page < bytes.size(); page += 1024) {
    const std::uint32_t crc = crc32c(std::string_view(bytes).substr(page, 1020));
    for (std::size_t i = 0; i < 4; ++i)
      bytes[page + 1020 + i] = static_cast<char>(crc >> (24 - 8 * i) & 255);
  }
  return bytes;
}

/// Reads bytes as a file of this extension. Returns whether they made scans; an Error(input) of one
/// line is the other good answer. Anything else ends the process.
inline bool read_as(const std::string& extension, std::string bytes) {
  static const std::string stem =
      (std::filesystem::temp_directory_path() / ("alea-fuzz-" + std::to_string(::getpid())))
          .string();
  const std::string path = stem + "." + extension;
  if (extension == "e57") bytes = with_e57_checksums(std::move(bytes));
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<long>(bytes.size()));
  bool readable = true;
  try {
    for (const ScanFile& scan : read_scans(path))
      for (const Eigen::Vector3d& p : scan.cloud.positions)
        if (!p.allFinite()) std::abort();
  } catch (const Error& error) {
    readable = false;
    if (error.kind() != ErrorKind::input ||
        std::string(error.what()).find('\n') != std::string::npos)
      std::abort();
  }
  std::filesystem::remove(path);
  return readable;
}

}  // namespace alea::testing
