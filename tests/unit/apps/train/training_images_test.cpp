#include "apps/train/training_images.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/message_of.h"
#include "tests/unit/apps/image/scene/drawn_set.h"

namespace placegraph::apps {
namespace training_images_test {

using test::message_of;
using testing::HasSubstr;

/// The drawn set, whose classes a model numbers the other way round, without cars.
class SceneTrainingSet : public testing::Test {
 protected:
  SceneTrainingSet() {
    test::write_drawn_set(folder);
    set = read_labelled_set(folder / "set");
    model.kind = SceneModel::Kind::kUrban;
    model.classes = {"Wall", "Road", "Sky"};
    model.surfaces = {Surface::kVertical, Surface::kGround, Surface::kSky};
    options.threads = 1;
  }
  test::TemporaryFolder folder;
  LabelledSet set;
  SceneModel model;
  TrainingImageOptions options;
};

TEST_F(SceneTrainingSet, NumbersTheLabelsByTheClassesOfTheModel) {
  const auto training_set = training_images(set, set.train, model, options);
  ASSERT_EQ(training_set.size(), 5u);
  EXPECT_EQ(training_set[0].sequence, "one");
  const auto [picture, labels] = training_set[0].read();
  const test::DrawnStreet street = test::draw_street(1);
  EXPECT_TRUE(test::same_pixels(picture, street.bgr));
  for (int v = 0; v < labels.rows; v += 10)
    for (int u = 0; u < labels.cols; u += 10) {
      const int drawn = street.labels.at<std::uint8_t>(v, u);  // sky, road, wall, car
      EXPECT_EQ(labels.at<std::uint8_t>(v, u), drawn == 3 ? 255 : 2 - drawn);
    }
}

TEST_F(SceneTrainingSet, RenderedStreetsFollowThePhotographs) {
  options.rendered = {3};
  options.rendered_frames = 2;
  const auto training_set = training_images(set, {set.train[0]}, model, options);
  ASSERT_EQ(training_set.size(), 3u);
  EXPECT_EQ(training_set[1].sequence, "town-loop 3");
  const auto [picture, labels] = training_set[2].read();
  EXPECT_EQ(picture.size(), labels.size());
  for (int v = 0; v < labels.rows; v += 10)
    for (int u = 0; u < labels.cols; u += 10) {
      const int label = labels.at<std::uint8_t>(v, u);
      EXPECT_TRUE(label < 3 || label == 255) << label;
    }
}

TEST_F(SceneTrainingSet, NamesTheFileThatCannotBeRead) {
  folder.write("set/train/images/one_2.png", "no image");
  const auto training_set = training_images(set, set.train, model, options);
  EXPECT_THAT(message_of([&] { training_set[1].read(); }), HasSubstr("one_2.png"));
}

}  // namespace training_images_test
}  // namespace placegraph::apps
