#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace alea {

/// Called now and then with the stage's name, the steps done and the steps in all. May be empty.
/// The library itself prints nothing.
using ProgressCallback =
    std::function<void(const std::string& stage, std::uint64_t done, std::uint64_t total)>;

}  // namespace alea
