#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "alea/io/atomic_file.hpp"

namespace alea {

/// Writes the logical bytes of an E57 file as pages of 1024 bytes with their checksums. The first
/// 48 bytes are the file header, which finish() fills in.
class E57PageWriter {
 public:
  explicit E57PageWriter(AtomicFile& file);

  void write(std::string_view bytes);
  /// Pads with zeros to a multiple of four bytes.
  void align();
  std::uint64_t logical() const { return logical_; }
  /// Physical offset of the next byte; never inside a checksum.
  std::uint64_t physical() const;
  /// Writes the XML part, the last page and the file header.
  void finish(std::string_view xml);

 private:
  void write_page();

  AtomicFile& file_;
  std::string page_;
  std::string first_page_;
  std::uint64_t pages_ = 0;
  std::uint64_t logical_ = 0;
};

}  // namespace alea
