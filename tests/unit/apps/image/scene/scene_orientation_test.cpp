#include "apps/image/scene/scene_orientation.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/synthetic/writers/sequence_writer.h>

#include <nlohmann/json.hpp>

#include "apps/support/output.h"
#include "tests/support/clean_world.h"
#include "tests/support/message_of.h"
#include "tests/support/scenes/street_files.h"

namespace placegraph::apps {
namespace scene_orientation_test {

using test::message_of;
using testing::HasSubstr;

/// A walk through a rendered corridor, made once: three images with their surfaces, and the camera
/// in a file of its own.
class SceneOrientationCommand : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    made = new test::TemporaryFolder;
    const SyntheticOptions options = test::clean_world("corridor-loop", 3, 320, 240);
    const SyntheticWorld world(options);
    SequenceWriterOptions writing;
    writing.contents.planes = true;
    write_sequence(world, *made / "walk", writing);
    const Camera c = world.calibration().camera;
    std::ostringstream line;
    line << c.fx << " " << c.fy << " " << c.cx << " " << c.cy << " 320 240\n";
    made->write("K.txt", line.str());
  }
  static void TearDownTestSuite() { delete made; }
  SceneOrientationCommand() {
    arguments.in = *made / "walk/image_0/000000.png";
    arguments.camera = *made / "K.txt";
  }
  static test::TemporaryFolder* made;
  test::TemporaryFolder folder;
  SceneOrientationArguments arguments;
};
test::TemporaryFolder* SceneOrientationCommand::made = nullptr;

TEST_F(SceneOrientationCommand, TellsTheFloorAndTheWallsOfAnImage) {
  arguments.out = folder / "map.png";
  arguments.ids = true;
  arguments.drawing = folder / "drawn.png";
  const SceneOrientationResult result = scene_orientation(arguments);
  const auto& found = std::get<ImageOrientation>(result.found);
  EXPECT_GT(found.coverage, 0.4);
  EXPECT_GT(found.floor, 0.05);
  EXPECT_GT(found.wall, 0.2);
  EXPECT_LE(found.floor + found.ceiling + found.wall, found.coverage + 1e-9);
  // The camera is held level: the vertical axis is its own y, to some degrees.
  EXPECT_GT(std::abs(found.R_cam_manhattan(1, found.vertical_axis)), 0.99);
  const Image map = read_image_as_stored(arguments.out);
  EXPECT_EQ(map.size(), cv::Size(320, 240));
  EXPECT_NEAR(cv::countNonZero(map) / static_cast<double>(map.total()), found.coverage, 1e-6);
  const Image drawn = read_image_as_stored(arguments.drawing);
  EXPECT_EQ(drawn.type(), CV_8UC3);
  EXPECT_GT(drawn.rows, 240);  // the legend is below
  arguments.ids = false;
  arguments.force = true;
  scene_orientation(arguments);
  EXPECT_EQ(read_image_as_stored(arguments.out).type(), CV_8UC3);
}

TEST_F(SceneOrientationCommand, HoldsASequenceAgainstItsSurfaces) {
  arguments.in = *made / "walk";
  arguments.camera.clear();
  arguments.every = 2;
  arguments.out = folder / "maps";
  const SceneOrientationResult result = scene_orientation(arguments);
  const auto& found = std::get<SequenceOrientation>(result.found);
  EXPECT_EQ(found.images, 2);
  EXPECT_EQ(found.labelled, 2);
  EXPECT_FALSE(result.no_result);
  ASSERT_TRUE(found.check);
  EXPECT_GT(found.check->judged, 100'000u);  // of 2 x 76800 pixels
  EXPECT_NEAR(found.check->coverage(), found.coverage, 0.05);
  EXPECT_GT(found.check->accuracy(), 0.8);
  EXPECT_TRUE(std::filesystem::exists(folder / "maps/000002.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "maps/000001.png"));
}

TEST_F(SceneOrientationCommand, SaysWhyThereIsNoOrientation) {
  arguments.in = test::write_image(folder, "blank.png", Image(240, 320, CV_8UC1, cv::Scalar(90)));
  arguments.out = folder / "map.png";
  EXPECT_THAT(message_of<NoResult>([&] { scene_orientation(arguments); }),
              HasSubstr("blank.png: "));
  EXPECT_FALSE(std::filesystem::exists(arguments.out));

  test::StreetFiles(folder, 2).write_kitti(false);
  for (int i = 0; i < 2; ++i)
    test::write_image(
        folder, "s/image_0/" + test::StreetFiles::name(i),
        Image(test::street_camera().height, test::street_camera().width, CV_8UC1, cv::Scalar(90)));
  arguments.in = folder / "s";
  arguments.camera.clear();
  arguments.out.clear();
  const SceneOrientationResult result = scene_orientation(arguments);
  EXPECT_EQ(std::get<SequenceOrientation>(result.found).labelled, 0);
  EXPECT_FALSE(std::get<SequenceOrientation>(result.found).check);
  EXPECT_EQ(result.no_result, arguments.in + ": no image shows a Manhattan frame");
}

TEST_F(SceneOrientationCommand, NamesWhatIsMissingOrDoesNotFit) {
  arguments.camera.clear();
  EXPECT_THAT(message_of<ArgumentError>([&] { scene_orientation(arguments); }),
              HasSubstr("--calib: an image needs its camera"));
  arguments.camera = folder.write("K.txt", "300 300 160 120 321 240\n");
  EXPECT_THAT(message_of([&] { scene_orientation(arguments); }), HasSubstr("000000.png"));
  arguments.every = 0;
  EXPECT_THAT(message_of<ArgumentError>([&] { scene_orientation(arguments); }),
              HasSubstr("--every: must be at least 1"));
}

TEST(SceneOrientationText, SaysWhatOneImageAndWhatASequenceShows) {
  ImageOrientation image{0.8, 0.2, 0.1, 0.5, 1, Eigen::Matrix3d::Identity()};
  image.R_cam_manhattan(0, 2) = 0.25;
  const SceneOrientationResult one{"a.png", image, 31.6, {}};
  EXPECT_EQ(to_text(one), "a.png: 80 % labelled: floor 20, ceiling 10, walls 50 %; 32 ms CPU\n");
  const auto json = nlohmann::json::parse(to_json(one));
  EXPECT_EQ(json["wall"], 0.5);
  EXPECT_EQ(json["R_cam_manhattan"][0], (std::vector<double>{1, 0, 0.25}));
  EXPECT_FALSE(json.contains("check"));

  SequenceOrientation sequence{4, 3, 0.75, OrientationCheck{200, 100, 90}};
  EXPECT_EQ(to_text({"walk", sequence, 20, {}}),
            "walk: 3 of 4 images labelled, 75.0 % of their pixels, 90.0 % of those correctly; 20 "
            "ms CPU an "
            "image\n");
  EXPECT_EQ(nlohmann::json::parse(to_json({"walk", sequence, 20, {}}))["check"],
            nlohmann::json({{"pixels", 200}, {"coverage", 0.5}, {"accuracy", 0.9}}));
  sequence.check.reset();
  EXPECT_EQ(to_text({"walk", sequence, 20, {}}),
            "walk: 3 of 4 images labelled, 75.0 % of their pixels; 20 ms CPU an image\n");
}

}  // namespace scene_orientation_test
}  // namespace placegraph::apps
