#include "experiments/engine/folder.hpp"

#include <fmt/format.h>

#include <system_error>

#include "alea/core/error.hpp"

namespace alea::experiments {

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder))
    throw input_error(fmt::format("{}: cannot be made a folder ({}); choose another --out",
                                  folder.string(), error.message()));
}

}  // namespace alea::experiments
