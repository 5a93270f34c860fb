#include <gtest/gtest.h>
#include <placegraph/frontend/lines/line_tracker.h>
#include <placegraph/graph/core/error.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/scenes/tiles.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace line_tracker_test {

using Eigen::Vector2d;

/// A bright bar, its sides at `u` and `u` + 30, on weak texture that moves with it.
Image bar(double u, double from_v = 20, double to_v = 100, double gap_from = 0, double gap_to = 0) {
  const test::Texture texture{.seed = 5, .wavelength = 16, .octaves = 2, .contrast = 10};
  Image image(120, 160, CV_8UC1);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      double inside = test::step(x - u, 0.8) * test::step(u + 30 - x, 0.8) *
                      test::step(y - from_v, 0.8) * test::step(to_v - y, 0.8);
      if (y > gap_from && y < gap_to) inside *= 0;
      image.at<std::uint8_t>(y, x) = test::to_grey(texture.grey(x - u, y) - 40 + 90 * inside);
    }
  return image;
}

const LineTrack* side_at(const LineTracker& tracker, double u) {
  for (const LineTrack& track : tracker.tracks())
    if (std::abs(track.edge.line.normal().y()) < 0.05 &&
        std::abs(track.edge.segment.middle().x() - u) < 1)
      return &track;
  return nullptr;
}

TEST(LineTracker, FollowsTheSidesOfABarAndKeepsTheirIds) {
  LineTracker tracker({});
  tracker.track(bar(60));
  tracker.detect();
  const LineTrack* left = side_at(tracker, 60);
  const LineTrack* right = side_at(tracker, 90);
  ASSERT_TRUE(left && right);
  const auto left_id = left->id, right_id = right->id;
  for (int i = 1; i <= 6; ++i) {
    tracker.track(bar(60 + 2.3 * i));
    left = side_at(tracker, 60 + 2.3 * i), right = side_at(tracker, 90 + 2.3 * i);
    ASSERT_TRUE(left && right) << i;
    EXPECT_EQ(left->id, left_id);
    EXPECT_EQ(right->id, right_id);
    EXPECT_EQ(left->age, i);
    EXPECT_NEAR(left->edge.segment.middle().x(), 60 + 2.3 * i, 0.1) << "measured, not drifted";
    EXPECT_NEAR(left->previous.middle().x(), 60 + 2.3 * (i - 1), 0.1);
  }
}

TEST(LineTracker, LooksWhereTheSegmentIsExpected) {
  LineTracker tracker({});
  tracker.track(bar(40));
  tracker.detect();
  const auto id = side_at(tracker, 40)->id;
  std::vector<LineSegment> expected;
  for (const LineTrack& track : tracker.tracks()) {
    const Vector2d moved(34, 0);
    expected.push_back({track.edge.segment.start + moved, track.edge.segment.end + moved});
  }
  LineTracker blind = tracker;
  tracker.track(bar(76), expected);
  ASSERT_TRUE(side_at(tracker, 76));
  EXPECT_EQ(side_at(tracker, 76)->id, id);
  blind.track(bar(76));
  EXPECT_FALSE(side_at(blind, 76)) << "36 px are too far without being told";
}

TEST(LineTracker, AnEdgeOfTheOtherPolarityIsAnotherEdge) {
  LineTracker tracker({});
  tracker.track(bar(60));
  tracker.detect();
  ASSERT_FALSE(tracker.tracks().empty());
  Image negative;
  cv::bitwise_not(bar(60), negative);
  tracker.track(negative);
  EXPECT_TRUE(tracker.tracks().empty());
}

TEST(LineTracker, TracksDieWithTheirEdgeAndIdsAreNeverUsedTwice) {
  LineTracker tracker({});
  tracker.track(bar(60));
  tracker.detect();
  LineId last = LineId::lowest();
  for (const LineTrack& track : tracker.tracks()) last = std::max(last, track.id);
  tracker.track(Image(120, 160, CV_8UC1, cv::Scalar(90)));
  EXPECT_TRUE(tracker.tracks().empty());
  tracker.track(bar(60));
  tracker.detect();
  ASSERT_FALSE(tracker.tracks().empty());
  for (const LineTrack& track : tracker.tracks()) EXPECT_GT(track.id, last);
}

TEST(LineTracker, PiecesThatGrowTogetherBecomeTheOlderTrack) {
  LineTrackerOptions options;
  options.min_new_px = options.min_length_px = 15;
  LineTracker tracker(options);
  tracker.track(bar(60, 10, 110, 45, 75));
  tracker.detect();
  std::vector<LineId> pieces;
  for (const LineTrack& track : tracker.tracks())
    if (std::abs(track.edge.segment.middle().x() - 60) < 1) pieces.push_back(track.id);
  ASSERT_EQ(pieces.size(), 2u);
  bool merged = false;
  for (double half = 14; half > -24; half -= 3) {  // grown together, they grow over each other
    tracker.track(bar(60, 10, 110, 60 - half, 60 + half));
    for (const auto& [from, to] : tracker.merged()) merged |= from == pieces[1] && to == pieces[0];
  }
  EXPECT_TRUE(merged);
  ASSERT_TRUE(side_at(tracker, 60));
  EXPECT_EQ(side_at(tracker, 60)->id, pieces[0]);
  EXPECT_GT(side_at(tracker, 60)->edge.segment.length(), 85);
}

TEST(LineTracker, SeesNoMotionAlongAnEdge) {
  // The aperture: an edge across the whole image, moved along itself, stays where it was.
  const auto edge = [](double along) {
    (void)along;
    return test::half_planes(160, 120, 0.3, 80);
  };
  LineTracker tracker({});
  tracker.track(edge(0));
  tracker.detect();
  ASSERT_EQ(tracker.tracks().size(), 1u);
  const ImageLine before = tracker.tracks()[0].edge.line;
  std::vector<LineSegment> expected{tracker.tracks()[0].edge.segment};
  const Vector2d slid = 7 * expected[0].direction();
  expected[0].start += slid, expected[0].end += slid;
  tracker.track(edge(7), expected);
  ASSERT_EQ(tracker.tracks().size(), 1u);
  const auto carriers = tracker.tracks()[0].edge.line.carriers();
  for (const Vector2d& px : {carriers.first, carriers.second})
    EXPECT_NEAR(before.normal().dot(px) - before.offset_px, 0, 0.05);
}

TEST(LineTracker, DoesNotDetectWhereTheMaskForbidsOrATrackIsAlready) {
  LineTracker tracker({});
  tracker.track(bar(60));
  tracker.detect(Image(120, 160, CV_8UC1, cv::Scalar(0)));
  EXPECT_TRUE(tracker.tracks().empty());
  tracker.detect();
  const std::size_t all = tracker.tracks().size();
  EXPECT_GT(all, 0u);
  tracker.detect();
  EXPECT_EQ(tracker.tracks().size(), all);
}

TEST(LineTracker, EdgesThatLeaveTheImageSoonAreBegunOnlyWhereThereAreFewOthers) {
  const auto later = [](const LineSegment& s) {  // what is right of column 75 leaves
    return s.middle().x() > 75 ? LineSegment{} : s;
  };
  LineTrackerOptions options;
  options.leaving_share = 0;
  LineTracker tracker(options);
  tracker.track(bar(60));
  tracker.detect({}, later);
  EXPECT_TRUE(side_at(tracker, 60));
  EXPECT_FALSE(side_at(tracker, 90));
  options.leaving_share = 1;
  LineTracker lonely(options);
  lonely.track(bar(60));
  lonely.detect({}, later);
  EXPECT_TRUE(side_at(lonely, 60));
  EXPECT_TRUE(side_at(lonely, 90));
}

TEST(LineTracker, RefusesWhatBreaksItsContract) {
  LineTracker tracker({});
  EXPECT_THROW(tracker.track(Image()), ArgumentError);
  tracker.track(bar(60));
  tracker.detect();
  EXPECT_THROW(tracker.track(bar(60), {LineSegment{}, LineSegment{}, LineSegment{}, LineSegment{},
                                       LineSegment{}, LineSegment{}, LineSegment{}}),
               ArgumentError);
  EXPECT_THROW(tracker.track(Image(50, 50, CV_8UC1, cv::Scalar(0))), ArgumentError);
  EXPECT_THROW(tracker.keep({}), ArgumentError);
  tracker.reset();
  EXPECT_TRUE(tracker.tracks().empty());
}

TEST(ImageLine, CarriersStandForTheLineWithItsCovariance) {
  const LineSegment segment{{20, 30}, {140, 60}};
  const ImageLine line = line_of(segment, 0.5, 1);
  const auto carriers = line.carriers();
  for (const Vector2d& px : {carriers.first, carriers.second}) {
    EXPECT_NEAR(segment.offset_of(px), 0, 1e-9);
    EXPECT_NEAR(line.variance_at(px), carriers.sigma_px * carriers.sigma_px, 1e-12);
  }
  // Of uniform support: at a distance of its length over the root of twelve from the middle.
  EXPECT_NEAR((carriers.first - segment.middle()).norm(), segment.length() / std::sqrt(12.0), 0.1);
  EXPECT_NEAR(line.carriers(0.3).sigma_px, std::hypot(carriers.sigma_px, 0.3), 1e-12);
  EXPECT_THROW(ImageLine().carriers(), ArgumentError);
}

}  // namespace line_tracker_test
}  // namespace placegraph
