#include "alea/io/e57_packets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "alea/core/error.hpp"
#include "alea/io/byte_order.hpp"

namespace alea {

E57Packets::E57Packets(const E57Pages& pages, const E57Scan& scan, std::vector<bool> wanted)
    : pages_(pages), scan_(scan), streams_(scan.fields.size()) {
  for (std::size_t i = 0; i < streams_.size(); ++i) {
    streams_[i].wanted = wanted[i];
    streams_[i].bits = scan.fields[i].bits();
  }
  const std::uint64_t begin = pages.logical(scan.section_offset, "a compressed vector section");
  const std::string header = pages.read(begin, 32, "the section header");
  if (header[0] != 1)
    throw input_error(fmt::format("{}: byte {}: section id {}; expected 1 (compressed vector)",
                                  pages.path(), scan.section_offset,
                                  static_cast<unsigned char>(header[0])));
  const auto length = load_le<std::uint64_t>(header, 8);
  if (length < 32 || length > pages.logical_size() - begin)
    throw input_error(
        fmt::format("{}: byte {}: a section of {} bytes; it runs past the end of the "
                    "file",
                    pages.path(), scan.section_offset + 8, length));
  section_bytes_ = length;
  end_ = begin + length;
  at_ = end_;
  if (scan.records == 0) return;
  const auto first_packet = load_le<std::uint64_t>(header, 16);
  at_ = pages.logical(first_packet, "data packets");
  if (at_ < begin + 32 || at_ > end_)
    throw input_error(
        fmt::format("{}: byte {}: data packets at byte {}; expected them inside their section",
                    pages.path(), scan.section_offset + 16, first_packet));
}

std::uint64_t E57Packets::available(std::uint64_t records) const {
  for (const Stream& stream : streams_)
    if (stream.wanted && stream.bits > 0)
      records = std::min<std::uint64_t>(
          records, (stream.bytes.size() * std::uint64_t{8} - stream.first_bit) / stream.bits);
  return records;
}

std::uint64_t E57Packets::fill(std::uint64_t records) {
  while (available(records) < records && at_ < end_) read_packet();
  pages_.release_before(at_);
  return available(records);
}

void E57Packets::read_packet() {
  const std::string head = pages_.read(at_, 4, "a packet header");
  const auto type = static_cast<unsigned char>(head[0]);
  const std::uint64_t length = load_le<std::uint16_t>(head, 2) + std::uint64_t{1};
  if (type > 2 || length % 4 != 0 || length > end_ - at_)
    throw input_error(fmt::format(
        "{}: byte {}: a packet of type {} and {} bytes; expected type 0, 1 or 2, a multiple of 4 "
        "bytes inside the section",
        pages_.path(), pages_.physical(at_), type, length));
  if (type == 1) read_data_packet(length);
  at_ += length;
}

void E57Packets::read_data_packet(std::uint64_t length) {
  const std::string packet = pages_.read(at_, length, "a data packet");
  const std::size_t count = length < 6 ? 0 : load_le<std::uint16_t>(packet, 4);
  std::size_t offset = 6 + 2 * count;
  if (count != streams_.size() || offset > length)
    throw input_error(fmt::format("{}: byte {}: a data packet with {} bytestreams; expected {}",
                                  pages_.path(), pages_.physical(at_), count, streams_.size()));
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t size = load_le<std::uint16_t>(packet, 6 + 2 * i);
    if (size > length - offset)
      throw input_error(fmt::format("{}: byte {}: bytestream {} runs past its packet",
                                    pages_.path(), pages_.physical(at_), i + 1));
    if (streams_[i].wanted) streams_[i].bytes.append(packet, offset, size);
    offset += size;
  }
}

void E57Packets::consume(std::uint64_t records) {
  for (Stream& stream : streams_) {
    if (!stream.wanted) continue;
    const std::uint64_t bit = stream.first_bit + records * stream.bits;
    stream.bytes.erase(0, bit / 8);
    stream.first_bit = bit % 8;
  }
}

namespace {

// `bits` bits from bit `at` on, least significant first; bits <= 64.
std::uint64_t take_bits(const std::string& bytes, std::uint64_t at, unsigned bits) {
  std::uint64_t word = 0;
  const std::size_t byte = at / 8;
  const auto shift = static_cast<unsigned>(at % 8);
  std::memcpy(&word, bytes.data() + byte, std::min<std::size_t>(8, bytes.size() - byte));
  word >>= shift;
  if (shift + bits > 64)
    word |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[byte + 8])) << (64 - shift);
  return bits == 64 ? word : word & ((std::uint64_t{1} << bits) - 1);
}

}  // namespace

void E57Packets::decode(std::size_t index, std::uint64_t first, std::size_t count,
                        double* out) const {
  const Stream& stream = streams_[index];
  const E57Field& field = scan_.fields[index];
  std::uint64_t at = stream.first_bit + first * stream.bits;
  for (std::size_t i = 0; i < count; ++i, at += stream.bits) {
    const std::uint64_t raw = stream.bits == 0 ? 0 : take_bits(stream.bytes, at, stream.bits);
    switch (field.kind) {
      case E57Field::Kind::float32:
        out[i] = std::bit_cast<float>(static_cast<std::uint32_t>(raw));
        break;
      case E57Field::Kind::float64:
        out[i] = std::bit_cast<double>(raw);
        break;
      case E57Field::Kind::integer: {
        const auto value =
            static_cast<std::int64_t>(static_cast<std::uint64_t>(field.minimum) + raw);
        out[i] = static_cast<double>(value) * field.scale + field.offset;
        break;
      }
      case E57Field::Kind::text:
        out[i] = 0;
        break;
    }
  }
}

}  // namespace alea
