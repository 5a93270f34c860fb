#include <placegraph/frontend/places/cues/cue_grid.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/function_clones.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

PLACEGRAPH_INLINE std::int32_t dot(const std::int16_t* a, const std::int16_t* b, int count) {
  std::int32_t sum = 0;  // 11 bits each: a row of up to 2048 stays below 2^31
  for (int i = 0; i < count; ++i) sum += static_cast<std::int32_t>(a[i]) * b[i];
  return sum;
}

/// Sum over rows that are `stride` apart.
PLACEGRAPH_CLONES
std::int64_t window_product(const std::int16_t* a, std::ptrdiff_t stride_a, const std::int16_t* b,
                            std::ptrdiff_t stride_b, int rows, int count) {
  std::int64_t sum = 0;
  for (int row = 0; row < rows; ++row) sum += dot(a + row * stride_a, b + row * stride_b, count);
  return sum;
}

struct Window {
  int x = 0, y = 0;
};

std::int64_t energy_of(const CueGrid& grid, Window from, int columns, int rows) {
  const int stride = grid.columns + 1;
  const auto at = [&](int x, int y) {
    return grid.energy[static_cast<std::size_t>(y * stride + x)];
  };
  const int right = from.x + columns, bottom = from.y + rows;
  return at(right, bottom) - at(from.x, bottom) - at(right, from.y) + at(from.x, from.y);
}

const std::int16_t* cell(const CueGrid& grid, int x, int y) {
  return grid.values.data() + static_cast<std::ptrdiff_t>(y * grid.columns + x) * grid.channels;
}

// Similarity with the query's cell (0, 0) at the candidate's (x, y).
double similarity_at(const CueGrid& query, const CueGrid& candidate, int x, int y,
                     const GridSearch& search) {
  const Window in_query{std::max(0, -x), std::max(0, -y)};
  const Window in_candidate{std::max(0, x), std::max(0, y)};
  const int columns = std::min(query.columns - in_query.x, candidate.columns - in_candidate.x);
  const int rows = std::min(query.rows - in_query.y, candidate.rows - in_candidate.y);
  if (columns <= 0 || rows <= 0) return -1;
  const double share = static_cast<double>(columns * rows) / (candidate.columns * candidate.rows);
  if (share < search.min_overlap) return -1;
  const auto stride_of = [](const CueGrid& grid) {
    return static_cast<std::ptrdiff_t>(grid.columns) * grid.channels;
  };
  const std::int64_t product = window_product(cell(query, in_query.x, in_query.y), stride_of(query),
                                              cell(candidate, in_candidate.x, in_candidate.y),
                                              stride_of(candidate), rows, columns * query.channels);
  const double lengths =
      std::sqrt(static_cast<double>(energy_of(query, in_query, columns, rows)) *
                static_cast<double>(energy_of(candidate, in_candidate, columns, rows)));
  const double cosine = lengths > 0 ? static_cast<double>(product) / lengths : 0;
  return cosine - search.loss * (1 - share);
}

}  // namespace

CueGrid make_cue_grid(int columns, int rows, int channels, const std::vector<float>& values) {
  require(columns > 0 && rows > 0 && channels > 0 &&
              values.size() == static_cast<std::size_t>(columns) * rows * channels,
          "make_cue_grid: columns * rows * channels values needed");
  // 2^10 - 1. Chosen.
  constexpr float kLargest = 1023;
  float largest = 0;
  for (const float value : values) {
    require(std::isfinite(value), "make_cue_grid: a value is not finite");
    largest = std::max(largest, std::abs(value));
  }
  CueGrid grid{columns, rows, channels, {}, {}};
  grid.values.reserve(values.size());
  const float scale = largest > 0 ? kLargest / largest : 0;
  for (const float value : values)
    grid.values.push_back(static_cast<std::int16_t>(std::lround(value * scale)));
  grid.energy = cell_energy(columns, rows, channels, grid.values);
  return grid;
}

double best_alignment(const CueGrid& query, const CueGrid& candidate, const GridSearch& search) {
  require(query.channels == candidate.channels, "best_alignment: grids of different channels");
  const auto half = [](int difference) {
    return difference >= 0 ? difference / 2 : -((1 - difference) / 2);
  };
  const int x0 = half(candidate.columns - query.columns), y0 = half(candidate.rows - query.rows);
  double best = -1;
  int best_x = 0, best_y = 0;
  const auto attempt = [&](int dx, int dy) {
    const double similarity = similarity_at(query, candidate, x0 + dx, y0 + dy, search);
    if (similarity <= best) return;
    best = similarity;
    best_x = dx;
    best_y = dy;
  };
  const int step = std::max(1, search.step);
  const int reach_x = search.shift_x / step * step, reach_y = search.shift_y / step * step;
  for (int dy = -reach_y; dy <= reach_y; dy += step)
    for (int dx = -reach_x; dx <= reach_x; dx += step) attempt(dx, dy);
  if (step == 1) return best;
  const int x = best_x, y = best_y;
  for (int dy = std::max(-search.shift_y, y - step + 1);
       dy < std::min(search.shift_y + 1, y + step); ++dy)
    for (int dx = std::max(-search.shift_x, x - step + 1);
         dx < std::min(search.shift_x + 1, x + step); ++dx)
      if (dx != x || dy != y) attempt(dx, dy);
  return best;
}

}  // namespace placegraph
