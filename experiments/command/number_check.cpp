#include "experiments/command/number_check.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace alea::command {

CLI::Validator not_negative() {
  return {[](const std::string& text) {
            double value = 0;
            const char* const last = text.data() + text.size();
            const auto [end, error] = std::from_chars(text.data(), last, value);
            const bool number = error == std::errc{} && end == last && std::isfinite(value);
            return number && value >= 0 ? std::string{}
                                        : fmt::format("'{}' is not a number of zero or more", text);
          },
          "NONNEGATIVE"};
}

}  // namespace alea::command
