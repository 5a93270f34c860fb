#include <gtest/gtest.h>
#include <placegraph/frontend/labels/training/scene_training_set.h>
#include <placegraph/graph/core/error.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace placegraph {
namespace scene_training_set_test {

constexpr int kClasses = 2;

/// A picture of three regions one above the other, 8, 16 and 24 pixels large, with so many pixels
/// of either class; every feature of region i is `tone` + i.
SceneExample example(std::vector<int> pixels, int tone, int block) {
  Image index(6, 8, CV_32SC1, cv::Scalar(0));
  index.rowRange(1, 3).setTo(1);
  index.rowRange(3, 6).setTo(2);
  SceneExample example;
  example.superpixels = superpixels_of_index(index, 3);
  example.features = {3, kSuperpixelFeatures, {}};
  for (int i = 0; i < 3; ++i)
    example.features.values.insert(example.features.values.end(), kSuperpixelFeatures,
                                   static_cast<std::uint8_t>(tone + i));
  example.pixels = std::move(pixels);
  example.block = block;
  return example;
}

std::vector<SceneExample> two_examples() {
  return {example({8, 0, 0, 16, 7, 11}, 10, 0), example({3, 5, 0, 16, 24, 0}, 20, 4)};
}

TEST(SceneTrainingSet, TheClassOfHalfOfThePixelsIsTheLabel) {
  auto examples = two_examples();
  const SceneTrainingSet training_set = make_training_set(examples, kClasses, 0);
  const std::uint8_t none = ForestTrainingSet::kVoid;  // 11 of 24 pixels are less than half
  EXPECT_EQ(training_set.rows.label, (std::vector<std::uint8_t>{0, 1, none, 1, 1, 0}));
  EXPECT_EQ(training_set.rows.weight, (std::vector<float>{8, 16, 0, 5, 16, 24}));
}

TEST(SceneTrainingSet, RareClassesWeighMore) {
  auto examples = two_examples();
  const SceneTrainingSet training_set = make_training_set(examples, kClasses, 0.5);
  // 32 of 69 pixels of rows with a label are of class 0, 37 of class 1.
  EXPECT_NEAR(training_set.rows.weight[0], 8 * std::sqrt(69.0 / 32), 1e-4);
  EXPECT_NEAR(training_set.rows.weight[1], 16 * std::sqrt(69.0 / 37), 1e-4);
  EXPECT_EQ(training_set.rows.weight[2], 0);
}

TEST(SceneTrainingSet, RowsAreTheSuperpixelsExampleByExample) {
  auto examples = two_examples();
  const SceneTrainingSet training_set = make_training_set(examples, kClasses, 0.5);
  EXPECT_EQ(training_set.first_row, (std::vector<int>{0, 3}));
  EXPECT_EQ(training_set.first_share(1), 3U * kClasses);
  EXPECT_EQ(training_set.rows.dimension(), kSuperpixelFeatures);
  for (const auto& column : training_set.rows.columns)
    EXPECT_EQ(column, (std::vector<std::uint8_t>{10, 11, 12, 20, 21, 22}));
  EXPECT_EQ(training_set.rows.block, (std::vector<std::int32_t>{0, 0, 0, 4, 4, 4}));
  EXPECT_EQ(training_set.rows.blocks, 5);
}

TEST(JudgesField, TakesEvenlyAboutAHundredExamples) {
  for (const std::size_t examples : {1U, 50U, 119U, 120U, 1000U}) {
    std::size_t judges = 0;
    for (std::size_t e = 0; e < examples; ++e) judges += judges_field(e, examples);
    EXPECT_EQ(judges,
              examples < 120 ? examples : (examples + examples / 120) / (examples / 120 + 1));
    EXPECT_LE(judges, 120U);
    EXPECT_TRUE(judges_field(0, examples));
  }
}

TEST(SceneTrainingSet, LetsGoOfFeaturesThatTheFieldDoesNotNeed) {
  auto few = two_examples();
  (void)make_training_set(few, kClasses, 0.5);
  for (const SceneExample& example : few) EXPECT_EQ(example.features.count, 3);
  std::vector<SceneExample> many(150, two_examples()[0]);
  (void)make_training_set(many, kClasses, 0.5);
  for (std::size_t e = 0; e < many.size(); ++e)
    EXPECT_EQ(many[e].features.count, e % 2 == 0 ? 3 : 0) << e;
}

TEST(SceneTrainingSet, RefusesExamplesWithoutALabel) {
  std::vector<SceneExample> examples{example({3, 0, 0, 7, 0, 0}, 10, 0)};
  EXPECT_THROW((void)make_training_set(examples, kClasses, 0.5), ArgumentError);
}

TEST(SceneTrainingSet, ContextIsWhatTheFirstForestSaysAround) {
  auto examples = two_examples();
  SceneTrainingSet training_set = make_training_set(examples, kClasses, 0.5);
  const std::vector<float> shares = {1, 0, 0.5F, 0.5F, 0, 1, 0, 1, 0.25F, 0.75F, 0.6F, 0.4F};
  add_context(examples, shares, training_set);
  ASSERT_EQ(training_set.rows.dimension(), kSuperpixelFeatures + context_dimension(kClasses));
  for (const std::size_t e : {0U, 1U}) {
    ByteFeatures bytes{3, kClasses, {}};
    for (std::size_t k = 0; k < 6; ++k)
      bytes.values.push_back(static_cast<std::uint8_t>(std::lround(shares[6 * e + k] * 255)));
    const ByteFeatures expected = context_features(bytes, examples[e].superpixels);
    for (int i = 0; i < 3; ++i)
      for (int d = 0; d < context_dimension(kClasses); ++d)
        EXPECT_EQ(training_set.rows.columns[static_cast<std::size_t>(kSuperpixelFeatures + d)]
                                           [3 * e + static_cast<std::size_t>(i)],
                  expected.row(i)[d]);
  }
}

std::vector<int> blocks_of_drives(const SceneTrainingOptions& options) {
  std::vector<SceneTrainingImage> images;
  for (const char* drive : {"one", "one", "one", "two", "two"})
    images.push_back({drive, [] {
                        return std::pair(Image(48, 64, CV_8UC3, cv::Scalar(90, 60, 30)),
                                         Image(48, 64, CV_8UC1, cv::Scalar(0)));
                      }});
  std::vector<int> blocks;
  for (const SceneExample& made : make_examples(images, kClasses, options, 1))
    blocks.push_back(made.block);
  return blocks;
}

TEST(SceneTrainingSet, ABlockIsSoManyPicturesOfOneDrive) {
  SceneTrainingOptions options;
  options.variants = 1;
  options.block = 2;
  EXPECT_EQ(blocks_of_drives(options), (std::vector<int>{0, 0, 1, 2, 2}));
  options.block = 9;
  options.variants = 2;
  EXPECT_EQ(blocks_of_drives(options), (std::vector<int>{0, 0, 0, 1, 1, 0, 0, 0, 1, 1}));
}

}  // namespace scene_training_set_test
}  // namespace placegraph
