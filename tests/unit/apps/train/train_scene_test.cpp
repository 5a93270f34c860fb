#include "apps/train/train_scene.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/models/scene_model_file.h>

#include <nlohmann/json.hpp>

#include "tests/support/message_of.h"
#include "tests/unit/apps/image/scene/drawn_set.h"

namespace placegraph::apps {
namespace train_scene_test {

using test::message_of;
using testing::HasSubstr;

constexpr auto kSurfaces = SceneModel::Kind::kSurfaces, kUrban = SceneModel::Kind::kUrban;

class TrainSceneCommand : public testing::Test {
 protected:
  TrainSceneCommand() {
    test::write_drawn_set(folder);
    arguments = test::drawn_set_training(folder, "model.pgscene");
  }
  test::TemporaryFolder folder;
  TrainSceneArguments arguments;
};

TEST_F(TrainSceneCommand, LearnsTheClassesAndJudgesThemByPicturesItHasNotSeen) {
  arguments.options.training.variants = 2;
  std::vector<std::string> printed;
  const TrainSceneResult result =
      train_scene(arguments, kUrban, [&](LogLevel, const std::string& m) { printed.push_back(m); });
  EXPECT_EQ(result.images, 5u);
  EXPECT_EQ(result.classes, (std::vector<std::string>{"Sky", "Road", "Wall", "Car"}));
  ASSERT_TRUE(result.held_out);
  EXPECT_EQ(result.held_out->images, 1u);
  EXPECT_EQ(result.held_out->sequence, "val");
  EXPECT_EQ(result.held_out->check.pixels(), 240 * 180);
  EXPECT_GT(result.held_out->check.pixel_accuracy(), 0.9);
  EXPECT_TRUE(result.held_out->ablation.empty());
  EXPECT_TRUE(result.held_out->changes.empty());
  EXPECT_FALSE(printed.empty());
  const SceneModel written = read_scene_model(arguments.out);
  EXPECT_EQ(written.kind, kUrban);
  EXPECT_EQ(written.classes, result.classes);
  EXPECT_EQ(written.origin, "5 pictures, 2 variants, 3 trees, seed 1");
  EXPECT_THAT(test::read_file(arguments.out + ".md"), HasSubstr("Held out: 1 images of val: "));
}

TEST_F(TrainSceneCommand, ASequenceThatIsHeldOutJudges) {
  arguments.holdout = "two";
  const TrainSceneResult result = train_scene(arguments, kSurfaces);
  EXPECT_EQ(result.images, 3u);
  EXPECT_EQ(result.classes, (std::vector<std::string>{"sky", "ground", "vertical", "object"}));
  EXPECT_EQ(result.held_out->images, 2u);
  EXPECT_EQ(result.held_out->sequence, "two");
  EXPECT_THAT(read_scene_model(arguments.out).origin, HasSubstr(", without two"));

  arguments.force = true;
  arguments.options.every = 3;  // pictures 0 and 3, of which the second is held out
  EXPECT_EQ(train_scene(arguments, kSurfaces).images, 1u);
}

TEST_F(TrainSceneCommand, JudgesEachPartOfTheModelIfAsked) {
  arguments.ablation = true;
  const TrainSceneResult result = train_scene(arguments, kUrban);
  ASSERT_EQ(result.held_out->ablation.size(), 5u);
  EXPECT_EQ(result.held_out->ablation[0].parts, "superpixels alone");
  // What the model does by default is one of the steps.
  EXPECT_EQ(result.held_out->ablation[3].check.pixel_accuracy(),
            result.held_out->check.pixel_accuracy());
  const auto json = nlohmann::json::parse(to_json(result));
  EXPECT_EQ(json["ablation"].size(), 5u);
  EXPECT_EQ(json["ablation"]["with the random field"], json["held_out"]);
}

TEST_F(TrainSceneCommand, SaysWhatAnOldModelLosesByNewData) {
  arguments.options.every = 5;  // of one picture
  arguments.options.training.forest.trees = 1;
  train_scene(arguments, kUrban);
  arguments.options.every = 1;
  arguments.options.training.forest.trees = 3;
  arguments.update = arguments.out;
  arguments.out = folder / "grown.pgscene";
  const TrainSceneResult result = train_scene(arguments, kUrban);
  ASSERT_EQ(result.held_out->changes.size(), 4u);
  EXPECT_EQ(result.held_out->changes[1].name, "Road");
  bool same = true;
  for (int c = 0; c < 4; ++c) {
    const SceneClassChange& change = result.held_out->changes[static_cast<std::size_t>(c)];
    EXPECT_DOUBLE_EQ(change.now, result.held_out->check.accuracy(c));
    same = same && change.before == change.now;
  }
  EXPECT_FALSE(same);
  EXPECT_THAT(read_scene_model(arguments.out).origin, HasSubstr("; then 5 pictures"));
}

TEST_F(TrainSceneCommand, NamesWhatItCannotLearnFrom) {
  arguments.holdout = "three";
  EXPECT_THAT(message_of<ArgumentError>([&] { train_scene(arguments, kUrban); }),
              HasSubstr("--holdout: no image is of the sequence three"));
  arguments.holdout.clear();
  std::filesystem::remove(folder / "set/train/labels/one_2.png");
  EXPECT_THAT(message_of([&] { train_scene(arguments, kUrban); }),
              HasSubstr("set/train/labels/one_2.png: missing: the labels of "));
  std::filesystem::remove(folder / "set/CLASSES.txt");
  EXPECT_THAT(message_of([&] { train_scene(arguments, kUrban); }), HasSubstr("CLASSES.txt"));
  EXPECT_FALSE(std::filesystem::exists(arguments.out));
}

TEST(TrainSceneText, SaysWhatWasLearnedAndHowWell) {
  LabelCheck check(2);
  const Image truth = Image(std::vector<std::uint8_t>{0, 0, 1, 1}, true).reshape(1, 1);
  check.add(truth, Image(std::vector<std::uint8_t>{0, 0, 1, 0}, true).reshape(1, 1),
            Image(1, 4, CV_32FC1, cv::Scalar(1)));
  TrainSceneResult result{"m.pgscene", 5, 2.4, {"Sky", "Road"}, 0.5f, 0, 2, {}};
  const std::string first =
      "m.pgscene: learned from 5 images in 2 s; smoothness 0.5, relations 0, sharpness 2\n";
  EXPECT_EQ(to_text(result), first);
  EXPECT_FALSE(nlohmann::json::parse(to_json(result)).contains("held_out"));
  result.held_out =
      SceneJudgement{3, "val", check, {{"superpixels alone", check}}, {{"Sky", 0.75, 1}}};
  const std::string figures =
      "pixel accuracy 0.7500, class accuracy 0.7500, mean IoU 0.5833, calibration error 0.2500\n";
  EXPECT_EQ(to_text(result), first + "3 images of val: " + figures +
                                 "  superpixels alone: " + figures +
                                 "  Sky: 0.7500 of its pixels found before, 1.0000 now\n");
  const auto json = nlohmann::json::parse(to_json(result));
  EXPECT_EQ(json["held_out"]["iou"]["Road"], 0.5);
  EXPECT_EQ(json["pictures"], 5);
}

}  // namespace train_scene_test
}  // namespace placegraph::apps
