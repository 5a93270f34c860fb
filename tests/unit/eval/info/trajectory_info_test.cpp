#include <gmock/gmock.h>
#include <placegraph/eval/info/trajectory_info.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <functional>
#include <numbers>

#include "tests/support/data.h"
#include "tests/support/message_of.h"
#include "tests/support/random_map.h"
#include "tests/support/trajectories.h"

namespace placegraph {
namespace trajectory_info_test {

using test::message_of;
using testing::HasSubstr;

// Axes of a body by columns: where x, y and z of the body look, in axes with x forward, z up.
const Eigen::Matrix3d kVehicle = Eigen::Matrix3d::Identity();
const Eigen::Matrix3d kCamera{{0, 0, 1}, {-1, 0, 0}, {0, -1, 0}};

/// A vehicle at 10 Hz that winds through a plane at about 10 m/s, in a world with z up.
Trajectory vehicle(int frames, const Eigen::Matrix3d& R_vehicle_body = kVehicle) {
  std::vector<Eigen::Isometry3d> poses;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (int i = 0; i < frames; ++i) {
    Eigen::Isometry3d T_world_body = T;
    T_world_body.linear() = T.linear() * R_vehicle_body;
    poses.push_back(T_world_body);
    const double yaw = 0.1 * std::sin(0.03 * i) + 0.02;
    T = T * test::isometry({0, 0, yaw / 2}, {0, 0, 0}) * test::isometry({0, 0, 0}, {1, 0, 0}) *
        test::isometry({0, 0, yaw / 2}, {0, 0, 0});
  }
  return test::trajectory_of(poses);
}

Trajectory moved(Trajectory trajectory, const Eigen::Isometry3d& T) {
  for (StampedPose& pose : trajectory.poses)
    if (pose.T_world_body) *pose.T_world_body = T * *pose.T_world_body;
  return trajectory;
}

Trajectory changed(Trajectory trajectory, const std::function<void(Eigen::Isometry3d&)>& change) {
  for (StampedPose& pose : trajectory.poses) change(*pose.T_world_body);
  return trajectory;
}

TEST(TrajectoryInfo, MeasuresLengthDurationRateAndSpeeds) {
  const TrajectoryInfo info = trajectory_info(vehicle(201));
  EXPECT_EQ(info.frames, 201u);
  EXPECT_EQ(info.posed, 201u);
  EXPECT_EQ(info.last_ns - info.first_ns, 20'000'000'000);
  EXPECT_NEAR(info.length_m, 200, 1e-9);
  EXPECT_NEAR(info.spacing_s.median, 0.1, 1e-12);
  EXPECT_EQ(info.spacing_s.count, 200u);
  EXPECT_NEAR(info.speed.median, 10, 1e-9);
  EXPECT_NEAR(info.speed.max, 10, 1e-9);
  // The fastest turn is 0.12 rad in 0.1 s.
  EXPECT_NEAR(info.turning_deg.max, rad_to_deg(1.2), 0.01);
  EXPECT_TRUE(info.gaps.empty());
  EXPECT_TRUE(info.stops.empty());
  EXPECT_TRUE(info.jumps.empty());
  EXPECT_EQ(info.repeated, 0u);
}

TEST(TrajectoryInfo, FindsGapsStopsAndJumpsWhereTheyAre) {
  const Trajectory moving = vehicle(270);
  Trajectory drive = vehicle(300);
  for (std::size_t i = 50; i < 300; ++i)  // it stands from frame 49 to 79
    drive.poses[i].T_world_body = moving.poses[i < 80 ? 49 : i - 30].T_world_body;
  for (std::size_t i = 150; i < 300; ++i)
    drive.poses[i].T_world_body->translation() += Eigen::Vector3d(0, 20, 0);
  drive.poses[200].T_world_body->translation() += Eigen::Vector3d(0, 0, 30);  // one wrong pose
  for (std::size_t i = 250; i < 256; ++i) drive.poses[i].T_world_body.reset();
  const TrajectoryInfo info = trajectory_info(drive);
  ASSERT_EQ(info.gaps.size(), 1u);
  EXPECT_EQ(info.gaps[0].first, 249u);
  EXPECT_EQ(info.gaps[0].last, 256u);
  EXPECT_EQ(info.gaps[0].length_ns(), 700'000'000);
  ASSERT_EQ(info.stops.size(), 1u);
  EXPECT_EQ(info.stops[0].first, 49u);
  EXPECT_EQ(info.stops[0].last, 79u);
  std::vector<std::size_t> jumps;
  for (const ImplausibleStep& jump : info.jumps) jumps.push_back(jump.span.last);
  EXPECT_EQ(jumps, (std::vector<std::size_t>{150, 200, 201}));
  EXPECT_NEAR(*info.jumps[1].times_faster, std::hypot(1, 30), 0.1);
  EXPECT_EQ(info.repeated, 30u);
}

TEST(TrajectoryInfo, ADriveThatBeginsFromRestAtALowRateHasNoJumps) {
  Trajectory drive;
  for (int i = 0; i < 40; ++i)
    drive.poses.push_back({std::int64_t{i} * 1'000'000'000,
                           test::isometry({0, 0, 0}, {i < 20 ? 0.0 : 5.0 * (i - 19), 0, 0})});
  EXPECT_TRUE(trajectory_info(drive).jumps.empty());
}

TEST(TrajectoryInfo, FindsPlaneTiltAndForwardAxisInAnyWorld) {
  Random random(21);
  for (int world = 0; world < 40; ++world) {
    SCOPED_TRACE("world " + std::to_string(world) + " of seed 21");
    const bool camera = world % 2 == 0;
    // The camera's world has the axes of its first camera, as that of KITTI: y across the plane.
    Eigen::Isometry3d axes = Eigen::Isometry3d::Identity();
    if (camera) axes.linear() = kCamera.transpose();
    const double tilt_deg = random.uniform(0, 30);
    const double about = random.uniform(0, 2 * std::numbers::pi);
    const Eigen::Vector3d in_plane =
        axes.linear() * Eigen::Vector3d(std::cos(about), std::sin(about), 0);
    const Eigen::Vector3d p(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9));
    const Eigen::Isometry3d tilted = test::isometry(deg_to_rad(tilt_deg) * in_plane, p);
    const TrajectoryInfo info =
        trajectory_info(moved(vehicle(200, camera ? kCamera : kVehicle), tilted * axes));
    ASSERT_TRUE(info.plane.outcome) << info.plane.outcome.reason;
    EXPECT_EQ(info.plane.axis, camera ? 'y' : 'z');
    EXPECT_NEAR(info.plane.tilt_deg, tilt_deg, 1e-6);
    EXPECT_LT(info.plane.rms_m, 1e-9);
    ASSERT_TRUE(info.forward.outcome) << info.forward.outcome.reason;
    EXPECT_EQ(info.forward.axis, camera ? "+z" : "+x");
    EXPECT_LT(info.forward.angle_deg, 1);
  }
}

TEST(TrajectoryInfo, SaysWhereNothingIsEvident) {
  Random random(22);
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < 100; ++i) poses.push_back(test::random_pose(random).isometry());
  const TrajectoryInfo wild = trajectory_info(test::trajectory_of(poses));
  EXPECT_EQ(wild.plane.outcome.code, Outcome::Code::kDegenerate);
  EXPECT_EQ(wild.forward.outcome.code, Outcome::Code::kDegenerate);
  EXPECT_EQ(wild.quaternions.outcome.code, Outcome::Code::kDegenerate);

  Trajectory line;
  for (int i = 0; i < 50; ++i)
    line.poses.push_back({i * 100'000'000LL, test::isometry({0, 0, 0}, {1.0 * i, 0, 0})});
  EXPECT_THAT(trajectory_info(line).plane.outcome.reason, HasSubstr("a straight line"));

  Trajectory still;
  for (int i = 0; i < 50; ++i)
    still.poses.push_back({i * 100'000'000LL, test::isometry({0, 0, 0}, {1, 2, 3})});
  const TrajectoryInfo stands = trajectory_info(still);
  EXPECT_THAT(stands.plane.outcome.reason, HasSubstr("does not move"));
  EXPECT_FALSE(stands.length_unit.outcome);
  ASSERT_EQ(stands.stops.size(), 1u);

  const TrajectoryInfo none = trajectory_info({});
  EXPECT_EQ(none.frames, 0u);
  EXPECT_EQ(none.plane.outcome.code, Outcome::Code::kTooFewData);
  EXPECT_FALSE(none.time_unit.outcome);
}

TEST(TrajectoryInfo, ABodyThatTurnsAboutAnotherAxisIsInNoEvidentPlane) {
  // Rolls about its own x axis while its path is in the plane of x and y.
  Trajectory drive = vehicle(200);
  double roll = 0;
  for (StampedPose& pose : drive.poses) {
    pose.T_world_body->linear() =
        Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()).toRotationMatrix();
    roll += 0.2;
  }
  const MotionPlane plane = trajectory_info(drive).plane;
  EXPECT_EQ(plane.outcome.code, Outcome::Code::kInconsistent);
  EXPECT_THAT(plane.outcome.reason, HasSubstr("turns about an axis 90 deg from its normal"));
}

TEST(TrajectoryInfo, TellsTheOrderOfQuaternionsOfAVehicle) {
  const Trajectory right = vehicle(200);
  const Likelihood as_read = trajectory_info(right).quaternions;
  EXPECT_TRUE(as_read.outcome && as_read.as_read) << as_read.answer << as_read.outcome.reason;
  const Trajectory wrong = changed(right, [](Eigen::Isometry3d& T) {
    const Eigen::Quaterniond q(T.linear());  // w x y z in the file, read as x y z w
    T.linear() = Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y()).toRotationMatrix();
  });
  const Likelihood other = trajectory_info(wrong).quaternions;
  ASSERT_TRUE(other.outcome) << other.outcome.reason;
  EXPECT_FALSE(other.as_read);
  EXPECT_THAT(other.answer, HasSubstr("w first, although read as w last"));
}

TEST(TrajectoryInfo, DoubtsUnitsThatMakeSpeedsOrTimesImplausible) {
  const auto scaled = [](double factor) {
    return trajectory_info(changed(vehicle(200), [factor](Eigen::Isometry3d& T) {
             T.translation() *= factor;
           })).length_unit;
  };
  EXPECT_TRUE(scaled(1).as_read);
  EXPECT_THAT(scaled(1).answer, HasSubstr("usually 10 m/s"));
  EXPECT_FALSE(scaled(1000).as_read);
  EXPECT_THAT(scaled(1000).answer, HasSubstr("millimetres"));
  EXPECT_FALSE(scaled(1e-6).outcome);

  const Likelihood degrees = trajectory_info(changed(vehicle(200), [](Eigen::Isometry3d& T) {
                               T.translation() /= 111'000;
                               T.translation() += Eigen::Vector3d(49, 8.4, 110);
                             })).length_unit;
  EXPECT_FALSE(degrees.as_read);
  EXPECT_THAT(degrees.answer, HasSubstr("degrees of latitude and longitude"));

  Trajectory milliseconds = vehicle(200);
  for (StampedPose& pose : milliseconds.poses) pose.stamp_ns *= 1000;
  const Likelihood times = trajectory_info(milliseconds).time_unit;
  EXPECT_FALSE(times.as_read);
  EXPECT_THAT(times.answer, HasSubstr("are these milliseconds?"));
}

TEST(TrajectoryInfo, OfFramesWithoutTimesCountsInFrames) {
  Trajectory frames = vehicle(100);
  frames.has_times = false;
  for (std::size_t i = 0; i < 100; ++i) frames.poses[i].stamp_ns = static_cast<std::int64_t>(i);
  for (std::size_t i = 60; i < 70; ++i) frames.poses[i].T_world_body.reset();
  const TrajectoryInfo info = trajectory_info(frames);
  EXPECT_NEAR(info.speed.median, 1, 1e-9);  // metres a frame
  EXPECT_EQ(info.spacing_s.median, 1);
  ASSERT_EQ(info.gaps.size(), 1u);
  EXPECT_EQ(info.gaps[0].length_ns(), 11);
  EXPECT_FALSE(info.length_unit.outcome);
  EXPECT_FALSE(info.time_unit.outcome);
}

TEST(TrajectoryInfo, OfPositionsAloneHasNoTurns) {
  Trajectory positions = vehicle(100);
  positions.has_orientation = false;
  positions.warnings = {"p:3: odd"};
  const TrajectoryInfo info = trajectory_info(positions);
  EXPECT_EQ(info.turning_deg.count, 0u);
  EXPECT_TRUE(info.plane.outcome);
  EXPECT_FALSE(info.forward.outcome);
  EXPECT_FALSE(info.quaternions.outcome);
  EXPECT_EQ(info.warnings, positions.warnings);
}

TEST(TrajectoryInfo, StampsMustIncrease) {
  Trajectory twice = vehicle(3);
  twice.poses[2].stamp_ns = twice.poses[1].stamp_ns;
  EXPECT_THAT(message_of<ArgumentError>([&] { trajectory_info(twice); }),
              HasSubstr("stamp of frame 2 does not increase"));
}

TEST(TrajectoryInfo, OfKittiIsACameraThatLooksForwardAboveALevelPlane) {
  PLACEGRAPH_DATA_OR_SKIP(folder, "kitti_gt");
  for (const char* sequence : {"00", "02", "05", "06", "07", "08", "09", "10"}) {
    SCOPED_TRACE(sequence);
    const TrajectoryInfo info =
        trajectory_info(read_trajectory(folder + "/" + sequence + "/poses.txt"));
    EXPECT_EQ(info.forward.axis, "+z");
    EXPECT_TRUE(info.forward.outcome) << info.forward.outcome.reason;
    EXPECT_TRUE(info.gaps.empty());
    EXPECT_TRUE(info.jumps.empty());
    EXPECT_TRUE(!info.plane.outcome || info.plane.axis == 'y');
  }
}

}  // namespace trajectory_info_test
}  // namespace placegraph
