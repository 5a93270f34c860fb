#include <gtest/gtest.h>
#include <placegraph/graph/scene/scene_model.h>

#include <functional>
#include <limits>

namespace placegraph {
namespace scene_model_test {

/// A model of two classes whose forests are one leaf each.
SceneModel smallest() {
  SceneModel model;
  model.classes = {"sky", "ground"};
  model.surfaces = {Surface::kSky, Surface::kGround};
  for (DecisionForest* forest : {&model.first, &model.second}) {
    forest->classes = 2;
    forest->dimension = 1;
    forest->roots = {0};
    forest->nodes = {{}};
    forest->leaves = {100, 155};
  }
  model.relations.above.assign(4, 0);
  model.relations.beside.assign(4, 0);
  return model;
}

TEST(SceneModel, HasANameForEverySurfaceThatLeadsBackToIt) {
  for (int i = 0; i < kSurfaceCount; ++i) {
    const auto surface = static_cast<Surface>(i);
    EXPECT_EQ(surface_of_name(surface_name(surface)), surface);
  }
  for (const char* other : {"", "Sky", "sky ", "void"}) EXPECT_FALSE(surface_of_name(other));
}

TEST(SceneModel, NamesTheOnePartThatDoesNotFit) {
  ASSERT_FALSE(smallest().problem()) << *smallest().problem();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<std::pair<std::function<void(SceneModel&)>, const char*>> faults = {
      {[](SceneModel& m) { m.surfaces.pop_back(); }, "classes and their surfaces do not agree"},
      {[](SceneModel& m) { m.classes.resize(1), m.surfaces.resize(1); },
       "classes and their surfaces do not agree"},
      {[](SceneModel& m) { m.classes.resize(65), m.surfaces.resize(65); },
       "classes and their surfaces do not agree"},
      {[](SceneModel& m) { m.first.classes = 1; }, "a forest has another number of classes"},
      {[](SceneModel& m) { m.second.classes = 3; }, "a forest has another number of classes"},
      {[](SceneModel& m) { m.second.nodes[0].other = 1; }, "node 0: its leaf does not exist"},
      {[](SceneModel& m) { m.relations.above.pop_back(); },
       "a table of relations has the wrong size"},
      {[](SceneModel& m) { m.relations.beside.push_back(0); },
       "a table of relations has the wrong size"},
      {[&](SceneModel& m) { m.relations.beside[3] = nan; }, "a relation is not finite"},
      {[](SceneModel& m) { m.smoothness = -0.1F; }, "weights are out of range"},
      {[&](SceneModel& m) { m.relation_weight = nan; }, "weights are out of range"},
      {[](SceneModel& m) { m.sharpness = 0; }, "weights are out of range"},
      {[](SceneModel& m) { m.sharpness = 101; }, "weights are out of range"}};
  for (const auto& [spoil, message] : faults) {
    SceneModel model = smallest();
    spoil(model);
    EXPECT_EQ(model.problem(), message);
  }
}

}  // namespace scene_model_test
}  // namespace placegraph
