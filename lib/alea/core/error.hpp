#pragma once

#include <stdexcept>
#include <string>

namespace alea {

/// What went wrong, in the classes that the program's exit codes tell apart.
enum class ErrorKind {
  usage,  ///< the call itself is wrong (exit 2)
  input,  ///< a file, a field or a value is wrong, or output cannot be written (exit 3)
};

/// Thrown for misuse and unreadable input. The message is one line: what, where, what to do.
/// Data that are readable but cannot support a result give a Refusal instead.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

inline Error usage_error(const std::string& message) {
  return {ErrorKind::usage, message};
}
inline Error input_error(const std::string& message) {
  return {ErrorKind::input, message};
}

}  // namespace alea
