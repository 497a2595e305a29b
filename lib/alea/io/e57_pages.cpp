#include "alea/io/e57_pages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <boost/crc.hpp>

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/io/byte_order.hpp"

namespace alea {

std::uint32_t crc32c(std::string_view bytes) {
  boost::crc_optimal<32, 0x1EDC6F41, 0xFFFFFFFF, 0xFFFFFFFF, true, true> crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

E57Pages::E57Pages(const InputFile& file) : file_(file) {
  check_header();
  check_pages();
}

void E57Pages::check_header() {
  const std::string_view bytes = file_.bytes();
  if (bytes.size() < 48 || !bytes.starts_with("ASTM-E57"))
    throw input_error(fmt::format("{}: byte 0: expected the 48-byte header 'ASTM-E57'", path()));
  const auto major = load_le<std::uint32_t>(bytes, 8);
  if (major != 1)
    throw input_error(fmt::format("{}: byte 8: E57 version {}; expected 1", path(), major));
  const auto declared = load_le<std::uint64_t>(bytes, 16);
  xml_offset_ = load_le<std::uint64_t>(bytes, 24);
  xml_length_ = load_le<std::uint64_t>(bytes, 32);
  const auto page = load_le<std::uint64_t>(bytes, 40);
  if (page != page_size)
    throw input_error(fmt::format("{}: byte 40: page size {}; expected 1024", path(), page));
  if (declared != bytes.size() || bytes.size() % page_size != 0)
    throw input_error(fmt::format(
        "{}: byte 16: {} bytes declared, {} are there; expected the same, whole pages of 1024",
        path(), declared, bytes.size()));
  pages_ = bytes.size() / page_size;
}

void E57Pages::check_pages() const {
  std::atomic<std::uint64_t> first_bad{pages_};
  parallel_chunks(pages_, 256, [&](std::size_t begin, std::size_t end) {
    for (std::uint64_t page = begin; page < end && page < first_bad; ++page) {
      const char* at = file_.bytes().data() + page * page_size;
      const std::uint32_t stored = load_value<std::uint32_t, true>(at + payload);
      if (crc32c({at, payload}) == stored) continue;
      std::uint64_t bad = first_bad;
      while (page < bad && !first_bad.compare_exchange_weak(bad, page)) {
      }
      return;
    }
  });
  if (first_bad < pages_)
    throw input_error(
        fmt::format("{}: byte {}: the page's CRC-32C does not match; the file is damaged, copy it "
                    "again",
                    path(), first_bad * page_size));
}

std::uint64_t E57Pages::logical(std::uint64_t physical, const char* what) const {
  if (physical >= pages_ * page_size || physical % page_size >= payload)
    throw input_error(fmt::format("{}: {} at byte {}, which is not in the file's {} data bytes",
                                  path(), what, physical, logical_size()));
  return physical / page_size * payload + physical % page_size;
}

std::string E57Pages::read(std::uint64_t logical, std::uint64_t length, const char* what) const {
  if (logical > logical_size() || length > logical_size() - logical)
    throw input_error(fmt::format("{}: byte {}: {} of {} bytes runs past the end of the file",
                                  path(), physical(logical), what, length));
  std::string out;
  out.reserve(length);
  while (out.size() < length) {
    const std::uint64_t within = logical % payload;
    const std::uint64_t size = std::min(payload - within, length - out.size());
    out.append(file_.bytes().substr(physical(logical), size));
    logical += size;
  }
  return out;
}

}  // namespace alea
