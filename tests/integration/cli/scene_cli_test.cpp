// `placegraph train surfaces|urban` and `placegraph scene label|surfaces|check`.
#include <nlohmann/json.hpp>

#include "tests/support/cli_test.h"
#include "tests/support/data.h"
#include "tests/support/pictures.h"
#include "tests/support/scenes/scene_images.h"

namespace placegraph {
namespace scene_cli_test {

namespace fs = std::filesystem;
using nlohmann::json;
using test::CommandResult;
using test::read_file;
using test::write_file;
using ::testing::HasSubstr;

class SceneCli : public test::CliTest {
 protected:
  /// One thread: OpenCV keeps what a thread has used until the end, which looks like a leak.
  /// Two drives of three drawn streets, and one to judge by.
  void make_set() {
    int number = 0;
    for (const char* name : {"train/%s/one_1", "train/%s/one_2", "train/%s/one_3", "train/%s/two_1",
                             "train/%s/two_2", "val/%s/one_4"}) {
      const test::DrawnStreet street = test::draw_street(static_cast<std::uint64_t>(++number));
      const std::string path = name;
      const auto file = [&](const char* kind) {
        return dir / ("set/" + std::string(path).replace(path.find("%s"), 2, kind) + ".png");
      };
      fs::create_directories(fs::path(file("images")).parent_path());
      fs::create_directories(fs::path(file("labels")).parent_path());
      test::write_picture(file("images"), street.bgr);
      test::write_picture(file("labels"), street.labels);
    }
    write_file(dir / "set/CLASSES.txt",
               "0 Sky sky\n1 Road ground\n2 Wall vertical\n3 Car object\n11 void -\n");
  }
  void train(const std::string& kind, const std::string& more = "") {
    const CommandResult result =
        run("train " + kind + " set --out " + kind +
            ".pgscene --trees 5 --variants 2 --min-leaf 4 --share-rows 0.8 --threads 1 " + more);
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("pixel accuracy"));
  }
};

TEST_F(SceneCli, TrainsLabelsAndJudges) {
  make_set();
  train("surfaces");
  train("urban", "--ablation");
  EXPECT_THAT(read_file(dir / "urban.pgscene.md"), HasSubstr("5 pictures, 2 variants, 5 trees"));
  const CommandResult labelled =
      run("image labels set/val --out labels --model urban.pgscene --surfaces-model "
          "surfaces.pgscene --confidence --draw --json");
  ASSERT_EQ(labelled.code, 0) << labelled.err;
  EXPECT_EQ(json::parse(labelled.out)["pictures"], 1);
  EXPECT_TRUE(fs::exists(dir / "labels/one_4.drawn.png"));
  const CommandResult judged = run("eval labels labels set/val --json --confusion");
  ASSERT_EQ(judged.code, 0) << judged.err;
  const json report = json::parse(judged.out);
  EXPECT_GT(report["pixel_accuracy"], 0.9);
  EXPECT_TRUE(report.contains("calibration_error"));
  EXPECT_EQ(report["confusion"]["Road"].size(), 5u);

  ASSERT_EQ(
      run("image surfaces set/val/images/one_4.png --out layout --ids --model surfaces.pgscene").code,
      0);
  const CommandResult layout = run("eval labels layout set/val --surfaces");
  EXPECT_THAT(layout.out, HasSubstr("vertical"));
  // The colours that are written without --ids are no numbers.
  ASSERT_EQ(
      run("image surfaces set/val/images/one_4.png --out seen --model surfaces.pgscene").code, 0);
  expect_usage_error("eval labels seen set/val --surfaces", "--ids");
}

TEST_F(SceneCli, LearnsFromRenderedStreetsToo) {
  make_set();
  train("surfaces", "--rendered 11,12 --rendered-frames 1");
  EXPECT_THAT(read_file(dir / "surfaces.pgscene.md"),
              HasSubstr("beside them 2 views of rendered streets of seeds 11,12"));
  EXPECT_THAT(read_file(dir / "surfaces.pgscene.md"), HasSubstr("--rendered-frames 1"));
  expect_usage_error("train surfaces set --out m.pgscene --rendered x", "--rendered");
  expect_usage_error("train surfaces set --out m.pgscene --rendered 11 --rendered-frames 9999",
                     "--rendered-frames: a town has");
}

TEST_F(SceneCli, TeachesAClassThatAModelDoesNotKnow) {
  make_set();
  train("urban");
  write_file(dir / "set/CLASSES.txt", "0 Sky sky\n1 Road ground\n2 Wall vertical\n3 Van object\n");
  const CommandResult grown =
      run("train urban set --out grown.pgscene --update urban.pgscene --trees 5 --variants 1 "
          "--min-leaf 4 --share-rows 0.8 --threads 1");
  ASSERT_EQ(grown.code, 0) << grown.err;
  EXPECT_THAT(grown.out, HasSubstr("Road: "));
  EXPECT_THAT(read_file(dir / "grown.pgscene.md"), HasSubstr("Car Van"));
}

TEST_F(SceneCli, SaysInOneLineWhatIsMissing) {
  make_set();
  expect_usage_error("image labels none.png --out labels", "none.png");
  expect_usage_error("image surfaces set/val --out labels --model none.pgscene",
                     "placegraph train surfaces DATA");
  fs::create_directory(dir / "empty");
  write_file(dir / "broken.pgscene", "PGSCENE\n");
  expect_usage_error("image surfaces empty --out labels --model broken.pgscene",
                     "ends within the header");
  expect_usage_error("train surfaces empty --out m.pgscene", "CLASSES.txt");
  expect_usage_error("train surfaces set --out m.pgscene --holdout three", "--holdout");
  train("surfaces");
  expect_usage_error("image surfaces empty --out labels --model surfaces.pgscene", "empty");
  expect_usage_error("image labels set/val --out labels --model surfaces.pgscene",
                     "a model of kind surfaces");
  test::write_picture(dir / "tiny.png", Image(8, 8, CV_8UC3, cv::Scalar::all(9)));
  expect_usage_error("image surfaces tiny.png --out labels --model surfaces.pgscene",
                     "smaller than");
  fs::create_directory(dir / "wrong");
  test::write_picture(dir / "wrong/one_4.png", Image(8, 8, CV_8UC1, cv::Scalar(0)));
  expect_usage_error("eval labels wrong set/val", "one_4.png");
}

TEST_F(SceneCli, TheModelsThatCameWithTheProgramKnowAStreet) {
  PLACEGRAPH_DATA_OR_SKIP(camvid, "scene/camvid");
  fs::create_directories(dir / "few/images");
  fs::create_directories(dir / "few/labels");
  write_file(dir / "few/CLASSES.txt", read_file(camvid + "/CLASSES.txt"));
  for (const char* name : {"0016E5_07959", "0016E5_08059", "0016E5_08159"}) {
    fs::copy(camvid + "/val/images/" + name + ".jpg", dir / "few/images");
    fs::copy(camvid + "/val/labels/" + name + ".png", dir / "few/labels");
  }
  ASSERT_EQ(run("image labels few --out labels --ids --confidence").code, 0);
  const json classes = json::parse(run("eval labels labels few --json").out);
  EXPECT_GT(classes["pixel_accuracy"], 0.8);
  ASSERT_EQ(run("image surfaces few --out surfaces --ids").code, 0);
  const json surfaces = json::parse(run("eval labels surfaces few --surfaces --json").out);
  EXPECT_GT(surfaces["pixel_accuracy"], 0.88);
}

}  // namespace scene_cli_test
}  // namespace placegraph
