#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/frontend/flow/matched_displacements.h>
#include <placegraph/frontend/flow/point_tracker.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <map>
#include <set>

#include "tests/support/scenes/texture.h"

namespace placegraph {
namespace point_tracker_test {

using test::Texture;
using test::texture_image;
constexpr int kWidth = 240, kHeight = 180;
const Texture kTexture{7, 24, 2, 50};

PointTracker started(const PointTrackerOptions& options = {}) {
  PointTracker tracker(options);
  tracker.track(texture_image(kWidth, kHeight, kTexture));
  tracker.detect();
  return tracker;
}

TEST(PointTracker, RecoversSubpixelShiftsBelowATwentiethOfAPixel) {
  for (const Eigen::Vector2f& shift :
       {Eigen::Vector2f(0.37f, -0.61f), Eigen::Vector2f(6.3f, 4.45f)}) {
    PointTracker tracker = started();
    const std::size_t detected = tracker.tracks().size();
    ASSERT_GT(detected, 100u);
    tracker.track(texture_image(kWidth, kHeight, kTexture, -shift.x(), -shift.y()));
    ASSERT_GT(tracker.tracks().size(), 0.85 * detected);
    double worst = 0;
    for (const PointTrack& track : tracker.tracks()) {
      EXPECT_EQ(track.age, 1);
      const bool inner = track.px.x() > 20 && track.px.y() > 20 && track.px.x() < kWidth - 20 &&
                         track.px.y() < kHeight - 20;  // whole windows
      if (inner) worst = std::max<double>(worst, (track.px - track.px_previous - shift).norm());
    }
    EXPECT_LT(worst, 0.05) << shift.transpose();
  }
}

TEST(PointTracker, StartsFromThePredictionWhereTheMotionIsLarge) {
  // 60 px are beyond four levels of a 21 px window; the prediction is 2 px off.
  PointTracker tracker = started();
  const std::size_t detected = tracker.tracks().size();
  std::vector<Eigen::Vector2f> predicted;
  for (const PointTrack& track : tracker.tracks())
    predicted.push_back(track.px + Eigen::Vector2f(58, 1));
  tracker.track(texture_image(kWidth, kHeight, kTexture, -60), predicted);
  std::size_t right = 0;
  for (const PointTrack& track : tracker.tracks())
    right += (track.px - track.px_previous - Eigen::Vector2f(60, 0)).norm() < 0.2;
  EXPECT_GT(right, 0.5 * detected);  // the last quarter of the image has left
}

TEST(PointTracker, FindsAStepThatIsTooWideForItNearMatches) {
  const Texture fine{7, 24, 3, 60};
  const Image before = texture_image(640, 480, fine);
  const Eigen::Vector2f shift(150, 40);
  const Image after = texture_image(640, 480, fine, -shift.x(), -shift.y());
  const auto right = [&](const PointTracker& tracker) {
    return static_cast<std::size_t>(std::count_if(
        tracker.tracks().begin(), tracker.tracks().end(), [&](const PointTrack& track) {
          return (track.px - track.px_previous - shift).norm() < 0.2;
        }));
  };
  PointTracker wide{PointTrackerOptions()};
  wide.track(before);
  wide.detect();
  PointTracker matched = wide;
  const std::size_t detected = wide.tracks().size();
  ASSERT_GT(detected, 200u);
  wide.track(after);
  EXPECT_LT(right(wide), 0.25 * detected);
  ASSERT_TRUE(track_near_matches(matched, after));
  EXPECT_GT(right(matched), 0.5 * detected);  // about a third has left the image
  EXPECT_GT(right(matched), 0.9 * matched.tracks().size());
}

TEST(PointTracker, IsLeftAsItIsWhereNoFeaturesMatch) {
  PointTracker tracker = started();
  const std::size_t tracks = tracker.tracks().size();
  EXPECT_FALSE(track_near_matches(tracker, Image(tracker.image().size(), CV_8UC1, cv::Scalar(0))));
  EXPECT_EQ(tracker.tracks().size(), tracks);
  PointTracker empty{PointTrackerOptions()};
  EXPECT_FALSE(track_near_matches(empty, tracker.image()));
}

TEST(PointTracker, FindsNearAPredictionWhatAWideSearchFinds) {
  PointTracker wide = started(), near = started();
  std::vector<Eigen::Vector2f> predicted;
  for (const PointTrack& track : wide.tracks())
    predicted.push_back(track.px + Eigen::Vector2f(28.5f, 1.5f));
  const Image next = texture_image(kWidth, kHeight, kTexture, -30);
  wide.track(next, predicted, PointTracker::Search::kWide);
  near.track(next, predicted, PointTracker::Search::kNear);
  ASSERT_GT(near.tracks().size(), 0.9 * static_cast<double>(wide.tracks().size()));
  std::map<LandmarkId, Eigen::Vector2f> found;
  for (const PointTrack& track : wide.tracks()) found[track.id] = track.px;
  std::size_t same = 0;
  for (const PointTrack& track : near.tracks())
    same += found.count(track.id) && (found.at(track.id) - track.px).norm() < 0.02;
  EXPECT_GT(same, 0.9 * static_cast<double>(near.tracks().size()));
}

/// The texture `zoom` times as large about the middle of the image.
Image zoomed(double zoom) {
  Image image(kHeight, kWidth, CV_8UC1);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u)
      image.at<std::uint8_t>(v, u) =
          test::to_grey(kTexture.grey((u - kWidth / 2) / zoom, (v - kHeight / 2) / zoom));
  return image;
}

TEST(PointTracker, DoesNotDriftOnWhatGrowsAsItComesNearerWhereItsFirstLookHoldsIt) {
  const auto error_px = [](bool anchored) {
    PointTracker tracker{PointTrackerOptions()};
    tracker.track(zoomed(1));
    tracker.detect();
    std::map<LandmarkId, Eigen::Vector2f> first;
    for (const PointTrack& track : tracker.tracks()) first[track.id] = track.px;
    const Eigen::Vector2f middle(kWidth / 2, kHeight / 2);
    for (int k = 1; k <= 12; ++k) {
      tracker.track(zoomed(1 + 0.03 * k));
      if (anchored) tracker.anchor();
    }
    std::vector<float> errors;
    for (const PointTrack& track : tracker.tracks())
      errors.push_back((track.px - middle - 1.36f * (first.at(track.id) - middle)).norm());
    EXPECT_GT(errors.size(), 50u);
    std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
    return errors[errors.size() / 2];
  };
  const float drifting = error_px(false), held = error_px(true);
  EXPECT_LT(held, 0.05f);
  EXPECT_GT(drifting, 3 * held);
}

TEST(PointTracker, KnowsATrackTheWorseTheOftenerItsLookWasLost) {
  PointTrackerOptions options;
  options.min_anchor_correlation = 1;  // with noise nothing looks so alike
  PointTracker tracker = started(options);
  std::vector<bool> has_template;
  for (const PointTrack& track : tracker.tracks()) has_template.push_back(track.anchor != nullptr);
  tracker.keep(has_template);
  const float begin = tracker.tracks().front().covariance(0, 0);
  EXPECT_FLOAT_EQ(begin, 0.25f * 0.25f);
  const float step = 0.7f * 0.7f, most = 1.5f * 1.5f;
  Random random(3);
  for (int lost = 1; begin + static_cast<float>(lost) * step < most; ++lost) {
    Image image = texture_image(kWidth, kHeight, kTexture);
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u)
        image.at<std::uint8_t>(v, u) =
            test::to_grey(image.at<std::uint8_t>(v, u) + 3 * random.normal());
    tracker.track(image);
    tracker.anchor();
    ASSERT_FALSE(tracker.tracks().empty());
    for (const PointTrack& track : tracker.tracks())
      EXPECT_NEAR(track.covariance(0, 0), begin + static_cast<float>(lost) * step, 1e-4f);
  }
  tracker.track(texture_image(kWidth, kHeight, kTexture));
  tracker.anchor();
  EXPECT_TRUE(tracker.tracks().empty());  // beyond max_sigma_px
}

TEST(PointTracker, DropsTracksThatLeaveTheImage) {
  PointTracker tracker = started();
  std::set<LandmarkId> leaving;
  for (const PointTrack& track : tracker.tracks())
    if (track.px.x() > kWidth - 37) leaving.insert(track.id);
  ASSERT_GT(leaving.size(), 2u);
  tracker.track(texture_image(kWidth, kHeight, kTexture, -40));
  ASSERT_FALSE(tracker.tracks().empty());
  for (const PointTrack& track : tracker.tracks()) EXPECT_FALSE(leaving.count(track.id));
}

TEST(PointTracker, DropsTracksThatDoNotComeBack) {
  // Another texture altogether: nothing can be followed forth and back.
  PointTracker tracker = started();
  const std::size_t detected = tracker.tracks().size();
  tracker.track(texture_image(kWidth, kHeight, {99, 24, 2, 50}));
  EXPECT_LT(tracker.tracks().size(), 0.2 * detected);
}

TEST(PointTracker, CoversTheImageEvenlyEvenWhereHalfOfItIsFaint) {
  Image image = texture_image(kWidth, kHeight, {7, 12, 2, 60});
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth / 2; ++u)
      image.at<std::uint8_t>(v, u) =
          static_cast<std::uint8_t>(60 + image.at<std::uint8_t>(v, u) / 2);
  PointTrackerOptions options;
  options.max_tracks = 80;
  PointTracker tracker(options);
  tracker.track(image);
  tracker.detect();
  EXPECT_EQ(tracker.tracks().size(), 80u);
  int left = 0;
  for (const PointTrack& track : tracker.tracks()) left += track.px.x() < kWidth / 2;
  EXPECT_GE(left, 30);
  EXPECT_LE(left, 50);
  for (const PointTrack& a : tracker.tracks())
    for (const PointTrack& b : tracker.tracks())
      if (a.id < b.id) {
        EXPECT_GE((a.px - b.px).norm(), options.min_distance_px);
      }
}

TEST(PointTracker, NeverUsesAnIdTwice) {
  PointTracker tracker = started();
  std::set<LandmarkId> ids;
  const auto collect = [&](std::size_t expected_new) {
    std::size_t fresh = 0;
    for (const PointTrack& track : tracker.tracks()) fresh += ids.insert(track.id).second;
    EXPECT_EQ(fresh, expected_new);
  };
  collect(tracker.tracks().size());
  std::vector<bool> flags(tracker.tracks().size());
  for (std::size_t i = 0; i < flags.size(); i += 2) flags[i] = true;
  tracker.keep(flags);
  const std::size_t kept = tracker.tracks().size();
  EXPECT_EQ(kept, (flags.size() + 1) / 2);
  collect(0);
  tracker.detect();
  EXPECT_GT(tracker.tracks().size(), kept);
  collect(tracker.tracks().size() - kept);
  tracker.reset();
  EXPECT_TRUE(tracker.tracks().empty());
  tracker.track(texture_image(kWidth, kHeight, kTexture));
  tracker.detect();
  collect(tracker.tracks().size());
}

TEST(PointTracker, DetectsNothingUnderTheMaskAndOnFlatGround) {
  PointTracker tracker{PointTrackerOptions{}};
  tracker.track(texture_image(kWidth, kHeight, kTexture));
  Image mask(kHeight, kWidth, CV_8UC1, cv::Scalar(255));
  mask.colRange(0, 100).setTo(0);
  tracker.detect(mask);
  ASSERT_FALSE(tracker.tracks().empty());
  for (const PointTrack& track : tracker.tracks()) EXPECT_GE(track.px.x(), 100);
  PointTracker flat{PointTrackerOptions{}};
  flat.track(Image(kHeight, kWidth, CV_8UC1, cv::Scalar(90)));
  flat.detect();
  EXPECT_TRUE(flat.tracks().empty());
}

TEST(PointTracker, RefusesAnotherSizeOrTypeAndWrongCounts) {
  PointTracker tracker = started();
  EXPECT_THROW(tracker.track(texture_image(kWidth, kHeight + 2, kTexture)), ArgumentError);
  EXPECT_THROW(tracker.track(Image(kHeight, kWidth, CV_8UC3)), ArgumentError);
  const Image image = texture_image(kWidth, kHeight, kTexture);
  EXPECT_THROW(tracker.track(image, {{1, 1}}), ArgumentError);
  EXPECT_THROW(tracker.keep({true}), ArgumentError);
  PointTracker fresh{PointTrackerOptions{}};
  EXPECT_THROW(fresh.detect(), ArgumentError);
  PointTrackerOptions even;
  even.window_px = 20;
  EXPECT_THROW(PointTracker{even}, ArgumentError);
  // What was refused left no trace.
  tracker.track(image);
  EXPECT_FALSE(tracker.tracks().empty());
}

}  // namespace point_tracker_test
}  // namespace placegraph
