#include <gtest/gtest.h>
#include <placegraph/frontend/cloud_planes/plane_labels.h>
#include <placegraph/graph/core/random.h>

#include <cmath>
#include <string>

#include "tests/support/scenes/small_cloud.h"

namespace placegraph {
namespace plane_labels_test {

double flat_wall(double x, double) { return 2 / (1 + 0.2 * x); }

/// Labels of an image of digits, '.' for none.
PlaneLabels labels_of(const std::string& picture, int planes) {
  PlaneLabels result;
  result.planes.resize(static_cast<std::size_t>(planes));
  for (const char c : picture) result.labels.push_back(c == '.' ? -1 : c - '0');
  return result;
}

std::string picture_of(const PlaneLabels& labels) {
  std::string picture;
  for (const int label : labels.labels) picture += label < 0 ? '.' : static_cast<char>('0' + label);
  return picture;
}

TEST(PlaneLabels, DropSmallPiecesAndThenSmallPlanes) {
  const CloudPoints points = prepare_cloud(test::small_cloud(6, 4, flat_wall), 1e-3);
  PlaneLabels labels = labels_of(
      "00.122"
      "00.122"
      "...122"
      "11.2.0",
      3);
  std::vector<int> kept = {9};
  // The pair of ones, the lone zero and the lone two go; of the zeros four are left, of ones three.
  drop_small(points, 3, 4, labels, &kept);
  EXPECT_EQ(picture_of(labels), "00..1100..11....11......");
  EXPECT_EQ(kept, (std::vector<int>{0, 2}));
  ASSERT_EQ(labels.planes.size(), 2u);
  ASSERT_EQ(labels.sums.size(), 2u);
  EXPECT_EQ(labels.sums[0].count(), 4);
  EXPECT_EQ(labels.sums[1].count(), 6);
}

TEST(PlaneLabels, AreDroppedWholeIfTheyArePorous) {
  const CloudPoints points = prepare_cloud(test::small_cloud(6, 4, flat_wall), 1e-3);
  const std::string picture =
      "000101"
      "000010"
      "000101"
      "000010";
  PlaneLabels labels = labels_of(picture, 2);
  // Of the neighbours of the ones none is a one.
  drop_porous(points, 0.5, labels);
  EXPECT_EQ(picture_of(labels), "000.0.0000.0000.0.0000.0");
  labels = labels_of(picture, 2);
  drop_porous(points, 0, labels);
  EXPECT_EQ(picture_of(labels), picture);
}

TEST(PlaneLabels, RefitsEachPlaneToItsPointsAlone) {
  // A wall at x / 5 + z = 2 and, on the right, one at z = 3.
  const CloudPoints points = prepare_cloud(
      test::small_cloud(12, 10, [](double x, double y) { return x > 0 ? 3 : flat_wall(x, y); }),
      1e-3);
  PlaneLabels labels;
  labels.planes.resize(3);
  labels.planes[2].plane.distance_m = 77;  // without points it stays
  for (const Eigen::Vector3d& p : points.xyz) labels.labels.push_back(p.x() > 0 ? 1 : 0);
  refit(points, labels);
  const double length = std::hypot(0.2, 1);
  EXPECT_NEAR(labels.planes[0].plane.distance_m, 2 / length, 1e-9);
  EXPECT_NEAR(labels.planes[0].plane.normal.x(), 0.2 / length, 1e-9);
  EXPECT_NEAR(labels.planes[1].plane.distance_m, 3, 1e-9);
  EXPECT_GT(labels.planes[1].covariance.trace(), 0);
  EXPECT_EQ(labels.planes[2].plane.distance_m, 77);
}

TEST(PlaneLabels, SpreadFromAFewPointsToTheirSurfacesUpToTheEdge) {
  Random random(4);
  const auto corner = [](double x) { return std::min(2 / (1 + x), 2 / (1 - 1.5 * x)); };
  const CloudPoints points = prepare_cloud(
      test::small_cloud(64, 32,
                        [&](double x, double) { return corner(x) * (1 + random.normal(0, 5e-4)); }),
      3e-4);
  PlaneLabels labels;
  labels.labels.assign(points.xyz.size(), -1);
  labels.planes.resize(2);
  for (int i = 0; i < points.size(); ++i) {
    const int x = points.source[i] % 64, y = points.source[i] / 64;
    if (y > 8 && y < 22 && (x < 16 || x > 48)) labels.labels[i] = x < 16 ? 0 : 1;
  }
  refit(points, labels);
  spread_labels(points, make_super_points(points), 4, labels);
  int wrong = 0;
  for (int i = 0; i < points.size(); ++i) {
    const double x = points.xyz[i].x() / points.xyz[i].z();
    wrong += labels.labels[i] != (x < 0 ? 0 : 1);
  }
  // One in 16,000 is beyond four deviations. The columns beside the edge are 0.01 off it in x/z,
  // and so 0.025 of the depth off the other plane: fifty deviations.
  EXPECT_LE(wrong, 4);
}

}  // namespace plane_labels_test
}  // namespace placegraph
