#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/pipeline/health/right_image_time.h>

#include "tests/support/scenes/street.h"

namespace placegraph {
namespace right_image_time_test {

using testing::HasSubstr;

const Camera kCamera = test::street_camera();

/// Points before two cameras with noise of `noise_px`; every tenth match is wrong.
std::vector<StereoMatch> matches_for(const SE3& T_left_right, double noise_px, Random& random) {
  std::vector<StereoMatch> matches;
  while (matches.size() < 120) {
    const double z = random.uniform(4, 40);
    const Eigen::Vector3d p(z * random.uniform(-0.6, 0.6), z * random.uniform(-0.4, 0.4), z);
    const auto left = kCamera.project(p), right = kCamera.project(T_left_right.inverse() * p);
    if (!left || !right) continue;
    const auto noise = [&]() -> Eigen::Vector2d {
      return noise_px * Eigen::Vector2d(random.normal(), random.normal());
    };
    const double wrong_px = matches.size() % 10 == 0 ? random.uniform(-60, 60) : 0;
    matches.push_back({*left + noise(), *right + noise() + Eigen::Vector2d(0, wrong_px)});
  }
  return matches;
}

TEST(RightCameraOffset, IsThatOfTheSecondCamera) {
  Random random(1);
  for (const Eigen::Vector3d& t :
       {Eigen::Vector3d(0.5, 0, 0), Eigen::Vector3d(0.5, 0, 1), Eigen::Vector3d(0.5, 0.1, -0.7)}) {
    const SE3 T_left_right(SO3::exp({0.004, -0.003, 0.005}), t);
    const auto offset = right_camera_offset(kCamera, matches_for(T_left_right, 0.3, random));
    ASSERT_TRUE(offset);
    const Eigen::Vector2d error = offset->yz_share - t.tail<2>() / t.x();
    EXPECT_LT(error.norm(), 0.15) << t.transpose();
    EXPECT_LT(error.dot(offset->information * error), 20) << t.transpose();
  }
}

TEST(RightCameraOffset, NeedsMatches) {
  Random random(1);
  auto few = matches_for(SE3(SO3(), Eigen::Vector3d(0.5, 0, 0)), 0.3, random);
  few.resize(20);
  EXPECT_FALSE(right_camera_offset(kCamera, few));
}

Calibration stereo() {
  Calibration calibration;
  calibration.camera = kCamera;
  calibration.baseline_m = test::kStreetBaseline_m;
  return calibration;
}

/// Offsets of pairs whose right images were taken `late` frames after the left ones.
std::optional<DataNote> note_for(double late, int pairs, double step_m) {
  Random random(2);
  RightImageTime time(stereo());
  for (int i = 0; i < pairs; ++i) {
    const Eigen::Vector3d motion(0, 0, step_m * (1 + 0.1 * i));
    const SE3 T_left_right(SO3(), Eigen::Vector3d(0.5, 0, 0) + late * motion);
    time.add(*right_camera_offset(kCamera, matches_for(T_left_right, 0.3, random)), motion);
  }
  return time.note();
}

TEST(RightImageTime, FindsLateAndEarlyImages) {
  for (const double late : {-1.0, -0.5, 0.5, 1.0}) {
    const auto note = note_for(late, 4, 0.8);
    ASSERT_TRUE(note) << late;
    EXPECT_EQ(note->cause, NoteCause::kRightImageLate);
    EXPECT_TRUE(note->doubts_scale);
    EXPECT_THAT(note->text, HasSubstr(late > 0 ? "ahead of" : "behind"));
    EXPECT_THAT(note->advice, HasSubstr(late > 0 ? "previous" : "next"));
  }
}

TEST(RightImageTime, AcceptsImagesOfOneTime) {
  EXPECT_FALSE(note_for(0, 8, 0.8));
  EXPECT_FALSE(note_for(0.02, 8, 0.8));
  EXPECT_FALSE(note_for(0, 8, 0.05));
}

TEST(RightImageTime, NeedsSeveralPairs) { EXPECT_FALSE(note_for(1, 2, 0.8)); }

/// The drive along the street whose right images are those of the frame `late` frames later.
std::optional<DataNote> note_of_drive(int late) {
  constexpr int kFrames = 41;
  RightImageTime time(stereo());
  const auto planes = test::street();
  for (int i = 1; i < kFrames; ++i) {
    Frame frame;
    frame.id = FrameId(i);
    const SE3 T_world_left = test::street_T_world_cam(i);
    if (i % 4 == 0) {
      const SE3 T_world_right = test::street_T_world_cam(i + late) *
                                test::pose({0, 0, 0}, {test::kStreetBaseline_m, 0, 0});
      frame.image = test::render(kCamera, T_world_left, planes, 1).grey;
      frame.right = test::render(kCamera, T_world_right, planes, 1).grey;
    }
    time.add(frame, T_world_left);
  }
  return time.note();
}

TEST(RightImageTime, MatchesTheImagesOfADrive) {
  EXPECT_FALSE(note_of_drive(0));
  EXPECT_TRUE(note_of_drive(1));
  EXPECT_TRUE(note_of_drive(-1));
}

}  // namespace right_image_time_test
}  // namespace placegraph
