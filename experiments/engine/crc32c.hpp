#pragma once

#include <cstdint>
#include <string_view>

namespace alea::experiments {

/// CRC-32C (Castagnoli; RFC 3720, appendix B.4) of `bytes`, continued from `before`: the checksum
/// of a whole is that of its parts in turn. It finds every error of up to 32 bits in a row.
std::uint32_t crc32c(std::string_view bytes, std::uint32_t before = 0);

}  // namespace alea::experiments
