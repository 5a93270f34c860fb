#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/measurements/class_list.h>
#include <placegraph/io/models/scene_model_file.h>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace scene_model_file_test {

using ::testing::HasSubstr;

/// Two trees a forest: one that asks once and one that is a leaf.
DecisionForest small_forest(int classes) {
  DecisionForest forest;
  forest.classes = classes;
  forest.dimension = 3;
  forest.roots = {0, 3};
  forest.nodes = {{2, 17, 2},
                  {DecisionForest::kLeaf, 0, 0},
                  {DecisionForest::kLeaf, 0, 1},
                  {DecisionForest::kLeaf, 0, 2}};
  forest.leaves.assign(static_cast<std::size_t>(3 * classes), 0);
  forest.leaves[0] = 255;
  forest.leaves[static_cast<std::size_t>(2 * classes - 1)] = 200;
  forest.leaves[static_cast<std::size_t>(2 * classes)] = 55;
  return forest;
}

SceneModel small_model() {
  SceneModel model;
  model.kind = SceneModel::Kind::kUrban;
  for (int c = 0; c < 9; ++c) {
    model.classes.push_back("class" + std::to_string(c));
    model.surfaces.push_back(static_cast<Surface>(c % kSurfaceCount));
  }
  model.first = model.second = small_forest(9);
  model.relations.above.assign(81, 0.5f);
  model.relations.beside.assign(81, -0.25f);
  model.smoothness = 2;
  model.sharpness = 1.2f;
  model.origin = "nine pictures";
  return model;
}

class SceneModelFile : public ::testing::Test {
 protected:
  std::string written() {
    write_scene_model(path, small_model());
    return test::read_file(path);
  }
  std::string refusal(const std::string& bytes) {
    const std::string broken = folder.write("broken.pgscene", bytes);
    return test::message_of([&] { (void)read_scene_model(broken); });
  }
  test::TemporaryFolder folder;
  std::string path = folder / "model.pgscene";
};

TEST_F(SceneModelFile, ReadsWhatWasWritten) {
  (void)written();
  const SceneModel model = read_scene_model(path), before = small_model();
  EXPECT_EQ(model.classes, before.classes);
  EXPECT_EQ(model.surfaces, before.surfaces);
  EXPECT_EQ(model.origin, before.origin);
  EXPECT_EQ(model.relations.above, before.relations.above);
  EXPECT_EQ(model.second.leaves, before.second.leaves);
  EXPECT_EQ(model.second.roots, before.second.roots);
  EXPECT_EQ(model.smoothness, before.smoothness);
  const std::array<std::uint8_t, 3> row = {0, 0, 18};
  std::array<float, 9> shares, shares_before;
  model.first.predict(row.data(), shares.data());
  before.first.predict(row.data(), shares_before.data());
  EXPECT_EQ(shares, shares_before);
}

TEST_F(SceneModelFile, RefusesEveryTruncation) {
  const std::string bytes = written();
  for (std::size_t size = 0; size < bytes.size(); size += 31)
    EXPECT_THAT(refusal(bytes.substr(0, size)), HasSubstr("broken.pgscene: ")) << size;
  EXPECT_THAT(refusal(bytes.substr(0, bytes.size() - 1)), HasSubstr("truncated"));
  EXPECT_THAT(refusal(bytes + "x"), HasSubstr("too long"));
}

TEST_F(SceneModelFile, RefusesOtherFilesVersionsAndChangedBytes) {
  std::string bytes = written();
  EXPECT_THAT(refusal("PGWORDS\n" + bytes.substr(8)), HasSubstr("not a scene model"));
  std::string version = bytes;
  version[8] = 9;
  EXPECT_THAT(refusal(version), HasSubstr("version 9"));
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  EXPECT_THAT(refusal(bytes), HasSubstr("changed since it was written"));
  EXPECT_THAT(test::message_of([&] { (void)read_scene_model(folder / "none"); }),
              HasSubstr("cannot be read"));
}

TEST_F(SceneModelFile, WritesNoModelThatIsNone) {
  SceneModel model = small_model();
  model.first.nodes[0].other = 1;  // a branch that leads to the other one
  EXPECT_THROW(write_scene_model(path, model), ArgumentError);
  model = small_model();
  model.relations.above.pop_back();
  EXPECT_THROW(write_scene_model(path, model), ArgumentError);
}

class ClassList : public SceneModelFile {
 protected:
  std::string refusal_of(const std::string& text) {
    const std::string list = folder.write("CLASSES.txt", text);
    return test::message_of([&] { (void)read_class_list(list); });
  }
};

TEST_F(ClassList, ReadsNumbersNamesAndSurfaces) {
  const std::string list =
      folder.write("CLASSES.txt", "# id class layout\n1 Road ground\n0 Sky sky\n11 void -\n");
  const std::vector<SceneClass> classes = read_class_list(list);
  ASSERT_EQ(classes.size(), 3u);
  EXPECT_EQ(classes[0].name, "Sky");
  EXPECT_EQ(classes[1].surface, Surface::kGround);
  EXPECT_FALSE(classes[2].surface);
}

TEST_F(ClassList, LetsSeveralNumbersBeOfOneClass) {
  const std::string list =
      folder.write("CLASSES.txt", "1 Road ground\n2 Pavement ground\n3 Pavement ground\n");
  const std::vector<SceneClass> classes = read_class_list(list);
  ASSERT_EQ(classes.size(), 3u);
  EXPECT_EQ(classes[2].name, "Pavement");
}

TEST_F(ClassList, NamesTheLineItCannotRead) {
  EXPECT_THAT(refusal_of("0 Sky sky\n1 Road\n"), HasSubstr("CLASSES.txt:2: 2 columns"));
  EXPECT_THAT(refusal_of("0 Sky above\n"), HasSubstr("CLASSES.txt:1: surface"));
  EXPECT_THAT(refusal_of("0 Sky sky\n0 Road ground\n"), HasSubstr("there already"));
  EXPECT_THAT(refusal_of("0 Sky sky\n1 Sky ground\n"), HasSubstr("there already"));
  EXPECT_THAT(refusal_of("300 Sky sky\n"), HasSubstr("number"));
  EXPECT_THAT(refusal_of("11 void -\n"), HasSubstr("no class is scored"));
}

}  // namespace scene_model_file_test
}  // namespace placegraph
