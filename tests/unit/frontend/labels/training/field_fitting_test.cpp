#include <gtest/gtest.h>
#include <placegraph/frontend/labels/training/field_fitting.h>
#include <placegraph/frontend/labels/label_field.h>

#include <opencv2/core.hpp>

namespace placegraph {
namespace field_fitting_test {

constexpr int kClasses = 2;

/// Six stripes of eight pixels each of which all pixels have a class, from the top down.
SceneExample stripes(const std::vector<int>& classes) {
  Image index(6, 8, CV_32SC1);
  for (int v = 0; v < 6; ++v) index.row(v).setTo(v);
  SceneExample example;
  example.superpixels = superpixels_of_index(index, 6);
  example.features = {6, kSuperpixelFeatures,
                      std::vector<std::uint8_t>(6 * kSuperpixelFeatures, 100)};
  for (const int c : classes) {
    example.pixels.push_back(c == 0 ? 8 : 0);
    example.pixels.push_back(c == 1 ? 8 : 0);
  }
  return example;
}

/// Examples, and what a forest says of their stripes: the share of class 1.
struct TrainingSet {
  std::vector<SceneExample> examples;
  SceneTrainingSet training_set;
  std::vector<float> shares{};

  TrainingSet(const std::vector<SceneExample>& of, const std::vector<float>& share_of_1)
      : examples(of), training_set(make_training_set(examples, kClasses, 0)) {
    for (const float share : share_of_1) shares.insert(shares.end(), {1 - share, share});
  }
  /// A model with the relations of the examples and the field that fits them.
  SceneModel fitted() const {
    SceneModel model;
    model.classes = {"a", "b"};
    model.relations = learn_relations(examples, training_set);
    fit_field(examples, training_set, shares, model);
    return model;
  }
};

TEST(LearnRelations, CountsWhatLiesAboveWhat) {
  // Class 0 always above class 1; a stripe without a class teaches nothing.
  SceneExample one = stripes({0, 0, 0, 1, 1, 1});
  SceneExample with_void = stripes({0, 0, 0, 2, 1, 1});
  const TrainingSet training_set({one, with_void}, std::vector<float>(12, 0.5F));
  RelationCounts expected(kClasses);
  expected.add(one.superpixels, {0, 0, 0, 1, 1, 1});
  expected.add(one.superpixels, {0, 0, 0, -1, 1, 1});
  const RelationTable table = learn_relations(training_set.examples, training_set.training_set);
  EXPECT_EQ(table.above, expected.table().above);
  EXPECT_EQ(table.beside, expected.table().beside);
  EXPECT_GT(table.above[1], table.above[2]);  // (0 above 1) against (1 above 0)
}

TEST(FitField, LeavesAForestThatIsRightAlone) {
  const SceneModel model =
      TrainingSet({stripes({0, 0, 1, 1, 0, 1})}, {0.1F, 0.1F, 0.9F, 0.9F, 0.1F, 0.9F}).fitted();
  EXPECT_EQ(model.smoothness, 0);
  EXPECT_EQ(model.relation_weight, 0);
}

TEST(FitField, SmoothsAwayTheErrorsOfAForest) {
  const SceneModel model = TrainingSet({stripes({0, 0, 0, 0, 0, 0}), stripes({1, 1, 1, 1, 1, 1})},
                                       {0.1F, 0.1F, 0.6F, 0.1F, 0.1F, 0.1F,  //
                                        0.9F, 0.9F, 0.9F, 0.4F, 0.9F, 0.9F})
                               .fitted();
  EXPECT_GT(model.smoothness + model.relation_weight, 0);
}

TEST(FitField, CountsOverlapNotOnlyPixels) {
  // One stripe of the rare class is right; smoothing it away would cost one stripe of eighteen, and
  // win two others.
  const SceneModel model = TrainingSet({stripes({0, 0, 0, 1, 0, 0}), stripes({0, 0, 0, 0, 0, 0}),
                                        stripes({0, 0, 0, 0, 0, 0})},
                                       {0.1F, 0.1F, 0.1F, 0.6F, 0.1F, 0.1F,  //
                                        0.1F, 0.1F, 0.6F, 0.1F, 0.1F, 0.1F,  //
                                        0.1F, 0.1F, 0.1F, 0.6F, 0.1F, 0.1F})
                               .fitted();
  EXPECT_EQ(model.smoothness, 0);
  EXPECT_EQ(model.relation_weight, 0);
}

TEST(FitField, SharpensWhatIsTooDoubtfulAndSoftensWhatIsTooSure) {
  const std::vector<SceneExample> examples(2, stripes({0, 0, 0, 1, 1, 1}));
  const float low = 0.3F, high = 0.7F;  // always right
  EXPECT_EQ(
      TrainingSet(examples, {low, low, low, high, high, high, low, low, low, high, high, high})
          .fitted()
          .sharpness,
      2);
  // Right nine times of twelve, surer than that; stripes that differ in colour do not mend it.
  const float no = 0.04F, yes = 0.96F;
  const SceneModel sure = TrainingSet({stripes({0, 1, 0, 1, 0, 1}), stripes({0, 1, 0, 1, 0, 1})},
                                      {no, yes, yes, yes, no, yes, no, no, no, yes, yes, yes})
                              .fitted();
  EXPECT_LT(sure.sharpness, 1);
}

}  // namespace field_fitting_test
}  // namespace placegraph
