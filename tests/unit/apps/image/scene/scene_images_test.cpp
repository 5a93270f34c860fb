#include "apps/image/scene/scene_images.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/scene/street_map.h>
#include <placegraph/io/files/image_file.h>

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "tests/support/message_of.h"
#include "tests/unit/io/datasets/tiny_images.h"

namespace placegraph::apps {
namespace scene_images_test {

namespace fs = std::filesystem;
using test::message_of;
using testing::HasSubstr;

/// The left half is of the first class, of the right half a quarter unknown and the rest of the
/// second; all a fifth certain. As label_scene(), it takes no picture below 32 x 32 pixels.
SceneLabels by_columns(std::size_t, const Image& picture) {
  require(picture.rows >= 32 && picture.cols >= 32, "too few pixels");
  SceneLabels found{Image(picture.rows, picture.cols, CV_8UC1, cv::Scalar(0)),
                    Image(picture.rows, picture.cols, CV_32FC1, cv::Scalar(0.2))};
  found.labels.colRange(picture.cols / 2, picture.cols).setTo(1);
  found.labels.colRange(picture.cols * 7 / 8, picture.cols).setTo(2);
  return found;
}

class LabelPictures : public testing::Test {
 protected:
  LabelPictures() {
    test::write_image(folder, "street/images/a.png", test::tiny_grey(64, 48, 1));
    test::write_image(folder, "street/images/b.png", test::tiny_grey(64, 48, 2));
    arguments.input = folder / "street";
    arguments.out = folder / "out";
  }
  SceneImageResult label() { return label_images(arguments, {"Sky", "Road"}, by_columns); }
  test::TemporaryFolder folder;
  SceneImageArguments arguments;
};

TEST_F(LabelPictures, CountsThePixelsOfEveryClassOverAllPictures) {
  const SceneImageResult result = label();
  EXPECT_EQ(result.images, 2u);
  EXPECT_EQ(result.pixels, (std::vector<std::int64_t>{2 * 32 * 48, 2 * 24 * 48, 2 * 8 * 48}));
  const auto json = nlohmann::json::parse(to_json(result));
  EXPECT_EQ(json["shares"], nlohmann::json({{"Sky", 0.5}, {"Road", 0.375}, {"unknown", 0.125}}));
  arguments.out = folder / "again";
  arguments.threads = 2;
  EXPECT_EQ(label().pixels, result.pixels);
}

TEST_F(LabelPictures, DrawsTheClassesWithALegend) {
  label();
  const Image drawn = read_image_as_stored(folder / "out/b.png");
  ASSERT_EQ(drawn.type(), CV_8UC3);
  EXPECT_GT(drawn.rows, 48);
  const Image picture = test::tiny_grey(64, 48, 2);
  const auto sky = class_colour("Sky", 0);
  EXPECT_NEAR(drawn.at<cv::Vec3b>(10, 3)[2], 0.6 * sky[0] + 0.4 * picture.at<std::uint8_t>(10, 3),
              1.5);
  // What is unknown is the picture.
  EXPECT_EQ(drawn.at<cv::Vec3b>(10, 63)[1], picture.at<std::uint8_t>(10, 63));
  EXPECT_FALSE(fs::exists(folder / "out/b.drawn.png"));
}

TEST_F(LabelPictures, WritesTheNumbersAndWhatElseIsAskedFor) {
  arguments.ids = true;
  label();
  const Image labels = read_image_as_stored(folder / "out/b.png");
  ASSERT_EQ(labels.type(), CV_8UC1);
  EXPECT_EQ(labels.at<std::uint8_t>(10, 31), 0);
  EXPECT_EQ(labels.at<std::uint8_t>(10, 32), 1);
  EXPECT_EQ(labels.at<std::uint8_t>(10, 63), 2);
  EXPECT_FALSE(fs::exists(folder / "out/b.confidence.png"));
  EXPECT_FALSE(fs::exists(folder / "out/b.drawn.png"));
  arguments.ids = false;
  arguments.confidence = arguments.draw = arguments.force = true;
  label();
  EXPECT_EQ(read_image_as_stored(folder / "out/b.png").type(), CV_8UC1);
  EXPECT_EQ(read_image_as_stored(folder / "out/b.confidence.png").at<std::uint8_t>(0, 0), 51);
  EXPECT_EQ(read_image_as_stored(folder / "out/b.drawn.png").type(), CV_8UC3);
}

TEST_F(LabelPictures, TakesOnePicture) {
  arguments.input = folder / "street/images/a.png";
  EXPECT_EQ(label().images, 1u);
  EXPECT_FALSE(fs::exists(folder / "out/b.png"));
}

TEST_F(LabelPictures, RefusesTwoPicturesOfOneName) {
  test::write_image(folder, "street/images/a.jpg", test::tiny_grey(64, 48, 1));
  EXPECT_THAT(message_of([&] { label(); }), HasSubstr("a.png: is the same frame as a.jpg"));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(LabelPictures, NamesThePictureThatCannotBeLabelled) {
  test::write_image(folder, "street/images/c.png", test::tiny_grey(20, 20, 1));
  EXPECT_THAT(message_of([&] { label(); }), HasSubstr("c.png"));
  folder.write("out/mine.txt", "mine");
  EXPECT_THAT(message_of<ArgumentError>([&] { label(); }),
              HasSubstr("out: is not empty; --force writes into it"));
}

TEST(ScenePictureText, LeavesOutClassesThatAreNowhere) {
  SceneImageResult result{"out", false, {"Sky", "Road"}, {30, 0, 10}, 4, 12.4};
  EXPECT_EQ(to_text(result),
            "4 images, 12 ms CPU each: Sky 0.750 unknown 0.250, written to out in colours (--ids: "
            "numbers)\n");
  result.ids = true;
  EXPECT_THAT(to_text(result), HasSubstr("written to out as class numbers (dark images)\n"));
}

}  // namespace scene_images_test
}  // namespace placegraph::apps
