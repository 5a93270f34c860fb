#include "apps/image/scene/scene_label.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/synthetic/writers/sequence_writer.h>

#include "apps/image/scene/scene_surfaces.h"
#include "tests/support/clean_world.h"
#include "tests/support/message_of.h"
#include "tests/unit/apps/image/scene/drawn_set.h"

namespace placegraph::apps {
namespace scene_label_test {

using test::message_of;
using testing::HasSubstr;

/// Models of drawn streets, and a street that they have not seen.
class SceneLabelCommand : public testing::Test {
 protected:
  static void SetUpTestSuite() { models = new test::DrawnModels; }
  static void TearDownTestSuite() { delete models; }
  SceneLabelCommand() {
    test::write_image(folder, "street.png", street.bgr);
    arguments.input = folder / "street.png";
    arguments.ids = true;
    arguments.out = folder / "out";
    arguments.model = models->folder / "urban.pgscene";
    arguments.surfaces_model = models->folder / "surfaces.pgscene";
  }
  Image labels() const { return read_image_as_stored(folder / "out/street.png"); }
  static test::DrawnModels* models;
  test::TemporaryFolder folder;
  test::DrawnStreet street = test::draw_street(77);
  SceneImageArguments arguments;
};
test::DrawnModels* SceneLabelCommand::models = nullptr;

TEST_F(SceneLabelCommand, TellsTheClassesOfAStreet) {
  const SceneImageResult result = scene_label(arguments);
  EXPECT_EQ(result.classes, (std::vector<std::string>{"Sky", "Road", "Wall", "Car"}));
  EXPECT_EQ(result.pixels.back(), 0);
  EXPECT_GT(test::agreement(labels(), street.labels), 0.9);
}

TEST_F(SceneLabelCommand, TellsTheSurfacesOfAStreet) {
  arguments.model = models->folder / "surfaces.pgscene";
  const SceneImageResult result = scene_surfaces(arguments);
  EXPECT_EQ(result.classes, (std::vector<std::string>{"sky", "ground", "vertical", "object"}));
  EXPECT_GT(test::agreement(labels(), street.labels), 0.9);
}

TEST_F(SceneLabelCommand, WhatIsNotCertainIsUnknown) {
  arguments.unknown_below = 1;
  EXPECT_GT(scene_label(arguments).pixels.back(), 0);
  arguments.model = models->folder / "surfaces.pgscene";
  arguments.force = true;
  EXPECT_GT(scene_surfaces(arguments).pixels.back(), 0);
}

TEST_F(SceneLabelCommand, RefusesAModelOfTheOtherKindAndOneThatIsMissing) {
  std::swap(arguments.model, arguments.surfaces_model);
  EXPECT_THAT(message_of([&] { scene_label(arguments); }),
              HasSubstr("surfaces.pgscene: a model of kind surfaces, and urban is needed"));
  arguments.model = models->folder / "urban.pgscene";
  EXPECT_THAT(message_of([&] { scene_surfaces(arguments); }),
              HasSubstr("urban.pgscene: a model of kind urban, and surfaces is needed"));
  arguments.model = folder / "none.pgscene";
  EXPECT_THAT(message_of([&] { scene_surfaces(arguments); }),
              HasSubstr("none.pgscene: no such model; `placegraph train surfaces DATA"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

/// Renders the left images of a world into the folder `name`.
std::string rendered(const test::TemporaryFolder& folder, const std::string& name, int frames,
                     int width, int height) {
  write_sequence(SyntheticWorld(test::clean_world(name, frames, width, height)), folder / name, {});
  return folder / name + "/image_0";
}

/// Share of the pixels that got a class.
double labelled_share(const SceneImageResult& result) {
  double sum = 0;
  for (const std::int64_t pixels : result.pixels) sum += static_cast<double>(pixels);
  return 1 - static_cast<double>(result.pixels.back()) / sum;
}

TEST(SceneLabelOfRooms, FindsNoStreetInACorridor) {
  const test::TemporaryFolder folder;
  SceneImageArguments arguments;
  arguments.input = rendered(folder, "corridor-loop", 12, 320, 240);
  arguments.out = folder / "labels";
  EXPECT_LE(labelled_share(scene_label(arguments)), 0.05);
  arguments.force = true;
  arguments.surroundings = "street";
  EXPECT_EQ(labelled_share(scene_label(arguments)), 1);
}

TEST(SceneLabelOfRooms, LeavesAStreetAsItIs) {
  const test::TemporaryFolder folder;
  SceneImageArguments arguments;
  arguments.input = rendered(folder, "town-loop", 4, 620, 188);
  arguments.out = folder / "labels";
  const SceneImageResult result = scene_label(arguments);
  EXPECT_EQ(labelled_share(result), 1);
  arguments.force = true;
  arguments.surroundings = "street";
  EXPECT_EQ(scene_label(arguments).pixels, result.pixels);
}

}  // namespace scene_label_test
}  // namespace placegraph::apps
