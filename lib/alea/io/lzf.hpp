#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace alea {

/// Expands data of the LZF format (Lehmann, liblzf: literal runs of up to 32 bytes, references of 3
/// to 264 bytes up to 8192 back). Empty where the data are damaged or do not expand to exactly
/// `size` bytes; memory grows with what is there, not with `size`.
std::optional<std::string> lzf_expand(std::string_view compressed, std::size_t size);

}  // namespace alea
