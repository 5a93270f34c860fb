#include "apps/image/scene/scene_popup.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/scene/scene_model.h>
#include <placegraph/io/files/image_file.h>

#include <nlohmann/json.hpp>

#include "tests/support/message_of.h"
#include "tests/unit/io/datasets/tiny_images.h"

namespace placegraph::apps {
namespace scene_popup_test {

using test::message_of;
using testing::HasSubstr;

/// 100 x 80 pixels of a level camera 2 m above the ground, the horizon in row 39.5: ground below,
/// sky above, and a wall whose foot is in row 55, 10 m away.
class ScenePopupCommand : public testing::Test {
 protected:
  ScenePopupCommand() {
    Image surfaces(80, 100, CV_8UC1, cv::Scalar(static_cast<int>(Surface::kSky)));
    surfaces.rowRange(40, 80).setTo(static_cast<int>(Surface::kGround));
    surfaces(cv::Rect(30, 20, 40, 36)).setTo(static_cast<int>(Surface::kVertical));
    arguments.surfaces = test::write_image(folder, "surfaces.png", surfaces);
    arguments.image =
        test::write_image(folder, "street.png", Image(80, 100, CV_8UC3, cv::Scalar(10, 20, 30)));
    arguments.calib = folder.write("K.txt", "80 80 49.5 39.5 100 80\n");
    arguments.out = folder / "street.ply";
    arguments.height_m = 2;
    arguments.level = true;
  }
  test::TemporaryFolder folder;
  ScenePopupArguments arguments;
};

TEST_F(ScenePopupCommand, MakesAMeshOfAllThatHasAPlace) {
  const ScenePopupResult result = scene_popup(arguments);
  EXPECT_NEAR(result.horizon_row, 39.5, 1e-9);
  EXPECT_EQ(result.down, Eigen::Vector3d::UnitY());
  EXPECT_FALSE(result.box);
  // 40 rows of ground and the part of the wall above the horizon.
  const std::string mesh = test::read_file(arguments.out);
  EXPECT_THAT(mesh, HasSubstr("element vertex " + std::to_string(40 * 100 + 20 * 40) + "\n"));
  // The first vertex is the wall's corner in row 20: 10 m away, 2.4 m above the camera; its colour
  // is red, green, blue.
  const std::size_t begin = mesh.find("end_header\n") + 11;
  float place[3];
  std::memcpy(place, mesh.data() + begin, sizeof place);
  const double distance_m = 2 * 80 / 16.0;
  EXPECT_NEAR(place[0], distance_m * (30 - 49.5) / 80, 0.15);
  EXPECT_NEAR(place[1], distance_m * (20 - 39.5) / 80, 0.15);
  EXPECT_NEAR(place[2], distance_m, 0.5);
  EXPECT_EQ(mesh.substr(begin + 12, 3), (std::string{30, 20, 10}));
}

TEST_F(ScenePopupCommand, PutsABoxBeforeOrBehindTheWall) {
  arguments.box = {0, 6, 1, 0.2, 3};
  arguments.draw = folder / "drawn.png";
  arguments.mask = folder / "mask.png";
  const ScenePopupResult before = scene_popup(arguments);
  ASSERT_TRUE(before.box);
  EXPECT_NEAR(before.box->foot_px.x(), 49.5, 1e-9);
  EXPECT_NEAR(before.box->foot_px.y(), 39.5 + 80 * 2 / 6.0, 1e-9);
  EXPECT_GT(before.box->seen_px, 0);
  EXPECT_EQ(before.box->hidden_px, 0);
  EXPECT_EQ(cv::countNonZero(read_image_as_stored(arguments.mask) == 255), before.box->seen_px);
  EXPECT_FALSE(test::same_pixels(read_image_as_stored(arguments.draw),
                                 read_image_as_stored(arguments.image)));

  arguments.box = {0, 20, 1, 0.2, 3};
  arguments.force = true;
  const ScenePopupResult behind = scene_popup(arguments);
  EXPECT_EQ(behind.box->seen_px, 0);
  EXPECT_GT(behind.box->hidden_px, 0);
}

TEST_F(ScenePopupCommand, SupposesAUsualLensWhereNoneIsKnown) {
  arguments.calib.clear();
  arguments.box = {1, 6, 1, 0.2, 3};
  arguments.draw = folder / "drawn.png";
  const ScenePopupResult result = scene_popup(arguments);  // 0.9 widths, looking through the middle
  EXPECT_NEAR(result.box->foot_px.x(), 49.5 + 90 / 6.0, 1e-9);
  EXPECT_NEAR(result.box->foot_px.y(), 39.5 + 90 * 2 / 6.0, 1e-9);
}

TEST_F(ScenePopupCommand, APictureWithoutEdgesSaysNothingOfTheHorizon) {
  arguments.level = false;
  const ScenePopupResult result = scene_popup(arguments);
  EXPECT_FALSE(result.horizon_from_lines);
  EXPECT_NEAR(result.horizon_row, 39.5, 1e-6);
  EXPECT_THAT(to_text(result), HasSubstr("column (level camera assumed), written to "));
}

TEST_F(ScenePopupCommand, NamesWhatDoesNotFit) {
  arguments.draw = folder / "drawn.png";
  EXPECT_THAT(message_of<ArgumentError>([&] { scene_popup(arguments); }),
              HasSubstr("--box: needs --draw, and --draw needs --box"));
  arguments.draw.clear();
  arguments.surfaces = test::write_image(folder, "small.png", Image(8, 8, CV_8UC1, cv::Scalar(0)));
  EXPECT_THAT(message_of([&] { scene_popup(arguments); }), HasSubstr("small.png"));
  arguments.surfaces = arguments.image;
  EXPECT_THAT(message_of([&] { scene_popup(arguments); }),
              HasSubstr("street.png: no label image: one channel of 8 bits is needed"));
  arguments.calib = folder.write("K.txt", "80 80 49.5 39.5 100 81\n");
  EXPECT_THAT(message_of([&] { scene_popup(arguments); }), HasSubstr("street.png"));
  EXPECT_FALSE(std::filesystem::exists(arguments.out));
}

TEST(ScenePopupText, IsOneLine) {
  ScenePopupResult result{"street.png", "street.ply", {0, 0.6, 0.8},
                          true,         12.34,        PlacedBox{{3, 4}, 50, 6}};
  EXPECT_EQ(to_text(result),
            "street.png: horizon at row 12.3 of the middle column, written to street.ply\n");
  const auto json = nlohmann::json::parse(to_json(result));
  EXPECT_EQ(json["down"], (std::vector<double>{0, 0.6, 0.8}));
  EXPECT_EQ(json["foot_px"], (std::vector<double>{3, 4}));
  EXPECT_EQ(json["seen_px"], 50);
  EXPECT_EQ(json["hidden_px"], 6);
  result.box.reset();
  EXPECT_FALSE(nlohmann::json::parse(to_json(result)).contains("foot_px"));
}

}  // namespace scene_popup_test
}  // namespace placegraph::apps
