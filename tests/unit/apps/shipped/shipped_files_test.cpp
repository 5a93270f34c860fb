#include "apps/shipped/shipped_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>

#include <filesystem>

#include "apps/shipped/scene_models.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace shipped_files_test {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;

TEST(ConfigPath, IsTheFileItself) {
  const test::TemporaryFolder folder;
  const std::string mine = folder.write("mine.yaml", "seed: 1\n");
  EXPECT_EQ(config_path(mine), mine);
  EXPECT_EQ(config_path("./none.yaml"), "./none.yaml");  // whoever reads it names what is missing
}

TEST(ConfigPath, IsAShippedFileByItsName) {
  const std::string path = config_path("kitti_mono");
  EXPECT_THAT(path, EndsWith("/kitti_mono.yaml"));
  EXPECT_TRUE(std::filesystem::exists(path));
}

TEST(ConfigPath, NamesSimilarOrAllShippedFiles) {
  EXPECT_THAT(test::message_of<FileError>([] { config_path("kitty_mono"); }),
              HasSubstr("kitty_mono: no such file; did you mean kitti_mono?"));
  EXPECT_THAT(test::message_of<FileError>([] { config_path("mine"); }),
              AllOf(HasSubstr("installed files are "), HasSubstr("kitti_stereo, ")));
}

TEST(ConfigPath, AFileGoesBeforeAShippedOneOfItsName) {
  const test::TemporaryFolder folder;
  const std::filesystem::path before = std::filesystem::current_path();
  folder.write("kitti_mono", "seed: 1\n");
  std::filesystem::current_path(folder.path());
  EXPECT_EQ(config_path("kitti_mono"), "kitti_mono");
  std::filesystem::current_path(before);
}

TEST(SceneModelPath, IsWhatIsGivenOrNamesTheCommandThatMakesIt) {
  const test::TemporaryFolder folder;
  const std::string mine = folder.write("mine.pgscene", "");
  EXPECT_EQ(scene_model_path(SceneModel::Kind::kUrban, mine), mine);
  EXPECT_EQ(test::message_of([&] {
              (void)scene_model_path(SceneModel::Kind::kSurfaces, folder / "none");
            }),
            folder / "none: no such model; `placegraph train surfaces DATA --out "
                     "surfaces.pgscene` makes one");
  EXPECT_THROW((void)load_scene_model(SceneModel::Kind::kUrban, mine), FileError);
}

}  // namespace shipped_files_test
}  // namespace placegraph::apps
