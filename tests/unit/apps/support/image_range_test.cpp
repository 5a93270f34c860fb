#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/calibration/read_calibration.h>

#include <filesystem>

#include "apps/support/choice.h"
#include "apps/support/frame_source.h"
#include "apps/support/image_range.h"
#include "apps/support/labelled_set.h"
#include "apps/support/read_calib.h"
#include "tests/support/message_of.h"
#include "tests/unit/io/datasets/tiny_images.h"

namespace placegraph::apps {
namespace image_range_test {

using ::testing::EndsWith;
using ::testing::HasSubstr;

TEST(SelectedRange, IsAllOrTwoAscendingNumbersOfImages) {
  using Range = std::pair<std::int64_t, std::int64_t>;
  EXPECT_EQ(selected_range({}, 5), Range(0, 4));
  EXPECT_EQ(selected_range({0, 4}, 5), Range(0, 4));
  EXPECT_EQ(selected_range({3, 3}, 5), Range(3, 3));
  for (const std::vector<int>& range : {std::vector<int>{1}, {1, 2, 3}, {-1, 2}, {3, 2}, {0, 5}})
    EXPECT_EQ(test::message_of<ArgumentError>([&] { (void)selected_range(range, 5); }),
              "--range: two numbers of images needed, from 0 to 4");
  EXPECT_THROW((void)selected_range({0, 0}, 0), ArgumentError);
}

class Images : public ::testing::Test {
 protected:
  test::TemporaryFolder dir;
};

TEST_F(Images, ARangeKeepsTheNumbersOfItsFrames) {
  test::write_numbered(dir, "seq", 5);
  const ImageRange images = images_of(dir / "seq", {2, 3});
  EXPECT_EQ(images.first, 2);
  ASSERT_EQ(images.paths.size(), 2U);
  const Frame frame = read_frame(images, 1);
  EXPECT_EQ(frame.id, FrameId(3));
  EXPECT_TRUE(test::same_pixels(frame.image, test::tiny_grey(8, 6, 3)));
  EXPECT_TRUE(frame.colour.empty());
  EXPECT_THROW((void)read_frame(images, 2), std::out_of_range);
  EXPECT_EQ(images_of(dir / "seq", {}).paths.size(), 5U);
}

TEST_F(Images, LieInTheFolderOrInOneOfItsFolders) {
  test::write_numbered(dir, "seq", 1);
  EXPECT_EQ(image_folder_of(dir / "seq"), dir / "seq");
  dir.write("seq/image_0/x", "");
  EXPECT_EQ(image_folder_of(dir / "seq"), dir / "seq/image_0");
  dir.write("seq/images/x", "");
  EXPECT_EQ(image_folder_of(dir / "seq"), dir / "seq/images");
  EXPECT_EQ(image_folder_of(dir / "none"), dir / "none");
}

TEST_F(Images, OfABareFolderHaveOneSizeAndNoCamera) {
  test::write_numbered(dir, "bare", 3);
  const FrameSource bare(dir / "bare");
  EXPECT_EQ(bare.size(), 3U);
  EXPECT_FALSE(bare.camera() || bare.stamp_ns(1));
  EXPECT_TRUE(test::same_pixels(bare.image(2), test::tiny_grey(8, 6, 2)));
  test::write_image(dir, "bare/000002.png", test::tiny_grey(9, 6, 2));
  EXPECT_THAT(test::message_of([&] { (void)bare.image(2); }), HasSubstr("000002.png"));
  EXPECT_TRUE(test::same_pixels(bare.image(1), test::tiny_grey(8, 6, 1)));
  EXPECT_THROW(FrameSource(dir / "none"), FileError);
}

TEST_F(Images, OfADataSetHaveTimesAndACamera) {
  test::write_numbered(dir, "seq", 3);
  dir.write("seq/calibration.yaml", "width: 8\nheight: 6\nfx: 10\nfy: 11\ncx: 4\ncy: 3\nfps: 4\n");
  const FrameSource source(dir / "seq");
  EXPECT_EQ(source.size(), 3U);
  EXPECT_EQ(source.stamp_ns(2), 500'000'000);
  EXPECT_EQ(source.camera()->fy, 11);
  EXPECT_TRUE(test::same_pixels(source.image(1), test::tiny_grey(8, 6, 1)));
}

TEST_F(Images, ACameraIsALineOfNumbersOrACalibration) {
  const std::string line = dir.write("camera.txt", "500 501 320 240 640 480\n");
  const std::string yaml =
      dir.write("c.yaml", "width: 640\nheight: 480\nfx: 500\nfy: 501\ncx: 320\ncy: 240\n");
  for (const std::string& path : {line, yaml}) {
    const Camera camera = read_calib_without_distortion(path, "a cube needs");
    EXPECT_EQ(camera.fx, 500);
    EXPECT_EQ(camera.fy, 501);
    EXPECT_EQ(camera.cx, 320);
    EXPECT_EQ(camera.cy, 240);
    EXPECT_EQ(camera.width, 640);
    EXPECT_EQ(camera.height, 480);
  }
  const std::string bent = dir.write(
      "b.yaml", test::read_file(yaml) +
                    "distortion:\n  model: radial_tangential\n  coefficients: [0.1, 0, 0, 0]\n");
  EXPECT_EQ(read_calibration(bent).coefficients[0], 0.1);
  EXPECT_THAT(test::message_of([&] { (void)read_calib_without_distortion(bent, "a cube needs"); }),
              EndsWith("b.yaml: a cube needs a camera without distortion"));
  EXPECT_THROW((void)read_calibration(dir / "none.yaml"), FileError);
}

const std::vector<SceneClass> kClasses = {
    {0, "Void", std::nullopt}, {3, "Road", Surface::kGround}, {7, "Tree", Surface::kVertical}};

TEST_F(Images, LabelsBecomePositionsAmongTheNames) {
  Image labels(1, 4, CV_8UC1);
  labels.at<std::uint8_t>(0, 0) = 7, labels.at<std::uint8_t>(0, 1) = 3;
  labels.at<std::uint8_t>(0, 2) = 0, labels.at<std::uint8_t>(0, 3) = 3;
  const auto numbers = [&](const std::vector<std::string>& names, bool surfaces) {
    const Image image = class_image(labels, "a.png", kClasses, names, surfaces);
    return std::vector<int>(image.begin<std::uint8_t>(), image.end<std::uint8_t>());
  };
  EXPECT_EQ(numbers({"Road", "Tree"}, false), (std::vector<int>{1, 0, 255, 0}));
  EXPECT_EQ(numbers({"Tree"}, false), (std::vector<int>{0, 255, 255, 255}));
  EXPECT_EQ(numbers({"sky", "ground", "vertical"}, true), (std::vector<int>{2, 1, 255, 1}));
  labels.at<std::uint8_t>(0, 3) = 4;
  EXPECT_EQ(test::message_of([&] { (void)class_image(labels, "a.png", kClasses, {}, false); }),
            "a.png: class 4 at 3 0 is not in CLASSES.txt");
  EXPECT_THAT(test::message_of(
                  [&] { (void)class_image(Image(2, 2, CV_8UC3), "b.png", kClasses, {}, false); }),
              HasSubstr("b.png: no label image"));
}

TEST_F(Images, ALabelledSetHasItsPartsOrIsAllForTraining) {
  dir.write("all/CLASSES.txt", "0 Void -\n3 Road ground\n");
  for (const char* part : {"all", "parts/train", "parts/val"})
    for (const char* kind : {"images", "labels"})
      test::write_image(dir, std::string(part) + "/" + kind + "/town_07.png",
                        test::tiny_grey(8, 6, 0));
  dir.write("parts/CLASSES.txt", "3 Road ground\n");
  const LabelledSet all = read_labelled_set(dir / "all"), parts = read_labelled_set(dir / "parts");
  EXPECT_EQ(all.classes.size(), 2U);
  ASSERT_EQ(all.train.size(), 1U);
  EXPECT_TRUE(all.val.empty());
  EXPECT_EQ(all.train[0].sequence, "town");
  EXPECT_THAT(all.train[0].labels, EndsWith("all/labels/town_07.png"));
  EXPECT_THAT(parts.val.at(0).image, EndsWith("parts/val/images/town_07.png"));
  EXPECT_EQ(parts.train.size(), 1U);
  EXPECT_EQ(read_labelled_set(dir / "parts/train").classes.size(), 1U);  // the list above it
  std::filesystem::remove(dir / "all/labels/town_07.png");
  EXPECT_THAT(test::message_of([&] { (void)read_labelled_set(dir / "all"); }),
              HasSubstr("town_07.png: missing: the labels of"));
}

TEST(Choice, IsThePositionOfAName) {
  enum class Colour { kRed, kGreen, kBlue };
  EXPECT_EQ(choice<Colour>("--c", {"red", "green", "blue"}, "blue"), Colour::kBlue);
  EXPECT_EQ(test::message_of<ArgumentError>([] {
              (void)choice<Colour>("--c", {"red", "green"}, "gren");
            }),
            "--c: 'gren' is none of red, green");
}

}  // namespace image_range_test
}  // namespace placegraph::apps
