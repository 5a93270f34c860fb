#include <gtest/gtest.h>
#include <placegraph/frontend/lines/line_stereo.h>
#include <placegraph/frontend/segments/segment_detector.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/tiles.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace line_stereo_test {

/// A tilted wall in the right eye: disparity 8 + 0.05 u - 0.02 v.
Eigen::Matrix3d right_of_left() {
  Eigen::Matrix3d H = Eigen::Matrix3d::Identity();
  H.row(0) << 0.95, 0.02, -8;
  return H;
}

TEST(LineStereo, FindsTheInfiniteLinesOfATiltedWall) {
  Random random = test::seeded_random(40);
  const test::TiledWall wall(3, 2, 60, random);
  const Image left = wall.seen(190, 130, Eigen::Matrix3d::Identity());
  const Image right = wall.seen(190, 130, right_of_left());
  const auto segments = segments_of(detect_segments(left, {}));
  const auto matches = match_stereo_segments(left, right, segments, {}, {});
  int found = 0, steep = 0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const bool flat = std::abs(segments[i].direction().y()) < 0.17;
    EXPECT_FALSE(flat && matches[i]) << "along the rows: no depth to be had";
    steep += !flat && segments[i].start.x() > 40;
    if (!matches[i]) continue;
    ++found;
    for (const Eigen::Vector2d& px : {segments[i].start, segments[i].end}) {
      const Eigen::Vector2d there = (right_of_left() * px.homogeneous()).hnormalized();
      EXPECT_NEAR(matches[i]->line.normal().dot(there) - matches[i]->line.offset_px, 0, 0.25);
    }
  }
  EXPECT_GE(found, (2 * steep) / 3);
  EXPECT_GE(found, 4);
}

TEST(LineStereo, FindsNothingInAnotherPicture) {
  Random random = test::seeded_random(41);
  const test::TiledWall wall(3, 2, 60, random), other(3, 2, 60, random);
  const Image left = wall.seen(190, 130, Eigen::Matrix3d::Identity());
  const Image blank(130, 190, CV_8UC1, cv::Scalar(120));
  const auto segments = segments_of(detect_segments(left, {}));
  for (const auto& match : match_stereo_segments(left, blank, segments, {}, {}))
    EXPECT_FALSE(match);
  EXPECT_THROW(match_stereo_segments(left, Image(), segments, {}, {}), ArgumentError);
}

}  // namespace line_stereo_test
}  // namespace placegraph
