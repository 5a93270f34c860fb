#include <placegraph/graph/core/error.h>
#include <placegraph/graph/recognition/place_view.h>

namespace placegraph {

std::vector<std::int64_t> cell_energy(int columns, int rows, int channels,
                                      const std::vector<std::int16_t>& values) {
  require(columns >= 0 && rows >= 0 && channels >= 0 &&
              values.size() == static_cast<std::size_t>(columns) * rows * channels,
          "cell_energy: columns * rows * channels values needed");
  const auto stride = static_cast<std::size_t>(columns) + 1;
  std::vector<std::int64_t> energy(stride * (static_cast<std::size_t>(rows) + 1), 0);
  auto value = values.begin();
  for (std::size_t y = 1; y <= static_cast<std::size_t>(rows); ++y) {
    std::int64_t row = 0;
    for (std::size_t x = 1; x < stride; ++x) {
      for (int c = 0; c < channels; ++c, ++value) row += std::int64_t{*value} * *value;
      energy[y * stride + x] = energy[(y - 1) * stride + x] + row;
    }
  }
  return energy;
}

}  // namespace placegraph
