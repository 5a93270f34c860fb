#include <gtest/gtest.h>
#include <placegraph/frontend/cloud_planes/planar_segments.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "tests/support/scenes/small_cloud.h"

namespace placegraph {
namespace super_points_test {

constexpr double kFlatness = 3e-4;

/// Two walls that meet at an edge, with `noise` as a share of the depth and a hole.
PointCloud two_walls(int width, int height, double noise) {
  Random random(7);
  return test::small_cloud(width, height, [&, noise](double x, double y) {
    if (x > 0.1 && x < 0.2 && y > 0) return 0.0;
    return std::min(2 / (1 + x), 2 / (1 - 1.5 * x)) * (1 + random.normal(0, noise));
  });
}

void expect_division(const CloudPoints& points) {
  const SuperPoints divided = make_super_points(points);
  // Every point is in the one cell that it is told to be in; the cells follow each other.
  std::vector<int> sorted = divided.order;
  std::sort(sorted.begin(), sorted.end());
  ASSERT_EQ(static_cast<int>(sorted.size()), points.size());
  for (int i = 0; i < points.size(); ++i) ASSERT_EQ(sorted[i], i);
  int next = 0;
  for (std::size_t c = 0; c < divided.cells.size(); ++c) {
    const SuperPoint& cell = divided.cells[c];
    ASSERT_EQ(cell.begin, next);
    next = cell.end;
    PlaneSums sums;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (int k = cell.begin; k < cell.end; ++k) {
      EXPECT_EQ(divided.cell_of[divided.order[k]], static_cast<int>(c));
      sums.add(points.fit[divided.order[k]], points.model);
      centre += points.xyz[divided.order[k]] / (cell.end - cell.begin);
    }
    EXPECT_NEAR((cell.centre - centre).norm(), 0, 1e-12);
    EXPECT_EQ(cell.sums.count(), cell.end - cell.begin);
    EXPECT_NEAR(cell.sums.weight(), sums.weight(), 1e-9 * sums.weight());
    EXPECT_EQ(cell.planar, cell.end - cell.begin >= 6 &&
                               lies_on_plane(sums, sums.fit(points.model), points.model));
  }
  EXPECT_EQ(next, points.size());
  // The contacts count the pairs of neighbours between two cells.
  std::map<std::pair<int, int>, int> pairs;
  for (int i = 0; i < points.size(); ++i)
    for (int n = points.begin[i]; n < points.begin[i + 1]; ++n) {
      const int a = divided.cell_of[i], b = divided.cell_of[points.neighbours[n]];
      if (a < b) ++pairs[{a, b}];
    }
  ASSERT_EQ(divided.contacts.size(), pairs.size());
  auto contact = divided.contacts.begin();
  for (const auto& [cells, count] : pairs) {
    EXPECT_EQ(std::pair(contact->a, contact->b), cells);
    EXPECT_EQ(contact++->pairs, count);
  }
  const auto of_cells = contacts_of_cells(divided);
  std::vector<int> times(divided.contacts.size(), 0);
  for (std::size_t c = 0; c < of_cells.size(); ++c)
    for (const int k : of_cells[c]) {
      ++times[k];
      EXPECT_TRUE(divided.contacts[k].a == static_cast<int>(c) ||
                  divided.contacts[k].b == static_cast<int>(c));
    }
  EXPECT_EQ(std::count(times.begin(), times.end(), 2), static_cast<int>(times.size()));
}

TEST(SuperPoints, DivideImagesOfAnySizeAndOtherClouds) {
  for (const auto& [width, height] : {std::pair{48, 32}, {37, 21}, {3, 50}})
    expect_division(prepare_cloud(two_walls(width, height, 1e-3), kFlatness));
  PointCloud loose = two_walls(40, 30, 1e-3);
  loose.width = loose.height = 0;
  expect_division(prepare_cloud(loose, kFlatness));
  for (Eigen::Vector3d& p : loose.points) p += Eigen::Vector3d(0, 0.5, -2);
  const CloudPoints isotropic = prepare_cloud(loose, kFlatness);
  EXPECT_EQ(isotropic.model.noise, PointNoise::kIsotropic);
  expect_division(isotropic);
}

TEST(SuperPoints, AreAsLargeAsTheSurfaceAllows) {
  const auto wall = [](double x, double y) { return 2 / (1 + 0.2 * x - 0.4 * y); };
  const SuperPoints flat =
      make_super_points(prepare_cloud(test::small_cloud(40, 32, wall), kFlatness));
  EXPECT_EQ(flat.cells.size(), 3u * 2);  // blocks of 16 px, the last column of 8
  // A step of a tenth between columns 21 and 22, in the middle of blocks of 4 px.
  const CloudPoints points = prepare_cloud(
      test::small_cloud(48, 32, [&](double x, double y) { return wall(x, y) + (x > -0.04) * 0.1; }),
      kFlatness);
  const SuperPoints stepped = make_super_points(points);
  for (const SuperPoint& cell : stepped.cells) {
    std::set<bool> sides;
    for (int k = cell.begin; k < cell.end; ++k)
      sides.insert(points.source[stepped.order[k]] % 48 > 21);
    EXPECT_EQ(cell.planar, sides.size() == 1);
    EXPECT_LE(cell.end - cell.begin, cell.planar ? 256 : 16);
  }
}

TEST(SuperPoints, DifferByAboutOneFromOthersOnTheirPlane) {
  Random random(8);
  const CloudPoints points = prepare_cloud(test::small_cloud(128, 128,
                                                             [&](double x, double y) {
                                                               return 2 / (1 + 0.2 * x - 0.4 * y) *
                                                                      (1 + random.normal(0, 2e-3));
                                                             }),
                                           1e-6);
  const SuperPoints divided = make_super_points(points);
  ASSERT_EQ(divided.cells.size(), 64u);
  double sum = 0;
  int count = 0;
  for (std::size_t a = 0; a < 64; a += 2, ++count) {
    const SuperPoint &one = divided.cells[a], &other = divided.cells[a + 1];
    const double difference = planar_dissimilarity(one, other, points.model);
    EXPECT_NEAR(difference, planar_dissimilarity(other, one, points.model), 1e-9);
    sum += difference;
  }
  // Chi2 of three degrees of freedom over three: the mean of 32 deviates by sqrt(2 / 96) = 0.14,
  // and the noise is known to a tenth.
  EXPECT_NEAR(sum / count, 1, 0.6);
}

TEST(PlanarSegments, MergeOverAGapInAnyOrderButNotOverAStep) {
  // Three boards with air between them: the outer ones in one plane, the middle one nearer.
  Random random(9);
  const CloudPoints points =
      prepare_cloud(test::small_cloud(88, 32,
                                      [&](double x, double y) {
                                        const double wall = 2 / (1 + 0.2 * x - 0.3 * y);
                                        const double noise = 1 + random.normal(0, 1e-3);
                                        if (std::abs(x) < 0.25) return 0.9 * wall * noise;
                                        return std::abs(x) < 0.4 ? 0 : wall * noise;
                                      }),
                    kFlatness);
  const SuperPoints cells = make_super_points(points);
  std::vector<PlanarSegment> segments = cut_into_segments(cells, points.model, 0.25);
  std::vector<int> seen;
  for (const PlanarSegment& segment : segments)
    seen.insert(seen.end(), segment.cells.begin(), segment.cells.end());
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
  for (int order = 0; order < 2; ++order) {
    std::reverse(segments.begin(), segments.end());
    const std::vector<PlanarSegment> merged = merge_coplanar(segments, cells, points.model);
    ASSERT_EQ(merged.size(), 2u);
    std::vector<int> again;
    for (const PlanarSegment& segment : merged) {
      EXPECT_TRUE(is_one_plane(segment, cells, points.model));
      EXPECT_TRUE(std::is_sorted(segment.cells.begin(), segment.cells.end()));
      std::set<bool> middle;
      for (const int c : segment.cells) middle.insert(std::abs(cells.cells[c].centre.x()) < 0.5);
      EXPECT_EQ(middle.size(), 1u);
      again.insert(again.end(), segment.cells.begin(), segment.cells.end());
    }
    std::sort(again.begin(), again.end());
    EXPECT_EQ(again, seen);
  }
  EXPECT_FALSE(is_one_plane(make_segment(seen, cells, points.model), cells, points.model));
}

}  // namespace super_points_test
}  // namespace placegraph
