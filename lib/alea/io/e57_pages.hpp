#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "alea/io/input_file.hpp"

namespace alea {

/// The checksum of E57 pages (CRC-32C, Castagnoli's polynomial).
std::uint32_t crc32c(std::string_view bytes);

/// An E57 file without its page checksums (ASTM E2807-11, 7: pages of 1024 bytes, the last four of
/// which are the big-endian CRC-32C of the others).
class E57Pages {
 public:
  /// Checks the file header and the checksum of every page. Throws Error(input).
  explicit E57Pages(const InputFile& file);

  const std::string& path() const { return file_.path(); }
  std::uint64_t xml_offset() const { return xml_offset_; }  ///< physical
  std::uint64_t xml_length() const { return xml_length_; }

  /// The logical offset of a physical one. Throws Error(input) where it lies outside the file or in
  /// a checksum; `what` is named in the message.
  std::uint64_t logical(std::uint64_t physical, const char* what) const;
  /// `length` bytes from a logical offset on. Throws Error(input) where the file is too short.
  std::string read(std::uint64_t logical, std::uint64_t length, const char* what) const;
  std::uint64_t logical_size() const { return pages_ * payload; }
  std::uint64_t physical(std::uint64_t logical) const {
    return logical / payload * page_size + logical % payload;
  }
  /// Gives back the memory of everything before a logical offset.
  void release_before(std::uint64_t logical) const { file_.release_before(physical(logical)); }

  static constexpr std::uint64_t page_size = 1024;
  static constexpr std::uint64_t payload = 1020;

 private:
  void check_header();
  void check_pages() const;

  const InputFile& file_;
  std::uint64_t pages_ = 0;
  std::uint64_t xml_offset_ = 0;
  std::uint64_t xml_length_ = 0;
};

}  // namespace alea
