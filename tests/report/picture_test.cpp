#include "alea/report/picture.hpp"

#include <gtest/gtest.h>

#include "alea/core/error.hpp"
#include "tests/support/png.hpp"
#include "tests/support/program.hpp"

namespace alea {
namespace {

Picture gradient(int width, int height) {
  Picture picture{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (const int value : {7 * x, 11 * y, x * y})
        picture.samples.push_back(static_cast<std::uint8_t>(value));
  return picture;
}

TEST(Picture, APngDecodesToTheSamePixels) {
  const Picture picture = gradient(37, 23);
  const Picture decoded = testing::decode_png(encode_png(picture));
  EXPECT_EQ(decoded.width, 37);
  EXPECT_EQ(decoded.height, 23);
  EXPECT_EQ(decoded.samples, picture.samples);
  EXPECT_EQ(encode_png(picture), encode_png(picture));
}

TEST(Picture, WithoutPixelsIsMisuse) {
  EXPECT_THROW(encode_png(Picture{}), Error);
}

TEST(Picture, AFolderThatIsNotThereIsBadInputAndLeavesNothing) {
  const testing::TemporaryFolder folder;
  EXPECT_THROW(write_png(folder.path() / "none" / "a.png", gradient(3, 3)), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  write_png(folder.path() / "a.png", gradient(3, 3));
  EXPECT_EQ(testing::decode_png(testing::read_text(folder.path() / "a.png")).samples,
            gradient(3, 3).samples);
}

}  // namespace
}  // namespace alea
