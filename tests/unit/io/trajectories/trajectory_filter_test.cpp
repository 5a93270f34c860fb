#include <fmt/format.h>
#include <gmock/gmock.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/io/trajectories/trajectory_file.h>
#include <placegraph/io/trajectories/trajectory_filter.h>

#include <numbers>

#include "tests/support/message_of.h"
#include "tests/support/paths.h"
#include "tests/support/random_map.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/trajectories.h"

namespace placegraph {
namespace trajectory_filter_test {

using test::message_of;
using test::TemporaryFolder;
using testing::HasSubstr;

Trajectory filtered(const Trajectory& trajectory, const std::string& chain) {
  return TrajectoryFilter(chain).apply(trajectory);
}

std::vector<int> tenths(const Trajectory& trajectory) {
  std::vector<int> times;
  for (const StampedPose& pose : trajectory.poses)
    times.push_back(static_cast<int>(pose.stamp_ns / 100'000'000));
  return times;
}

double difference(const Trajectory& a, const Trajectory& b) {
  if (a.size() != b.size()) return 1e9;
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a.poses[i].stamp_ns != b.poses[i].stamp_ns) return 1e9;
    if (a.poses[i].T_world_body.has_value() != b.poses[i].T_world_body.has_value()) return 1e9;
    if (a.poses[i].T_world_body)
      most = std::max(most, (a.poses[i].T_world_body->matrix() - b.poses[i].T_world_body->matrix())
                                .cwiseAbs()
                                .maxCoeff());
  }
  return most;
}

Trajectory random_poses(Random& random, int count) {
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < count; ++i) poses.push_back(test::random_pose(random).isometry());
  return test::trajectory_of(poses);
}

using Times = std::vector<int>;

TEST(TrajectoryFilter, CropsBySecondsTimesAndFramesWithOpenEnds) {
  Trajectory drive = test::winding_drive(10);  // 0 to 0.9 s
  for (StampedPose& pose : drive.poses) pose.stamp_ns += 5'000'000'000;
  EXPECT_EQ(tenths(filtered(drive, "crop 0.2:0.4")), (Times{52, 53, 54}));
  EXPECT_EQ(tenths(filtered(drive, "crop 0.8:")), (Times{58, 59}));
  EXPECT_EQ(tenths(filtered(drive, "crop :0.1")), (Times{50, 51}));
  EXPECT_EQ(tenths(filtered(drive, "crop at 5.3:5.4")), (Times{53, 54}));
  EXPECT_EQ(tenths(filtered(drive, "crop 7f:8f")), (Times{57, 58}));
  const Trajectory frames = filtered(test::winding_drive(10, 1, false), "crop 4f:5f; crop 5f:");
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames.poses[0].stamp_ns, 5);
}

TEST(TrajectoryFilter, ChoosesFrames) {
  Trajectory drive = test::winding_drive(10);
  EXPECT_EQ(tenths(filtered(drive, "downsample 4")), (Times{0, 4, 8}));
  EXPECT_EQ(tenths(filtered(drive, "downsample to 4")), (Times{0, 3, 6, 9}));
  EXPECT_EQ(tenths(filtered(drive, "downsample to 1")), (Times{0}));
  EXPECT_EQ(tenths(filtered(drive, "downsample to 99")).size(), 10u);
  EXPECT_EQ(tenths(filtered(drive, "downsample 0.45s")), (Times{0, 5}));
  EXPECT_EQ(tenths(filtered(drive, "downsample 0.5m 0.45s")).size(), 10u);
  drive.poses[3].T_world_body = drive.poses[2].T_world_body;
  drive.poses[5].T_world_body.reset();
  EXPECT_EQ(tenths(filtered(drive, "distinct")), (Times{0, 1, 2, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(tenths(filtered(drive, "posed; distinct")), (Times{0, 1, 2, 4, 6, 7, 8, 9}));
}

TEST(TrajectoryFilter, InterpolatesAtARateAndAtTimesButNotAcrossGaps) {
  const TemporaryFolder folder;
  Trajectory drive = filtered(test::winding_drive(40), "crop :1; merge '" + [&] {
    const std::string path = folder / "later one.tum";
    write_trajectory(path, filtered(test::winding_drive(40), "crop 3:"), TrajectoryFormat::kTum);
    return path;
  }() + "'");
  ASSERT_EQ(drive.size(), 21u);
  const Trajectory at_20hz = filtered(drive, "interpolate 20hz");
  EXPECT_EQ(at_20hz.size(), 79u);  // 0 to 3.9 s
  EXPECT_EQ(at_20hz.posed(), 21u + 19u);
  EXPECT_EQ(filtered(drive, "interpolate 20hz gap 9").posed(), 79u);
  EXPECT_EQ(filtered(drive, "interpolate 20hz gap 0.09").posed(), 21u);
  const std::string times = folder.write("times.txt", "0.25\n2\n3.5\n9\n");
  const Trajectory at_times = filtered(drive, "interpolate " + times);
  ASSERT_EQ(at_times.size(), 4u);
  EXPECT_EQ(at_times.posed(), 2u);
  const std::string poses = folder.write("p.tum", "0.25 0 0 0 0 0 0 1\n3.5 0 0 0 0 0 0 1\n");
  EXPECT_LT(difference(filtered(drive, "interpolate " + poses), filtered(at_times, "posed")),
            1e-12);
  EXPECT_EQ(tenths(filtered(drive, "sync " + poses + " 0.06")), (Times{2, 35}));
  EXPECT_EQ(tenths(filtered(drive, "sync " + poses)), (Times{35}));
}

TEST(TrajectoryFilter, EveryStepWithAnInverseIsUndoneByIt) {
  Random random(3);
  const std::vector<std::pair<std::string, std::string>> pairs = {
      {"invert", "invert"},
      {"reverse", "reverse"},
      {"offset 1.5", "offset -1.5"},
      {"scale 4", "scale 0.25"},
      {"quaternion wxyz", "quaternion xyzw"},
      {"axes both camera:flu", "axes both flu:camera"},
      {"axes body opengl:camera", "axes body camera:opengl"},
      {"axes world enu:ned", "axes world ned:enu"},
      {"transform 1 2 3 0.5 -0.5 0.5 0.5", "transform 1 2 3 0.5 -0.5 0.5 0.5 inverse"},
      {"transform right 1 2 3 0 0 1 0", "transform right 1 2 3 0 0 1 0 inverse"},
      {"transform propagate 1 2 3 0 0.6 0 0.8", "transform propagate 1 2 3 0 0.6 0 0.8 inverse"}};
  for (int world = 0; world < 20; ++world)
    for (const auto& [step, back] : pairs) {
      SCOPED_TRACE(step + ", world " + std::to_string(world) + " of seed 3");
      const Trajectory poses = random_poses(random, 8);
      EXPECT_GT(difference(filtered(poses, step), poses), 1e-3);
      EXPECT_LT(difference(filtered(poses, step + ";" + back), poses), 1e-9);
    }
}

TEST(TrajectoryFilter, AChainIsItsStepsOneAfterTheOther) {
  Random random(4);
  const std::vector<std::string> steps = {"crop 0.1:0.8", "invert", "downsample 2", "scale 2",
                                          "origin", "transform 1 0 0 0 0 1 0", "axes both frd:flu"};
  const Trajectory poses = random_poses(random, 10);
  for (const std::string& a : steps)
    for (const std::string& b : steps) {
      SCOPED_TRACE(a + "; " + b);
      EXPECT_EQ(difference(filtered(poses, a + " ;\t" + b + ";"), filtered(filtered(poses, a), b)),
                0);
    }
  EXPECT_TRUE(TrajectoryFilter(" ; ").empty());
  EXPECT_EQ(difference(filtered(poses, ""), poses), 0);
}

TEST(TrajectoryFilter, TransformsReadAllFormsOfTheirFiles) {
  const TemporaryFolder folder;
  const Trajectory drive = test::winding_drive(5);
  // A quarter of a turn about z, and (1, 2, 3).
  const double h = std::numbers::sqrt2 / 2;
  const std::string expected = fmt::format("transform 1 2 3 0 0 {:.17g} {:.17g}", h, h);
  for (const std::string& path :
       {folder.write("7", fmt::format("1 2 3 0 0 {:.17g} {:.17g}\n", h, h)),
        folder.write("8", fmt::format("# tum\n99 1 2 3 0 0 {:.17g} {:.17g}\n", h, h)),
        folder.write("12", "0 -1 0 1 1 0 0 2 0 0 1 3\n"),
        folder.write("16", "0, -1, 0, 1\n1, 0, 0, 2\n0, 0, 1, 3\n0, 0, 0, 1\n"),
        folder.write("json", fmt::format("{{\"x\":1,\"y\":2,\"z\":3,\"qx\":0,\"qy\":0,"
                                         "\"qz\":{:.17g},\"qw\":{:.17g}}}",
                                         h, h))}) {
    SCOPED_TRACE(path);
    EXPECT_LT(difference(filtered(drive, "transform " + path), filtered(drive, expected)), 1e-12);
  }
  const Eigen::Vector3d moved =
      filtered(drive, expected).poses[0].T_world_body->translation();  // of the origin
  EXPECT_LT((moved - Eigen::Vector3d(1, 2, 3)).norm(), 1e-12);
}

TEST(TrajectoryFilter, AxesOfACameraThatLooksNorthInEnu) {
  // z of the camera looks to the north (y), x to the east, y down: R_enu_cam by hand.
  Trajectory one = test::trajectory_of({test::isometry({-std::numbers::pi / 2, 0, 0}, {1, 2, 3})});
  const Eigen::Isometry3d T = *filtered(one, "axes body camera:flu").poses[0].T_world_body;
  // Then x looks to the north, y to the west, z up.
  Eigen::Matrix3d R_enu_flu;
  R_enu_flu << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_LT((T.linear() - R_enu_flu).norm(), 1e-12);
  EXPECT_EQ(T.translation(), Eigen::Vector3d(1, 2, 3));
  const Eigen::Vector3d ned =
      filtered(one, "axes world enu:ned").poses[0].T_world_body->translation();
  EXPECT_EQ(ned, Eigen::Vector3d(2, 1, -3));
}

TEST(TrajectoryFilter, PositionsAloneKeepNoOrientation) {
  Trajectory positions = test::winding_drive(5);
  for (StampedPose& pose : positions.poses) pose.T_world_body->linear().setIdentity();
  positions.has_orientation = false;
  const Trajectory moved = filtered(positions, "transform 0 0 0 0 0 1 0; scale 2");
  EXPECT_EQ(moved.poses[3].T_world_body->linear(), Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  EXPECT_FALSE(moved.has_orientation);
  for (const char* step : {"invert", "downsample 3deg", "quaternion wxyz", "axes body flu:frd",
                           "transform right 0 0 0 0 0 1 0"})
    EXPECT_THAT(message_of<ArgumentError>([&] { filtered(positions, step); }),
                HasSubstr("positions alone"))
        << step;
}

TEST(TrajectoryFilter, NamesTheStepAndItsNumber) {
  const TemporaryFolder folder;
  const std::string bad = folder.write("bad.txt", "1 2\n");
  for (const auto& [chain, message] : std::vector<std::pair<std::string, std::string>>{
           {"invert; cut 1:2", "step 2 (cut 1:2): 'cut' is none of crop, "},
           {"crop 2:1", "step 1 (crop 2:1): '2:1' ends before it begins"},
           {"crop :", "both ends of the interval are left out"},
           {"crop 3", "'3' is no interval A:B"},
           {"crop 1f:2", "'2' is no number of a frame"},
           {"crop a:b", "'a' is no time in seconds"},
           {"invert now", "'now' is one word too many"},
           {"scale", "the factor is missing"},
           {"scale -1", "the factor is not positive"},
           {"scale x", "the factor: 'x' is not a number"},
           {"downsample 0", "'0' is not a positive number"},
           {"downsample 5km", "'5km' is no distance with its unit"},
           {"interpolate 0hz", "not positive"},
           {"interpolate none.txt", "step 1 (interpolate none.txt): none.txt: "},
           {"project zz", "'zz' is none of xy, xz, yz"},
           {"axes body camera:left", "'left' is none of camera"},
           {"axes flu:frd", "'flu:frd' is none of body, world, both"},
           {"transform " + bad, "bad.txt: 2 numbers are no transform"},
           {"transform 2 0 0 0 0 0 0 2", "length 2, not 1"},
           {"transform 'T", "a quotation mark ' is not closed"},
           {"quaternion zxyw", "neither wxyz nor xyzw"}})
    EXPECT_THAT(message_of<ArgumentError>([&] { TrajectoryFilter{chain}; }), HasSubstr(message))
        << chain;
  const Trajectory frames = test::winding_drive(5, 1, false);
  for (const char* chain : {"invert; crop 1:2", "invert; interpolate 10hz", "invert; offset 1",
                            "invert; downsample 1s"})
    EXPECT_THAT(message_of<ArgumentError>([&] { filtered(frames, chain); }),
                testing::AllOf(HasSubstr("step 2 ("), HasSubstr("has no times")))
        << chain;
  EXPECT_THAT(message_of<NoResult>([&] { filtered(test::winding_drive(5), "crop 7:8"); }),
              HasSubstr("step 1 (crop 7:8): leaves no pose of 5 frames"));
}

TEST(TrajectoryFilter, HasAFormAndALineForEveryStep) {
  EXPECT_EQ(filter_step_forms().size(), 16u);
  for (const FilterStepForm& step : filter_step_forms()) {
    EXPECT_FALSE(step.form.empty());
    EXPECT_FALSE(step.text.empty()) << step.form;
  }
}

TEST(TrajectoryFilter, IsDocumentedStepByStep) {
  const std::string page = test::read_file(test::source_dir() + "/docs/datasets.md");
  for (const FilterStepForm& step : filter_step_forms())
    EXPECT_NE(page.find("| `" + step.form + "` | " + step.text + " |\n"), page.npos) << step.form;
}

}  // namespace trajectory_filter_test
}  // namespace placegraph
