#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/frontend/cloud_planes/neighbour_tree.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <utility>

namespace placegraph {
namespace neighbour_tree_test {

/// All distances, sorted: among equal ones the smaller number is first.
std::vector<int> by_hand(const std::vector<Eigen::Vector3d>& points, int i, int k) {
  std::vector<std::pair<double, int>> all;
  for (int j = 0; j < static_cast<int>(points.size()); ++j)
    if (j != i) all.emplace_back((points[j] - points[i]).squaredNorm(), j);
  std::sort(all.begin(), all.end());
  std::vector<int> nearest;
  for (int n = 0; n < std::min(k, static_cast<int>(all.size())); ++n)
    nearest.push_back(all[n].second);
  return nearest;
}

void expect_all_as_by_hand(const std::vector<Eigen::Vector3d>& points, int k) {
  const NeighbourTree tree(points);
  std::vector<int> found = {-5};  // what was in it does not stay
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    tree.nearest(i, k, found);
    ASSERT_EQ(found, by_hand(points, i, k)) << points.size() << " points, k " << k << ", " << i;
  }
}

TEST(NearestNeighbours, FindsWhatAllDistancesGive) {
  Random random(1);
  for (const int size : {1, 2, 9, 11, 23, 200}) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < size; ++i)  // a long thin cloud, far from the origin
      points.emplace_back(1e4 + random.normal(0, 10), random.normal(), random.normal(0, 0.1));
    for (const int k : {1, 3, 8, 30}) expect_all_as_by_hand(points, k);
  }
}

TEST(NearestNeighbours, PrefersSmallerNumbersAtEqualDistances) {
  // Whole coordinates, shuffled: every point has many others at the very same distance.
  Random random(2);
  std::vector<Eigen::Vector3d> points;
  for (int x = 0; x < 7; ++x)
    for (int y = 0; y < 7; ++y)
      for (int z = 0; z < 3; ++z) points.emplace_back(x, y, z);
  for (std::size_t i = points.size() - 1; i > 0; --i)
    std::swap(points[i], points[random.index(static_cast<int>(i) + 1)]);
  for (const int k : {1, 4, 8, 13}) expect_all_as_by_hand(points, k);
}

TEST(NearestNeighbours, FindsAFewPointsOfOnePositionLikeOthers) {
  Random random(3);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 150; ++i)  // about five a position
    points.emplace_back(random.index(6), random.index(5), 0);
  expect_all_as_by_hand(points, 60);
}

TEST(NearestNeighbours, SharesOutTheNeighboursOfACrowdAtOnePosition) {
  constexpr int kCrowd = 30, kNeighbours = 4;
  std::vector<Eigen::Vector3d> points(kCrowd, Eigen::Vector3d(1, 2, 3));
  points.emplace_back(1, 2, 4);
  const NeighbourTree tree(points);
  std::vector<int> found, times(points.size(), 0);
  for (int i = 0; i < kCrowd; ++i) {
    tree.nearest(i, kNeighbours, found);
    EXPECT_THAT(found, ::testing::UnorderedElementsAre((i + 1) % kCrowd, (i + 2) % kCrowd,
                                                       (i + 3) % kCrowd, (i + 4) % kCrowd));
    for (const int j : found) ++times[static_cast<std::size_t>(j)];
  }
  for (int i = 0; i < kCrowd; ++i) EXPECT_EQ(times[i], kNeighbours) << i;
  // From outside the first of them are the nearest.
  tree.nearest(kCrowd, kNeighbours, found);
  EXPECT_THAT(found, ::testing::ElementsAre(0, 1, 2, 3));
}

TEST(NearestNeighbours, FindsNoneWhereThereAreNone) {
  const std::vector<Eigen::Vector3d> one(1, Eigen::Vector3d(1, 2, 3)), none;
  std::vector<int> found = {7};
  NeighbourTree(one).nearest(0, 5, found);
  EXPECT_THAT(found, ::testing::IsEmpty());
  const std::vector<Eigen::Vector3d> two(2, Eigen::Vector3d(1, 2, 3));
  NeighbourTree(two).nearest(1, 0, found);
  EXPECT_THAT(found, ::testing::IsEmpty());
  NeighbourTree(two).nearest(1, 5, found);
  EXPECT_THAT(found, ::testing::ElementsAre(0));
  EXPECT_NO_THROW(NeighbourTree{none});
}

}  // namespace neighbour_tree_test
}  // namespace placegraph
