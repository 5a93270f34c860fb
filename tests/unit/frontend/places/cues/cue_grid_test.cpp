#include <gtest/gtest.h>
#include <placegraph/frontend/places/cues/cue_grid.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace cue_grid_test {

std::vector<float> draw_values(int count, Random& random) {
  std::vector<float> values(static_cast<std::size_t>(count));
  for (float& value : values) value = static_cast<float>(random.normal());
  return values;
}

CueGrid draw_grid(int columns, int rows, int channels, Random& random) {
  return make_cue_grid(columns, rows, channels, draw_values(columns * rows * channels, random));
}

/// Similarity with the query's first cell at (x, y) of the candidate, cell by cell.
double similarity_by_hand(const CueGrid& query, const CueGrid& candidate, int x, int y,
                          const GridSearch& search) {
  double product = 0, of_query = 0, of_candidate = 0;
  int cells = 0;
  for (int v = 0; v < query.rows; ++v)
    for (int u = 0; u < query.columns; ++u) {
      if (u + x < 0 || v + y < 0 || u + x >= candidate.columns || v + y >= candidate.rows) continue;
      ++cells;
      for (int c = 0; c < query.channels; ++c) {
        const double a = query.values[(v * query.columns + u) * query.channels + c];
        const double b =
            candidate.values[((v + y) * candidate.columns + u + x) * query.channels + c];
        product += a * b, of_query += a * a, of_candidate += b * b;
      }
    }
  const double share = static_cast<double>(cells) / (candidate.columns * candidate.rows);
  if (cells == 0 || share < search.min_overlap) return -1;
  return product / std::sqrt(of_query * of_candidate) - search.loss * (1 - share);
}

double alignment_by_hand(const CueGrid& query, const CueGrid& candidate, const GridSearch& search) {
  const int x = static_cast<int>(std::floor((candidate.columns - query.columns) / 2.0));
  const int y = static_cast<int>(std::floor((candidate.rows - query.rows) / 2.0));
  double best = -1;
  for (int dy = -search.shift_y; dy <= search.shift_y; ++dy)
    for (int dx = -search.shift_x; dx <= search.shift_x; ++dx)
      best = std::max(best, similarity_by_hand(query, candidate, x + dx, y + dy, search));
  return best;
}

TEST(MakeCueGrid, RoundsToElevenBitsOfTheLargest) {
  Random random(1);
  const std::vector<float> values = draw_values(60, random);
  const CueGrid grid = make_cue_grid(5, 4, 3, values);
  float largest = 0;
  for (const float value : values) largest = std::max(largest, std::abs(value));
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(grid.values[i], values[i] / largest * 1023, 0.501);
  std::vector<float> other = values;
  for (float& value : other) value *= -0.25f;  // exact in binary
  const CueGrid scaled = make_cue_grid(5, 4, 3, other);
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(scaled.values[i], -grid.values[i]);
  EXPECT_EQ(scaled.energy, grid.energy);
  const CueGrid blank = make_cue_grid(2, 1, 1, {0, -0.0f});
  EXPECT_EQ(blank.values, (std::vector<std::int16_t>{0, 0}));
}

TEST(MakeCueGrid, SumsTheSquaresOfAllCellsAboveAndToTheLeft) {
  Random random(2);
  const CueGrid grid = draw_grid(4, 3, 2, random);
  ASSERT_EQ(grid.energy.size(), 5u * 4);
  for (int y = 0; y <= 3; ++y)
    for (int x = 0; x <= 4; ++x) {
      std::int64_t sum = 0;
      for (int v = 0; v < y; ++v)
        for (int u = 0; u < x; ++u)
          for (int c = 0; c < 2; ++c) {
            const std::int64_t value = grid.values[(v * 4 + u) * 2 + c];
            sum += value * value;
          }
      EXPECT_EQ(grid.energy[y * 5 + x], sum);
    }
}

TEST(BestAlignment, IsTheBestOfAllShiftsForGridsOfAnySize) {
  Random random(3);
  for (int round = 0; round < 60; ++round) {
    const int channels = 1 + random.index(4);
    const auto size = [&] { return 1 + random.index(9); };
    const CueGrid query = draw_grid(size(), size(), channels, random),
                  candidate = draw_grid(size(), size(), channels, random);
    const GridSearch search{.shift_x = random.index(5),
                            .shift_y = random.index(4),
                            .loss = random.uniform(0, 0.5),
                            .min_overlap = random.uniform(0, 0.6)};
    EXPECT_NEAR(best_alignment(query, candidate, search),
                alignment_by_hand(query, candidate, search), 1e-12)
        << query.columns << 'x' << query.rows << " on " << candidate.columns << 'x'
        << candidate.rows;
  }
}

TEST(BestAlignment, ByStepsLiesBetweenTheCoarseShiftsAndAllOfThem) {
  Random random(4);
  for (int round = 0; round < 20; ++round) {
    const CueGrid query = draw_grid(12, 9, 2, random), candidate = draw_grid(11, 9, 2, random);
    const GridSearch all{.shift_x = 5, .shift_y = 4};
    GridSearch stepped = all;
    stepped.step = 2 + round % 2;
    const double best = best_alignment(query, candidate, stepped);
    EXPECT_LE(best, best_alignment(query, candidate, all));
    EXPECT_GE(best, best_alignment(query, candidate, {}));  // no shift is one of the coarse ones
    // Within a step of the middle all shifts are tried if the middle is the best of the coarse.
    GridSearch near{.shift_x = stepped.step - 1, .shift_y = stepped.step - 1, .step = stepped.step};
    EXPECT_DOUBLE_EQ(
        best_alignment(query, candidate, near),
        alignment_by_hand(query, candidate, {.shift_x = near.shift_x, .shift_y = near.shift_y}));
  }
}

TEST(BestAlignment, FindsAWindowOfALargerGridWhereverItWasCut) {
  Random random(5);
  const std::vector<float> values = draw_values(16 * 12 * 3, random);
  const CueGrid whole = make_cue_grid(16, 12, 3, values);
  for (const int left : {0, 3, 7, 8})
    for (const int top : {0, 2, 4}) {
      std::vector<float> part;
      for (int v = top; v < top + 8; ++v) {
        const auto row = values.begin() + (v * 16 + left) * 3;
        part.insert(part.end(), row, row + 8 * 3);
      }
      const CueGrid window = make_cue_grid(8, 8, 3, part);
      const GridSearch search{.shift_x = 4, .shift_y = 2, .loss = 0.3, .min_overlap = 0.3};
      // Rounding to 1/1023 of the largest, three deviations: 3e-4 of noise per unit, squared.
      EXPECT_NEAR(best_alignment(window, whole, search), 1 - 0.3 * (2.0 / 3), 1e-5);
      EXPECT_NEAR(best_alignment(whole, window, {.shift_x = 4, .shift_y = 2}), 1, 1e-5);
    }
}

}  // namespace cue_grid_test
}  // namespace placegraph
