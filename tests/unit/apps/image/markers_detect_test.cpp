#include "apps/image/markers_detect.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/support/output.h"
#include "tests/support/message_of.h"
#include "tests/support/scenes/marker_scene.h"
#include "tests/support/seed.h"
#include "tests/unit/io/datasets/tiny_images.h"

namespace placegraph::apps {
namespace markers_detect_test {

using test::message_of;
using testing::HasSubstr;

/// Two markers on a table, of which the layout knows both.
class MarkersDetectCommand : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new test::TemporaryFolder;
    Random random = test::seeded_random(3);
    test::write_image(*folder, "two.png", scene().render(T_world_cam(), random));
    folder->write("K.txt", "460 460 322.3 237.1 640 480\n");
    folder->write("layout.yaml",
                  "dictionary: apriltag_36h11\n"
                  "markers:\n"
                  "  - {id: 5, side_m: 0.2, position: [-0.15, 0, 0], quaternion: [1, 0, 0, 0]}\n"
                  "  - {id: 9, side_m: 0.1, position: [0.1, 0, 0], quaternion: [1, 0, 0, 0]}\n");
  }
  static void TearDownTestSuite() { delete folder; }
  static test::MarkerScene scene() {
    test::MarkerScene scene;
    scene.camera = test::MarkerScene::usual_camera();
    scene.layout.markers = {{5, 0.2, SE3(SO3(), {-0.15, 0, 0})}, {9, 0.1, SE3(SO3(), {0.1, 0, 0})}};
    return scene;
  }
  static SE3 T_world_cam() { return test::looking_at_origin(0.9, 0.4, 0.2, 0.1); }
  MarkersDetectCommand() {
    arguments.image = *folder / "two.png";
    arguments.calib = *folder / "K.txt";
  }
  static test::TemporaryFolder* folder;
  MarkersDetectArguments arguments;
};
test::TemporaryFolder* MarkersDetectCommand::folder = nullptr;

TEST_F(MarkersDetectCommand, FindsTheCornersAndThePoseOfAMarkerOfKnownSide) {
  arguments.side_m = 0.2;
  const MarkersDetectResult result = markers_detect(arguments);
  ASSERT_EQ(result.markers.size(), 2u);
  const DetectedMarker& marker = result.markers[0];
  const PlacedMarker placed = scene().layout.markers[0];
  EXPECT_EQ(marker.observation.id, 5);
  EXPECT_EQ(marker.side_m, 0.2);
  const SE3 T_cam_marker = T_world_cam().inverse() * placed.T_world_marker;
  for (int k = 0; k < 4; ++k) {
    const auto truth = *scene().camera.project(T_cam_marker * placed.corners_marker()[k]);
    EXPECT_LT((marker.observation.corners_px[k] - truth).norm(), 0.15);
  }
  ASSERT_TRUE(marker.poses.outcome);
  // A tenth of a pixel of the 100 that the side has, at 0.9 m.
  EXPECT_LT((marker.poses.poses[0].T_cam_marker.translation() - T_cam_marker.translation()).norm(),
            0.005);
  EXPECT_FALSE(result.camera);
  EXPECT_THAT(to_text(result), HasSubstr("two.png: 2 markers of apriltag_36h11\n     5  ("));
}

TEST_F(MarkersDetectCommand, TellsNoPosesWhereTheSideIsNotKnown) {
  const MarkersDetectResult result = markers_detect(arguments);
  ASSERT_EQ(result.markers.size(), 2u);
  EXPECT_TRUE(result.markers[0].poses.poses.empty());
  EXPECT_TRUE(nlohmann::json::parse(to_json(result))["markers"][0]["side_m"].is_null());
}

TEST_F(MarkersDetectCommand, TakesTheSidesOfTheLayoutAndFindsTheCameraInIt) {
  arguments.layout = *folder / "layout.yaml";
  arguments.out = *folder / "m.json";
  arguments.drawing = *folder / "m.png";
  const MarkersDetectResult result = markers_detect(arguments);
  ASSERT_EQ(result.markers.size(), 2u);
  EXPECT_EQ(result.markers[0].side_m, 0.2);
  EXPECT_EQ(result.markers[1].side_m, 0.1);
  ASSERT_TRUE(result.camera && result.camera->outcome);
  EXPECT_LT((result.camera->T_world_cam.translation() - T_world_cam().translation()).norm(), 0.01);
  EXPECT_EQ(test::read_file(arguments.out), to_json(result));
  EXPECT_NEAR(nlohmann::json::parse(to_json(result))["T_world_cam"][2][3].get<double>(),
              T_world_cam().translation().z(), 0.01);
  EXPECT_TRUE(std::filesystem::exists(arguments.drawing));
}

TEST_F(MarkersDetectCommand, CountsPixelsFromTheCornerWhereAsked) {
  arguments.side_m = 0.2;
  const MarkersDetectResult centre = markers_detect(arguments);
  arguments.calib = folder->write("corner.txt", "460 460 322.8 237.6 640 480\n");
  arguments.origin = "corner";
  const MarkersDetectResult corner = markers_detect(arguments);
  const auto px = [](const MarkersDetectResult& result) {
    return nlohmann::json::parse(to_json(result))["markers"][0]["corners_px"][0][0].get<double>();
  };
  EXPECT_NEAR(px(corner) - px(centre), 0.5, 1e-9);
  const auto at = [](const MarkersDetectResult& result) {
    return result.markers[0].poses.poses[0].T_cam_marker.translation();
  };
  EXPECT_LT((at(corner) - at(centre)).norm(), 1e-9);
}

TEST_F(MarkersDetectCommand, WritesNothingOfAnImageWithoutMarkers) {
  arguments.image =
      test::write_image(*folder, "plain.png", Image(480, 640, CV_8UC1, cv::Scalar(128)));
  arguments.out = *folder / "none.json";
  EXPECT_EQ(message_of<NoResult>([&] { markers_detect(arguments); }),
            arguments.image + ": no marker of apriltag_36h11");
  EXPECT_FALSE(std::filesystem::exists(arguments.out));
}

TEST_F(MarkersDetectCommand, NamesWhatItCannotUse) {
  arguments.calib = folder->write("small.txt", "460 460 160 120 320 240\n");
  EXPECT_THAT(message_of([&] { markers_detect(arguments); }), HasSubstr("two.png: "));
  arguments.origin = "middle";
  EXPECT_EQ(message_of<ArgumentError>([&] { markers_detect(arguments); }),
            "--pixel-origin: 'middle' is none of centre, corner");
  arguments.side_m = NAN;
  EXPECT_EQ(message_of<ArgumentError>([&] { markers_detect(arguments); }),
            "--side: must be a finite number");
}

}  // namespace markers_detect_test
}  // namespace placegraph::apps
