#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/recognition/place_view.h>

namespace placegraph {
namespace place_view_test {

TEST(CellEnergy, GivesTheSumOfSquaresOfAnyRectangle) {
  Random random(7);
  for (int trial = 0; trial < 30; ++trial) {
    const int columns = random.index(7), rows = random.index(7), channels = 1 + random.index(4);
    std::vector<std::int16_t> values(static_cast<std::size_t>(columns) * rows * channels);
    for (auto& value : values) value = static_cast<std::int16_t>(random.index(65536) - 32768);
    const auto energy = cell_energy(columns, rows, channels, values);
    ASSERT_EQ(energy.size(), static_cast<std::size_t>(columns + 1) * (rows + 1));
    const int x0 = random.index(columns + 1), x1 = x0 + random.index(columns - x0 + 1);
    const int y0 = random.index(rows + 1), y1 = y0 + random.index(rows - y0 + 1);
    std::int64_t sum = 0;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x)
        for (int c = 0; c < channels; ++c) {
          const std::int64_t value = values[(y * columns + x) * channels + c];
          sum += value * value;
        }
    const auto at = [&](int x, int y) { return energy[y * (columns + 1) + x]; };
    EXPECT_EQ(at(x1, y1) - at(x0, y1) - at(x1, y0) + at(x0, y0), sum) << "trial " << trial;
  }
}

TEST(CellEnergy, AWrongNumberOfValuesIsRefused) {
  EXPECT_THROW(cell_energy(2, 2, 1, {1, 2, 3}), ArgumentError);
  EXPECT_THROW(cell_energy(-1, -1, 1, {1}), ArgumentError);
}

}  // namespace place_view_test
}  // namespace placegraph
