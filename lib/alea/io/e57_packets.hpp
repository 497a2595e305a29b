#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "alea/io/e57_document.hpp"
#include "alea/io/e57_pages.hpp"

namespace alea {

/// The bytestreams of a compressed vector, read packet by packet (ASTM E2807-11, 9.3).
class E57Packets {
 public:
  /// Reads the section's header. Throws Error(input).
  E57Packets(const E57Pages& pages, const E57Scan& scan, std::vector<bool> wanted);

  /// Bytes of the section, its header included.
  std::uint64_t section_bytes() const { return section_bytes_; }
  /// Reads packets until every wanted stream holds `records` whole values more, or the section
  /// ends. Returns how many records are there, at most `records`.
  std::uint64_t fill(std::uint64_t records);
  /// Values [first, first + count) of a stream, counted from the last consume().
  void decode(std::size_t field, std::uint64_t first, std::size_t count, double* out) const;
  /// Drops the first `records` values of every stream.
  void consume(std::uint64_t records);

 private:
  struct Stream {
    bool wanted = false;
    unsigned bits = 0;
    std::string bytes;
    std::uint64_t first_bit = 0;  ///< of the first value not consumed
  };

  void read_packet();
  void read_data_packet(std::uint64_t length);
  std::uint64_t available(std::uint64_t records) const;

  const E57Pages& pages_;
  const E57Scan& scan_;
  std::vector<Stream> streams_;
  std::uint64_t at_ = 0;   ///< logical offset of the next packet
  std::uint64_t end_ = 0;  ///< logical end of the section
  std::uint64_t section_bytes_ = 0;
};

}  // namespace alea
