#include "alea/io/e57_page_writer.hpp"

#include <algorithm>

#include "alea/io/binary_output.hpp"
#include "alea/io/e57_pages.hpp"

namespace alea {
namespace {

std::string checksum_of(std::string_view page) {
  const std::uint32_t crc = crc32c(page);
  std::string out;
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(crc >> shift & 255);
  return out;
}

}  // namespace

E57PageWriter::E57PageWriter(AtomicFile& file) : file_(file) {
  write(std::string(48, '\0'));
}

void E57PageWriter::write(std::string_view bytes) {
  logical_ += bytes.size();
  while (!bytes.empty()) {
    const std::size_t size = std::min<std::size_t>(bytes.size(), E57Pages::payload - page_.size());
    page_.append(bytes.substr(0, size));
    bytes.remove_prefix(size);
    if (page_.size() == E57Pages::payload) write_page();
  }
}

void E57PageWriter::align() {
  write(std::string((4 - logical_ % 4) % 4, '\0'));
}

std::uint64_t E57PageWriter::physical() const {
  return logical_ / E57Pages::payload * E57Pages::page_size + logical_ % E57Pages::payload;
}

void E57PageWriter::write_page() {
  if (pages_++ == 0) first_page_ = page_;
  file_.write(page_ + checksum_of(page_));
  page_.clear();
}

void E57PageWriter::finish(std::string_view xml) {
  align();
  const std::uint64_t xml_offset = physical();
  write(xml);
  if (!page_.empty()) write(std::string(E57Pages::payload - page_.size(), '\0'));
  std::string header = "ASTM-E57";
  append_bytes(header, std::uint32_t{1});
  append_bytes(header, std::uint32_t{0});
  append_bytes(header, pages_ * E57Pages::page_size);
  append_bytes(header, xml_offset);
  append_bytes(header, std::uint64_t{xml.size()});
  append_bytes(header, E57Pages::page_size);
  first_page_.replace(0, header.size(), header);
  file_.write_at(0, first_page_ + checksum_of(first_page_));
}

}  // namespace alea
