#include "apps/train/environment_samples.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/models/scene_model_file.h>

#include <cmath>
#include <memory>

#include "tests/support/message_of.h"
#include "tests/unit/apps/image/scene/drawn_set.h"

namespace placegraph::apps {
namespace environment_samples_test {

using test::message_of;
using testing::HasSubstr;

/// An eye that has learned from drawn streets.
class EnvironmentSamples : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const test::TemporaryFolder folder;
    test::write_drawn_set(folder);
    const TrainSceneArguments training = test::drawn_set_training(folder, "surfaces.pgscene");
    train_scene(training, SceneModel::Kind::kSurfaces);
    surfaces = std::make_shared<const SceneModel>(read_scene_model(training.out));
  }
  static void TearDownTestSuite() { surfaces = nullptr; }
  /// A picture of a set of which such a share is buildings.
  void write_picture(int number, double share) const {
    const std::string name = "/p_" + std::to_string(number) + ".png";
    test::write_image(folder, "set/images" + name, test::draw_street(3).bgr);
    Image labels(180, 240, CV_8UC1, cv::Scalar(0));
    labels.rowRange(0, static_cast<int>(std::lround(180 * share))).setTo(1);
    test::write_image(folder, "set/labels" + name, labels);
  }
  static std::shared_ptr<const SceneModel> surfaces;
  test::TemporaryFolder folder;
};
std::shared_ptr<const SceneModel> EnvironmentSamples::surfaces;

TEST_F(EnvironmentSamples, APictureIsAStreetOrARoadByItsBuildings) {
  folder.write("set/CLASSES.txt", "0 Road ground\n1 Building vertical\n");
  // Every third picture counts: 0, 3, 6, 9. What is neither is left out.
  const double shares[] = {0.5, 0, 0, 0, 0.5, 0.5, 0.07, 0, 0, 0.2};
  for (int i = 0; i < 10; ++i) write_picture(i, shares[i]);
  const auto samples = samples_of_images(folder / "set", surfaces);
  ASSERT_EQ(samples.size(), 3u);
  EXPECT_EQ(samples[0].kind, Environment::kStreet);
  EXPECT_EQ(samples[1].kind, Environment::kRoad);
  EXPECT_EQ(samples[2].kind, Environment::kStreet);
}

TEST_F(EnvironmentSamples, NothingIsKnownOfTheDepthOfPictures) {
  folder.write("set/CLASSES.txt", "0 Road ground\n1 Building vertical\n");
  write_picture(0, 0.5);
  const auto samples = samples_of_images(folder / "set", surfaces);
  ASSERT_EQ(samples.size(), 1u);
  const auto& values = samples[0].evidence.values;
  for (std::size_t i = 0; i < values.size(); ++i) {  // the last five are of points
    const bool surface = i < 6, point = i + 5 >= values.size();
    EXPECT_FALSE(surface && std::isnan(values[i])) << i;
    EXPECT_TRUE(!point || std::isnan(values[i])) << i;
  }
}

TEST_F(EnvironmentSamples, ASetWithoutBuildingsIsRefused) {
  folder.write("set/CLASSES.txt", "0 Road ground\n1 House vertical\n");
  write_picture(0, 0.5);
  EXPECT_THAT(message_of<ArgumentError>([&] { samples_of_images(folder / "set", surfaces); }),
              HasSubstr("set: has no class Building"));
}

TEST_F(EnvironmentSamples, AViewOfARoomIsOfTheRoomsKind) {
  const auto samples = samples_of_world("corridor-loop", 1, 2, surfaces);
  ASSERT_GE(samples.size(), 2u);
  EXPECT_EQ(samples[0].kind, Environment::kCorridor);  // where the walk begins
  for (const EnvironmentSample& sample : samples)
    EXPECT_TRUE(sample.kind != Environment::kStreet && sample.kind != Environment::kRoad);
  for (const double value : samples[0].evidence.values) EXPECT_FALSE(std::isnan(value));
}

TEST_F(EnvironmentSamples, ATownIsAStreetSeenAsOftenAsAskedFor) {
  const auto samples = samples_of_world("town-loop", 1, 2, surfaces);
  ASSERT_EQ(samples.size(), 2u);
  for (const EnvironmentSample& sample : samples) EXPECT_EQ(sample.kind, Environment::kStreet);
}

}  // namespace environment_samples_test
}  // namespace placegraph::apps
