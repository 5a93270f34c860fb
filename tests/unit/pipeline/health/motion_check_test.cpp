#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/pipeline/health/motion_check.h>

#include "tests/support/seed.h"

namespace placegraph {
namespace motion_check_test {

using testing::HasSubstr;

/// A drive of `speed` at 10 Hz that turns by `rotation_deg` about `axis` of the camera in all.
Trajectory drive(double speed, const Eigen::Vector3d& axis, double rotation_deg) {
  Trajectory trajectory;
  SE3 T_world_cam;
  constexpr int kFrames = 200;
  for (int i = 0; i < kFrames; ++i) {
    trajectory.poses.push_back({i * 100'000'000LL + 7, T_world_cam.isometry()});
    T_world_cam = T_world_cam * SE3(SO3::exp(deg_to_rad(rotation_deg / kFrames) * axis),
                                    Eigen::Vector3d(0, 0, 0.1 * speed));
  }
  return trajectory;
}

Camera camera(int width, int height) {
  return {.width = width,
          .height = height,
          .fx = 300,
          .fy = 300,
          .cx = 0.5 * width,
          .cy = 0.5 * height};
}

const Eigen::Vector3d kX = Eigen::Vector3d::UnitX(), kY = Eigen::Vector3d::UnitY();

TEST(Rotations, AreSummedByAxis) {
  const Rotations rotations = rotations_of(drive(10, kY, 90));
  EXPECT_NEAR(rotations.about_y_deg, 88, 2);
  EXPECT_NEAR(rotations.about_x_deg, 0, 1e-6);
}

TEST(OddPosture, IsThatOfACameraOnItsSide) {
  EXPECT_FALSE(odd_posture(camera(640, 480), rotations_of(drive(10, kY, 90))));
  EXPECT_FALSE(odd_posture(camera(640, 480), rotations_of(drive(10, kY, 0))));
  const auto side = odd_posture(camera(640, 480), rotations_of(drive(10, kX, 90)));
  ASSERT_TRUE(side);
  EXPECT_TRUE(side->doubts_scale);
  EXPECT_THAT(side->text, HasSubstr("as if it lay on its side"));
}

TEST(OddPosture, OfHighImagesIsReportedUnlessTheyBecomeUpright) {
  EXPECT_THAT(odd_posture(camera(480, 640), rotations_of(drive(10, kY, 0)))->text,
              HasSubstr("higher than wide"));
  EXPECT_FALSE(odd_posture(camera(480, 640), rotations_of(drive(10, kY, 60))));
}

/// A drive of ten keyframes ahead, with forty points on each of three sides at these distances [m].
Map map_with(double below, double left, double right) {
  Map map;
  map.place_graph.places.emplace_back();
  for (int k = 0; k < 10; ++k) {
    Keyframe keyframe;
    keyframe.id = KeyframeId(k);
    keyframe.frame = FrameId(k);
    keyframe.T_place_keyframe = SE3(SO3(), Eigen::Vector3d(0, 0, k));
    map.keyframes.push_back(keyframe);
    for (const Eigen::Vector3d& at : {Eigen::Vector3d(0, below, 6), Eigen::Vector3d(-left, 0, 6),
                                      Eigen::Vector3d(right, 0.1, 6)})
      for (int i = 0; i < 4; ++i) {
        PointLandmark landmark;
        landmark.keyframe = KeyframeId(k);
        landmark.point_cam = at + Eigen::Vector3d(0, 0, i);
        landmark.observations = 5;
        map.landmarks.push_back(landmark);
      }
  }
  return map;
}

TEST(NearestSides, AreThoseOfAStreetOrOfACameraOnItsSide) {
  const NearestSides street = nearest_sides(map_with(1.65, 5, 6), 1.65);
  EXPECT_NEAR(street.below, 1, 1e-9);
  EXPECT_NEAR(street.nearest_other, 5 / 1.65, 1e-9);
  EXPECT_TRUE(street.are_upright());
  EXPECT_FALSE(odd_sides(street));
  const NearestSides rotated = nearest_sides(map_with(1.2, 0.4, 6), 1.65);
  EXPECT_FALSE(rotated.are_upright());
  ASSERT_TRUE(odd_sides(rotated));
  EXPECT_TRUE(odd_sides(rotated)->doubts_scale);
  // A corridor: walls nearer than the floor, which is where it is to be.
  EXPECT_FALSE(odd_sides(nearest_sides(map_with(1.65, 0.8, 0.9), 1.65)));
  EXPECT_FALSE(odd_sides(nearest_sides(Map(), 1.65)));
  // A narrow one, with doors and posters before the walls: the floor is seen nevertheless.
  EXPECT_TRUE(odd_sides({0.6, 0.5, 0.1}));
  EXPECT_FALSE(odd_sides({0.6, 0.5, 0.4}));
  EXPECT_NEAR(street.on_ground, 1, 1e-9);
  EXPECT_NEAR(rotated.on_ground, 0, 1e-9);
}

TEST(OddHeight, ContradictsTheBaselineOrTheDepths) {
  const auto note_for = [](double height_m, Sensor sensor) {
    return odd_height(nearest_sides(map_with(1.65, 5, 6), height_m), sensor, height_m);
  };
  EXPECT_FALSE(note_for(1.65, Sensor::kStereo));
  EXPECT_FALSE(note_for(1.4, Sensor::kStereo));
  EXPECT_FALSE(note_for(2.2, Sensor::kStereo));
  for (const double height_m : {0.8, 3.3}) {
    const auto note = note_for(height_m, Sensor::kStereo);
    ASSERT_TRUE(note) << height_m;
    EXPECT_EQ(note->cause, NoteCause::kScale);
    EXPECT_TRUE(note->doubts_scale);
    EXPECT_THAT(note->text, HasSubstr("1.65 m below it by the baseline"));
  }
  EXPECT_THAT(note_for(3.3, Sensor::kRgbd)->text, HasSubstr("by the depth images"));
  EXPECT_FALSE(odd_height(nearest_sides(Map(), 1.65), Sensor::kStereo, 1.65));
}

TEST(OddSteps, AreLongerThanThoseBesideThem) {
  Trajectory trajectory = drive(10, kY, 90);
  EXPECT_FALSE(odd_steps(trajectory, 20));
  for (std::size_t i = 100; i < trajectory.size(); ++i)
    trajectory.poses[i].T_world_body->pretranslate(Eigen::Vector3d(0, 0, 12));
  const auto note = odd_steps(trajectory, 20);
  ASSERT_TRUE(note);
  EXPECT_EQ(note->cause, NoteCause::kJump);
  EXPECT_THAT(note->text, HasSubstr("jumps in 1 frames, the first is pose 100"));
}

TEST(OddSteps, AreNotThoseOfACameraThatStartsOrStops) {
  Trajectory trajectory = drive(10, kY, 0);
  for (std::size_t i = 0; i < 80; ++i) trajectory.poses[i] = trajectory.poses[80];
  EXPECT_FALSE(odd_steps(trajectory, 0));
  trajectory.poses.resize(10);
  EXPECT_FALSE(odd_steps(trajectory, 0));
}

// A camera that turns at the place, whose poses a loop corrects, is no recording with a gap.
TEST(OddSteps, AreShownByTheImages) {
  Random random = test::seeded_random(2);
  for (int round = 0; round < 50; ++round) {
    const double depth = std::exp(random.uniform(-2, 5));
    Trajectory trajectory = drive(1e-3 * depth, kY, 90);
    const auto jumping = [&](double jump) {
      Trajectory result = trajectory;
      const int first = 10 + random.index(180);
      for (std::size_t i = static_cast<std::size_t>(first); i < result.size(); ++i)
        result.poses[i].T_world_body->pretranslate(Eigen::Vector3d(0, jump * depth, 0));
      return result;
    };
    EXPECT_FALSE(odd_steps(jumping(random.uniform(0, 0.0095)), depth)) << round;
    EXPECT_TRUE(odd_steps(jumping(random.uniform(0.0105, 1)), depth)) << round;
  }
}

TEST(LandmarkDepth, IsTheMedianOfTheComponent) {
  Map map = map_with(5, 5, 5);
  EXPECT_EQ(landmark_depth(Map(), 0), 0);
  EXPECT_EQ(landmark_depth(map, 1), 0);
  std::vector<double> depths;
  for (const PointLandmark& landmark : map.landmarks) depths.push_back(landmark.point_cam.z());
  const double once = landmark_depth(map, 0);
  EXPECT_GE(once, *std::ranges::min_element(depths));
  EXPECT_LE(once, *std::ranges::max_element(depths));
  map.place_graph.places[0].scale = 3;
  EXPECT_NEAR(landmark_depth(map, 0), 3 * once, 1e-9);
}

TEST(OddOrder, IsThatOfImagesThatChangedPlaces) {
  Trajectory trajectory = drive(10, kY, 90);
  EXPECT_FALSE(odd_order(trajectory));
  for (std::size_t i = 0; i + 1 < 30; i += 2)
    std::swap(trajectory.poses[i].T_world_body, trajectory.poses[i + 1].T_world_body);
  const auto note = odd_order(trajectory);
  ASSERT_TRUE(note);
  EXPECT_EQ(note->cause, NoteCause::kTimes);
  EXPECT_THAT(note->text, HasSubstr("to and fro"));
}

TEST(OddOrder, IsNotThatOfACameraThatStandsOrReturns) {
  Trajectory trajectory = drive(10, kY, 0);
  for (std::size_t i = 100; i < trajectory.size(); ++i)
    trajectory.poses[i].T_world_body = trajectory.poses[trajectory.size() - i].T_world_body;
  EXPECT_FALSE(odd_order(trajectory));
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    trajectory.poses[i].T_world_body = trajectory.poses[0].T_world_body;
    if (i % 2 == 0) trajectory.poses[i].T_world_body->translation().x() += 1e-3;
  }
  EXPECT_FALSE(odd_order(trajectory));
}

TEST(OddOrder, IsNotThatOfAHandThatTremblesAndRotates) {
  Trajectory trajectory;
  for (int i = 0; i < 200; ++i) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.rotate(Eigen::AngleAxisd(deg_to_rad(1.5 * i), Eigen::Vector3d::UnitY()));
    T.translation() = Eigen::Vector3d(2e-3 * i, i % 2 == 0 ? 6e-3 : 0, 0);
    trajectory.poses.push_back({i * 33'000'000LL, T});
  }
  EXPECT_FALSE(odd_order(trajectory));
  for (StampedPose& pose : trajectory.poses)
    pose.T_world_body->linear() = Eigen::Matrix3d::Identity();
  EXPECT_TRUE(odd_order(trajectory));  // the same without the rotation
}

TEST(OddSpeed, IsFasterThanAnyVehicle) {
  EXPECT_FALSE(odd_speed(drive(40, kY, 0)));
  const auto note = odd_speed(drive(1000, kY, 0));
  ASSERT_TRUE(note);
  EXPECT_TRUE(note->doubts_scale);
  EXPECT_THAT(note->text, HasSubstr("moves at 1e+03 m/s"));
  Trajectory lost = drive(1000, kY, 0);
  for (StampedPose& pose : lost.poses) pose.T_world_body.reset();
  EXPECT_FALSE(odd_speed(lost));
  EXPECT_FALSE(odd_speed({}));
  Trajectory counted = drive(1000, kY, 0);
  for (StampedPose& pose : counted.poses) pose.stamp_ns -= 7;
  EXPECT_FALSE(odd_speed(counted));
}

}  // namespace motion_check_test
}  // namespace placegraph
