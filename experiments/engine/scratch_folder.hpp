#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "alea/core/error.hpp"

namespace alea::experiments {

/// A folder of its own under the system's temporary one, removed at the end. Throws Error(input)
/// where none can be made.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "alea-acceptance-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw input_error(name + ": cannot make a folder for the experiment; is the disk full?");
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace alea::experiments
