#include "tests/fuzz/fuzz_one.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  alea::testing::read_as(ALEA_FUZZ_FORMAT, {reinterpret_cast<const char*>(data), size});
  return 0;
}
