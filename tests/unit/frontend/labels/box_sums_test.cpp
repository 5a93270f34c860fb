#include <gtest/gtest.h>
#include <placegraph/frontend/labels/box_sums.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace placegraph {
namespace box_sums_test {

TEST(BoxSumsMeans, AreThoseOfThePixelsOneByOne) {
  Random random(1);
  for (const auto& [rows, cols, channels] :
       {std::array{1, 1, 1}, {1, 9, 2}, {7, 1, 3}, {6, 11, 5}}) {
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(rows * cols * channels));
    for (std::uint8_t& pixel : pixels) pixel = static_cast<std::uint8_t>(random.index(256));
    const BoxSums sums(pixels, rows, cols, channels);
    std::vector<std::uint8_t> means(static_cast<std::size_t>(channels));
    for (int round = 0; round < 200; ++round) {
      const int u0 = random.index(cols + 6) - 3, v0 = random.index(rows + 6) - 3;
      const PixelBox box{u0, v0, u0 + 1 + random.index(cols + 2), v0 + 1 + random.index(rows + 2)};
      if (box.u1 <= 0 || box.v1 <= 0 || box.u0 >= cols || box.v0 >= rows) continue;
      sums.means(box, means.data());
      for (int c = 0; c < channels; ++c) {
        double sum = 0;
        int count = 0;
        for (int v = std::max(0, box.v0); v < std::min(rows, box.v1); ++v)
          for (int u = std::max(0, box.u0); u < std::min(cols, box.u1); ++u, ++count)
            sum += pixels[static_cast<std::size_t>((v * cols + u) * channels + c)];
        EXPECT_NEAR(means[static_cast<std::size_t>(c)], sum / count, 0.5 + 1e-9);
      }
    }
  }
}

TEST(BoxSumsMeans, OutsideAreThoseOfTheNearestPixels) {
  const BoxSums sums({10, 20, 30, 40, 50, 60}, 2, 3, 1);
  std::uint8_t mean = 0;
  const auto mean_of = [&](const PixelBox& box) {
    sums.means(box, &mean);
    return static_cast<int>(mean);
  };
  EXPECT_EQ(mean_of({-4, -4, -2, -2}), 10);
  EXPECT_EQ(mean_of({8, -4, 9, -2}), 30);
  EXPECT_EQ(mean_of({-4, 7, -2, 9}), 40);
  EXPECT_EQ(mean_of({8, 7, 9, 9}), 60);
  EXPECT_EQ(mean_of({-9, 0, -5, 2}), 25);  // the left column
}

}  // namespace box_sums_test
}  // namespace placegraph
