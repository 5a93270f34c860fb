#include <gtest/gtest.h>
#include <placegraph/frontend/labels/training/forest_training.h>
#include <placegraph/frontend/labels/label_field.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <array>
#include <cmath>
#include <opencv2/core.hpp>

namespace placegraph {
namespace scene_training_test {

/// Rows of two bytes; the class is whether their sum exceeds 255. In five blocks.
ForestTrainingSet diagonal_training_set(int rows) {
  Random random(3);
  ForestTrainingSet training_set;
  training_set.classes = 2;
  training_set.blocks = 5;
  training_set.columns.resize(2);
  for (int i = 0; i < rows; ++i) {
    const int x = random.index(256), y = random.index(256);
    training_set.columns[0].push_back(static_cast<std::uint8_t>(x));
    training_set.columns[1].push_back(static_cast<std::uint8_t>(y));
    training_set.label.push_back(x + y > 255 ? 1 : 0);
    training_set.weight.push_back(1);
    training_set.block.push_back(i % 5);
  }
  return training_set;
}

ForestOptions small_forest() {
  ForestOptions options;
  options.trees = 20;
  options.min_leaf = 4;
  options.tries = 4;
  options.share_rows = 0.8;
  return options;
}

TEST(ForestTraining, LearnsABorderThatNoSingleByteShows) {
  const ForestTrainingSet training_set = diagonal_training_set(1000);
  const TrainedForest trained = train_forest(training_set, small_forest(), 1);
  ASSERT_FALSE(trained.forest.problem());
  int right = 0, right_unseen = 0;
  for (std::size_t i = 0; i < training_set.label.size(); ++i) {
    const std::array<std::uint8_t, 2> row = {training_set.columns[0][i],
                                             training_set.columns[1][i]};
    std::array<float, 2> shares;
    trained.forest.predict(row.data(), shares.data());
    EXPECT_NEAR(shares[0] + shares[1], 1, 1e-5);
    right += (shares[1] > 0.5f) == (training_set.label[i] == 1) ? 1 : 0;
    right_unseen += (trained.unseen[2 * i + 1] > 0.5f) == (training_set.label[i] == 1) ? 1 : 0;
  }
  EXPECT_GT(right, 960);
  EXPECT_GT(right_unseen, 930);  // judged by trees that did not see the row
}

TEST(ForestTraining, GivesTheSameBitsForAnyNumberOfThreads) {
  const ForestTrainingSet training_set = diagonal_training_set(500);
  const TrainedForest one = train_forest(training_set, small_forest(), 1),
                      three = train_forest(training_set, small_forest(), 3);
  EXPECT_EQ(one.forest.leaves, three.forest.leaves);
  EXPECT_EQ(one.forest.roots, three.forest.roots);
  EXPECT_EQ(one.unseen, three.unseen);
}

TEST(ForestTraining, LearnsNothingFromVoidRowsAndRefusesWhatDoesNotAgree) {
  ForestTrainingSet training_set = diagonal_training_set(100);
  training_set.label[0] = ForestTrainingSet::kVoid;
  EXPECT_EQ(train_forest(training_set, small_forest(), 1).unseen.size(), 200u);
  training_set.label.assign(100, ForestTrainingSet::kVoid);
  EXPECT_THROW((void)train_forest(training_set, small_forest(), 1), ArgumentError);
  training_set = diagonal_training_set(100);
  training_set.columns[1].pop_back();
  EXPECT_THROW((void)train_forest(training_set, small_forest(), 1), ArgumentError);
}

/// Three regions, one above the other.
Superpixels three_rows() {
  Image index(6, 8, CV_32SC1, cv::Scalar(0));
  index.rowRange(2, 4).setTo(1);
  index.rowRange(4, 6).setTo(2);
  return superpixels_of_index(index, 3);
}

ByteFeatures equal_colours(int count) {
  return {count, 32, std::vector<std::uint8_t>(static_cast<std::size_t>(count) * 32, 100)};
}

TEST(LabelField, WithoutWeightsLeavesTheSharesAsTheyAre) {
  const std::vector<float> shares = {0.9f, 0.1f, 0.4f, 0.6f, 0.8f, 0.2f};
  const LabelField field{2, 0, 0, {std::vector<float>(4, 0), std::vector<float>(4, 0)}};
  const std::vector<float> marginals =
      field_marginals(field, shares, three_rows(), equal_colours(3));
  for (std::size_t i = 0; i < shares.size(); ++i) EXPECT_NEAR(marginals[i], shares[i], 1e-5);
}

TEST(LabelField, ADoubtfulRegionFollowsTheNeighboursItLooksLike) {
  const std::vector<float> shares = {0.9f, 0.1f, 0.4f, 0.6f, 0.8f, 0.2f};
  const LabelField field{2, 2, 0, {std::vector<float>(4, 0), std::vector<float>(4, 0)}};
  const std::vector<float> marginals =
      field_marginals(field, shares, three_rows(), equal_colours(3));
  EXPECT_GT(marginals[2], 0.6f);
  // By hand, were the neighbours certain: log(0.4/0.6) + 2 * (their means' difference < 1).
  EXPECT_LT(marginals[2], 1 / (1 + std::exp(-(std::log(0.4f / 0.6f) + 2))));
}

TEST(LabelField, TheTableDecidesWhatLiesAbove) {
  // Learned from pictures where class 1 never lies above class 0.
  RelationCounts counts(2);
  for (int i = 0; i < 100; ++i) counts.add(three_rows(), {0, i % 2, 1});
  const RelationTable table = counts.table();
  // 8 pixels a border: 400 of (0, 0), 800 of (0, 1), 400 of (1, 1), none of (1, 0), where chance
  // would have 400 * 400 / 1600 = 100 and the prior adds 200 to both.
  EXPECT_NEAR(table.above[2], std::log(200.0 / 300), 0.01);
  EXPECT_GT(table.above[0], 0);
  const std::vector<float> shares = {0.5f, 0.5f, 0.05f, 0.95f, 0.5f, 0.5f};
  const std::vector<float> marginals =
      field_marginals({2, 0, 1, table}, shares, three_rows(), equal_colours(3));
  EXPECT_GT(marginals[5], 0.6f);  // what lies under a 1 is no 0
}

}  // namespace scene_training_test
}  // namespace placegraph
