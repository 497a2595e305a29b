#include "alea/io/text_lines.hpp"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <string>

#include "alea/core/seed.hpp"

namespace alea {
namespace {

bool same_bits(double a, double b) {
  return std::memcmp(&a, &b, sizeof(a)) == 0;
}

// Random words of digits, points, signs and exponents against std::from_chars, in front of a long
// line (eight digits at once) and at the end of a file (digit by digit).
TEST(TextLines, NumbersAreRoundedCorrectlyWhereverTheyStand) {
  RandomStream random({11, 0, 0, 0, Purpose::test});
  const std::string letters = "0123456789012345678901234567890123456789..--eE+nif,x";
  std::size_t numbers = 0;
  for (int i = 0; i < 300000; ++i) {
    std::string word;
    for (std::uint64_t k = random.below(20) + 1; k > 0; --k)
      word += letters[random.below(letters.size())];
    double expected = 0;
    const char* const end = word.data() + word.size();
    const char* const first = word.data() + (word[0] == '+' && word[1] != '-' ? 1 : 0);
    auto [last, error] = std::from_chars(first, end, expected);
    if (error == std::errc::result_out_of_range) expected = std::nan("");
    if (last == first) last = word.data();
    for (const char* tail : {"", " 123456789012345678901234567890\n"}) {
      const std::string text = word + tail;
      const NumberText read = read_number(text.data(), text.data() + text.size());
      ASSERT_EQ(read.end - text.data(), last - word.data()) << word;
      if (last == word.data()) continue;
      ASSERT_TRUE(same_bits(read.value, expected) || std::isnan(expected)) << word;
      ++numbers;
    }
  }
  EXPECT_GT(numbers, 400000u);
}

TEST(TextLines, NumbersOfAnyLengthBeforeAndBehindThePoint) {
  const std::string digits = "12345678901234567890";
  for (std::size_t whole = 0; whole <= 17; ++whole)
    for (std::size_t part = 0; part <= 17; ++part)
      for (const char* tail : {"", " 1.5 1.5 1.5 1.5 1.5 1.5 1.5"}) {
        if (whole + part == 0) continue;
        const std::string word = "-" + digits.substr(0, whole) + "." + digits.substr(2, part);
        const std::string text = word + tail;
        const NumberText read = read_number(text.data(), text.data() + text.size());
        EXPECT_TRUE(same_bits(read.value, std::strtod(word.c_str(), nullptr))) << word;
        EXPECT_EQ(read.end - text.data(), static_cast<std::ptrdiff_t>(word.size())) << word;
      }
}

}  // namespace
}  // namespace alea
