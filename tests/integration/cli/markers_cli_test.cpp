// `placegraph markers`, and the simulated tags of the research data.
#include <placegraph/frontend/markers/marker_pose.h>
#include <placegraph/graph/core/angle.h>

#include <nlohmann/json.hpp>

#include "tests/support/cli_test.h"
#include "tests/support/data.h"
#include "tests/support/pictures.h"
#include "tests/support/scenes/apriltag_sim.h"
#include "tests/support/scenes/marker_scene.h"
#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace markers_cli_test {

using namespace test;
using ::testing::HasSubstr;

class MarkersCli : public CliTest {
 protected:
  void SetUp() override {
    Random random = seeded_random(3);
    scene.camera = MarkerScene::usual_camera();
    scene.layout.markers = {{5, 0.2, SE3(SO3(), {-0.15, 0, 0})}, {9, 0.1, SE3(SO3(), {0.1, 0, 0})}};
    test::write_picture(dir / "two.png", scene.render(pose, random));
    test::write_picture(dir / "plain.png", Image(480, 640, CV_8UC1, cv::Scalar(128)));
    dir.write("K.txt", "460 460 322.3 237.1 640 480\n");
    dir.write("markers.yaml",
              "dictionary: apriltag_36h11\n"
              "markers:\n"
              "  - {id: 5, side_m: 0.2, position: [-0.15, 0, 0], quaternion: [1, 0, 0, 0]}\n"
              "  - {id: 9, side_m: 0.1, position: [0.1, 0, 0], quaternion: [1, 0, 0, 0]}\n");
  }
  MarkerScene scene;
  const SE3 pose = looking_at_origin(0.9, 0.4, 0.2, 0.1);
};

TEST_F(MarkersCli, WritesIdsCornersAndBothPoses) {
  const CommandResult result =
      run("image markers two.png --calib K.txt --side 0.2 --out m.json --draw m.png");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("2 markers of apriltag_36h11"));
  const auto json = nlohmann::json::parse(read_file(dir / "m.json"));
  ASSERT_EQ(json["markers"].size(), 2u);
  const auto& marker = json["markers"][0];
  EXPECT_EQ(marker["id"], 5);
  EXPECT_GE(marker["poses"].size(), 1u);
  EXPECT_EQ(marker["poses"][0]["covariance"].size(), 6u);
  const PlacedMarker& placed = scene.layout.markers[0];
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector2d truth =
        *scene.camera.project(pose.inverse() * placed.T_world_marker * placed.corners_marker()[k]);
    EXPECT_NEAR(marker["corners_px"][k][0], truth.x(), 0.1);
    EXPECT_NEAR(marker["corners_px"][k][1], truth.y(), 0.1);
  }
  EXPECT_EQ(test::read_picture(dir / "m.png").cols, 640);
}

TEST_F(MarkersCli, FindsTheCameraInALayout) {
  const CommandResult result =
      run("image markers two.png --calib K.txt --layout markers.yaml --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  ASSERT_FALSE(json["T_world_cam"].is_null());
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(json["T_world_cam"][i][3], pose.translation()[i], 0.01);
}

TEST_F(MarkersCli, CountsPixelsFromTheCornerWhereAsked) {
  dir.write("corner.txt", "460 460 322.8 237.6 640 480\n");
  const auto centre =
      nlohmann::json::parse(run("image markers two.png --calib K.txt --side 0.2 --json").out);
  const auto corner = nlohmann::json::parse(
      run("image markers two.png --calib corner.txt --side 0.2 --pixel-origin corner --json").out);
  const double a = centre["markers"][0]["corners_px"][0][0];
  const double b = corner["markers"][0]["corners_px"][0][0];
  EXPECT_NEAR(b - a, 0.5, 1e-9);
  const double x = centre["markers"][0]["poses"][0]["T_cam_marker"][0][3];
  EXPECT_NEAR(corner["markers"][0]["poses"][0]["T_cam_marker"][0][3], x, 1e-9);
}

TEST_F(MarkersCli, SaysWhatIsWrong) {
  expect_failure("image markers plain.png --calib K.txt", 1, "no marker of apriltag_36h11");
  expect_usage_error("image markers two.png --calib K.txt --dictionary aruco_9x9",
                     "no marker dictionary 'aruco_9x9' (known: aruco_4x4_50,");
  expect_usage_error("image markers two.png", "--calib is required");
  EXPECT_EQ(run("image markers two.png --camera K.txt").code, 0);  // its former name
  expect_usage_error("image markers none.png --calib K.txt", "none.png");
  expect_usage_error("image markers two.png --calib none.txt", "none.txt");
  expect_usage_error("image markers two.png --calib K.txt --side -1", "side");
  expect_usage_error("image markers two.png --calib K.txt --side nan", "side");
  dir.write("small.txt", "460 460 160 120 320 240\n");
  expect_usage_error("image markers two.png --calib small.txt", "640x480");
  dir.write("kept.json", "{}");
  expect_usage_error("image markers two.png --calib K.txt --out kept.json", "kept.json");
}

/// The file's corners are a detector's, too: they and its poses differ by up to a third of a pixel.
TEST(SimulatedTags, CornersAndPosesAreThoseOfTheFile) {
  PLACEGRAPH_DATA_OR_SKIP(folder, "scene/apriltag_sim");
  const test::SimulatedTags truth = read_apriltag_sim(folder);
  const auto found = MarkerDetector({}, "apriltag_36h11").detect(truth.image);
  ASSERT_EQ(found.size(), 5u);
  for (const MarkerObservation& observation : found) {
    SCOPED_TRACE(observation.id);
    const SimulatedTag& tag = truth.tags.at(observation.id);
    EXPECT_LT(worst_corner_px(observation.corners_px, tag.corners_px), 0.3);
    const MarkerPoses poses = estimate_marker_poses(observation, tag.side_m, truth.camera);
    ASSERT_TRUE(poses.outcome);
    const SE3& T = poses.poses[0].T_cam_marker;
    EXPECT_LT(distance_m(T, tag.T_cam_marker), 0.01 * tag.T_cam_marker.translation().norm());
    EXPECT_LT(angle_rad(T, tag.T_cam_marker), deg_to_rad(0.5));
    EXPECT_GT(poses.margin(), 100);
  }
}

}  // namespace markers_cli_test
}  // namespace placegraph
