#include "apps/eval/scene_check.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/message_of.h"
#include "tests/unit/io/datasets/tiny_images.h"

namespace placegraph::apps {
namespace scene_check_test {

using test::message_of;
using testing::HasSubstr;

/// Two pictures of eight pixels, each twice. Of those of `a` one is void, and one of
/// the others is called a wall though it is road; all of `b` are road and called so.
class SceneCheckCommand : public testing::Test {
 protected:
  SceneCheckCommand() {
    folder.write("data/CLASSES.txt", "0 Sky sky\n1 Road ground\n2 Wall vertical\n11 void -\n");
    write("data/images/a.png", std::vector<std::uint8_t>(8, 90));
    write("data/images/b.png", std::vector<std::uint8_t>(8, 90));
    write("data/labels/a.png", {0, 0, 1, 1, 1, 1, 2, 11});
    write("data/labels/b.png", std::vector<std::uint8_t>(8, 1));
    write("ours/a.png", {0, 0, 1, 1, 1, 2, 2, 0});
    write("ours/b.png", std::vector<std::uint8_t>(8, 1));
    arguments.labels = folder / "ours";
    arguments.data = folder / "data";
  }
  void write(const std::string& path, const std::vector<std::uint8_t>& values) const {
    test::write_image(folder, path, cv::repeat(Image(values, true).reshape(1, 2), 2, 1));
  }
  test::TemporaryFolder folder;
  SceneCheckArguments arguments;
};

TEST_F(SceneCheckCommand, CountsByHand) {
  const SceneCheckResult result = scene_check(arguments);
  EXPECT_EQ(result.images, 2u);
  EXPECT_EQ(result.names, (std::vector<std::string>{"Sky", "Road", "Wall"}));
  EXPECT_EQ(result.check.pixels(), 30);
  EXPECT_DOUBLE_EQ(result.check.pixel_accuracy(), 14.0 / 15);
  EXPECT_EQ(result.check.count(1, 2), 2);
  EXPECT_DOUBLE_EQ(result.check.iou(0), 1);
  EXPECT_DOUBLE_EQ(result.check.iou(1), 11.0 / 12);
  EXPECT_DOUBLE_EQ(result.check.iou(2), 1.0 / 2);
  EXPECT_TRUE(std::isnan(result.check.calibration_error()));
}

TEST_F(SceneCheckCommand, JudgesSurfacesByTheirOwnNumbers) {
  arguments.surfaces = true;
  const SceneCheckResult result = scene_check(arguments);
  EXPECT_EQ(result.names, (std::vector<std::string>{"sky", "ground", "vertical", "object"}));
  EXPECT_DOUBLE_EQ(result.check.pixel_accuracy(), 14.0 / 15);
}

TEST_F(SceneCheckCommand, TakesTheNumbersOfAnotherListOfClasses) {
  arguments.classes = folder.write("other.txt", "0 Road ground\n1 Sky sky\n2 Wall vertical\n");
  write("ours/a.png", {1, 1, 0, 0, 0, 2, 2, 0});
  write("ours/b.png", std::vector<std::uint8_t>(8, 0));
  const SceneCheckResult result = scene_check(arguments);
  EXPECT_EQ(result.names, (std::vector<std::string>{"Road", "Sky", "Wall"}));
  EXPECT_DOUBLE_EQ(result.check.pixel_accuracy(), 14.0 / 15);
  EXPECT_DOUBLE_EQ(result.check.iou(0), 11.0 / 12);
}

TEST_F(SceneCheckCommand, JudgesConfidencesWhereThereAreSome) {
  // Six of the seven scored pixels of `a` are right, all are said to be certain.
  write("ours/a.confidence.png", std::vector<std::uint8_t>(8, 255));
  EXPECT_NEAR(scene_check(arguments).check.calibration_error(), 1.0 / 7, 1e-6);
  write("ours/a.confidence.png", std::vector<std::uint8_t>(8, 51));  // a fifth
  EXPECT_NEAR(scene_check(arguments).check.calibration_error(), 6.0 / 7 - 0.2, 1e-6);
}

TEST_F(SceneCheckCommand, SaysItClassByClass) {
  arguments.confusion = true;
  const SceneCheckResult result = scene_check(arguments);
  EXPECT_EQ(to_text(result),
            "2 images: pixel accuracy 0.9333, class accuracy 0.9722, mean IoU 0.8056\n"
            "Sky          IoU 1.000         4         0         0         0\n"
            "Road         IoU 0.917         0        22         2         0\n"
            "Wall         IoU 0.500         0         0         2         0\n");
  const auto json = nlohmann::json::parse(to_json(result));
  EXPECT_EQ(json["confusion"]["Road"], (std::vector<int>{0, 22, 2, 0}));
  EXPECT_EQ(json["iou"]["Wall"], 0.5);
  EXPECT_FALSE(json.contains("calibration_error"));
}

TEST_F(SceneCheckCommand, NamesTheFileThatIsMissingOrNoLabelImage) {
  test::write_image(folder, "ours/b.png", Image(4, 4, CV_8UC3, cv::Scalar::all(1)));
  EXPECT_THAT(message_of([&] { scene_check(arguments); }),
              HasSubstr("ours/b.png: no label image: one channel of 8 bits is needed"));
  test::write_image(folder, "ours/b.png", Image(4, 5, CV_8UC1, cv::Scalar(1)));
  EXPECT_THAT(message_of([&] { scene_check(arguments); }), HasSubstr("ours/b.png"));
  std::filesystem::remove(folder / "ours/a.png");
  EXPECT_THAT(message_of([&] { scene_check(arguments); }),
              HasSubstr("ours/a.png: missing: the labels of "));
}

}  // namespace scene_check_test
}  // namespace placegraph::apps
