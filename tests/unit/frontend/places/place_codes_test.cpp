#include <gtest/gtest.h>
#include <placegraph/frontend/places/code_database.h>
#include <placegraph/frontend/places/cues/corner_agreement.h>
#include <placegraph/frontend/places/dense_index.h>
#include <placegraph/frontend/places/float_vocabulary.h>
#include <placegraph/frontend/places/inverted_index.h>
#include <placegraph/frontend/places/landmarks.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <Eigen/LU>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace place_codes_test {

FloatDescriptors random_rows(Eigen::Index rows, Eigen::Index columns, Random& random) {
  FloatDescriptors result(rows, columns);
  for (Eigen::Index i = 0; i < result.size(); ++i)
    result.data()[i] = static_cast<float>(random.normal());
  return result;
}

/// Texture of its own for every place, seen shifted.
Image picture(int place, int shift_px = 0) {
  Random random(78, static_cast<std::uint64_t>(place));
  cv::Mat coarse(24, 32, CV_8UC1), image;
  for (int y = 0; y < coarse.rows; ++y)
    for (int x = 0; x < coarse.cols; ++x)
      coarse.at<uchar>(y, x) = static_cast<uchar>(random.uniform(20, 230));
  cv::resize(coarse, image, {160, 120}, 0, 0, cv::INTER_CUBIC);
  const cv::Mat motion = (cv::Mat_<double>(2, 3) << 1, 0, shift_px, 0, 1, 0);
  cv::warpAffine(image, image, motion, image.size(), cv::INTER_LINEAR, cv::BORDER_REFLECT);
  return image;
}

TEST(LlcCodes, AreTheConstrainedLeastSquaresSolution) {
  Random random(1);
  const FloatDescriptors words = random_rows(5, 8, random);
  const Eigen::RowVectorXf x = random_rows(1, 8, random).row(0);
  constexpr double kRidge = 1e-4;
  const Eigen::VectorXf shares = local_shares(words, x, kRidge);
  EXPECT_NEAR(shares.sum(), 1, 1e-5);
  // |x - B c|^2 + ridge tr(C) |c|^2 + multiplier (1 - 1^T c): its stationary point solves
  // [2 (B B^T + ridge tr(C) I), 1; 1^T, 0] [c; m] = [2 B x; 1].
  const Eigen::MatrixXd B = words.cast<double>();
  const Eigen::VectorXd to = x.transpose().cast<double>();
  const double trace = (B.rowwise() - to.transpose()).squaredNorm();
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(6, 6);
  system.topLeftCorner(5, 5) =
      2 * (B * B.transpose() + kRidge * trace * Eigen::MatrixXd::Identity(5, 5));
  system.topRightCorner(5, 1).setOnes();
  system.bottomLeftCorner(1, 5).setOnes();
  Eigen::VectorXd right(6);
  right << 2 * B * to, 1;
  const Eigen::VectorXd exact = system.fullPivLu().solve(right).head(5);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(shares[i], exact[i], 1e-5) << i;
}

TEST(LlcCodes, GiveAWordToItselfAndTakeTheNearest) {
  Random random(2);
  const FloatDescriptors words = random_rows(20, 8, random);
  const auto codes = llc_codes(words, words.middleRows(7, 2), {});
  ASSERT_EQ(codes.size(), 2u);
  EXPECT_EQ(codes[0].words.size(), 5u);
  EXPECT_EQ(codes[0].words.front(), 7);
  EXPECT_EQ(codes[1].words.front(), 8);
  EXPECT_GT(codes[0].shares[0], 0.98f);  // 1 but for the ridge
  // All alike: no word is better than another.
  const Eigen::VectorXf even =
      local_shares(FloatDescriptors::Ones(4, 3), Eigen::RowVectorXf::Ones(3), 1e-4);
  for (const float share : even) EXPECT_FLOAT_EQ(share, 0.25f);
  EXPECT_THROW((void)llc_codes(words, random_rows(1, 7, random), {}), ArgumentError);
  EXPECT_TRUE(llc_codes(words, FloatDescriptors(0, 8), {}).empty());
}

TEST(LlcCodes, PoolTheLargestShareOfEveryWordInEveryCell) {
  Eigen::VectorXf shares(2);
  shares << 0.8f, 0.2f;
  Eigen::VectorXf other(2);
  other << 1.5f, -0.5f;
  const std::vector<LlcCode> codes = {{{0, 1}, shares}, {{1, 2}, other}};
  Eigen::VectorXf expected(3 * 3);
  expected << 0.8f, 1.5f, 0, 0.8f, 0.2f, 0, 0, 1.5f, 0;
  EXPECT_TRUE(max_pooled(codes, 3, {0, 1}, 2).isApprox(expected.normalized()));
  EXPECT_TRUE(max_pooled(codes, 3).isApprox(expected.head(3).normalized()));
  EXPECT_EQ(max_pooled({}, 3, {}, 2).norm(), 0);
  FloatFeatures features;
  features.position = {{0.1f, 0.1f}, {0.9f, 0.1f}, {0.2f, 0.7f}, {1.f, 0.75f}};
  features.height = 0.75f;
  EXPECT_EQ(pyramid_cells(features, 2), (std::vector<int>{0, 1, 2, 3}));
}

TEST(Landmarks, GroupKeyPointsThatStandTogether) {
  Random random(3);
  std::vector<Eigen::Vector2f> positions;
  for (int i = 0; i < 30; ++i)
    positions.emplace_back(
        0.2f + 0.5f * static_cast<float>(i % 2) + 0.01f * static_cast<float>(random.normal()),
        0.3f + 0.01f * static_cast<float>(random.normal()));
  const std::vector<int> group = group_positions(positions, 0.1);
  for (int i = 0; i < 30; ++i) EXPECT_EQ(group[static_cast<std::size_t>(i)], i % 2) << i;
  EXPECT_TRUE(group_positions({}, 0.1).empty());
  EXPECT_THROW((void)group_positions(positions, 0), ArgumentError);
}

TEST(Landmarks, AreSimilarWhereTheyStandNearEnough) {
  const auto landmark = [](int word, int features, float x) {
    return ImageLandmark{Eigen::VectorXf::Unit(4, word), Eigen::Vector2f(x, 0), features};
  };
  const std::vector<ImageLandmark> query = {landmark(0, 9, 0), landmark(1, 4, 0)};
  EXPECT_DOUBLE_EQ(landmark_similarity(query, {landmark(1, 3, 0.2f), landmark(0, 3, 0)}, 0.25), 1);
  EXPECT_DOUBLE_EQ(landmark_similarity(query, {landmark(0, 3, 0), landmark(1, 3, 0.3f)}, 0.25),
                   3.0 / 5);
  EXPECT_DOUBLE_EQ(landmark_similarity(query, {}, 1), 0);
  EXPECT_DOUBLE_EQ(landmark_similarity({}, query, 1), 0);
}

TEST(InvertedIndex, WeighsWordsByHowFewViewsHaveThem) {
  InvertedIndex index({1, 1, 3});
  EXPECT_EQ(index.add({0, 0, 1}), 0);
  EXPECT_EQ(index.add({2}), 1);
  // Of {0, 2}: weights 1/4 and 3/4; view 0 has word 0 at 2/3, view 1 word 2 at 1.
  const auto list = index.query({2, 0}, 9, 0, 9);
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].view, 1);
  EXPECT_NEAR(list[0].score, 0.75, 1e-6);
  EXPECT_NEAR(list[1].score, 0.25, 1e-6);
  EXPECT_EQ(index.query({2, 0}, 1, 0, 0).front().view, 0);
  EXPECT_TRUE(index.query({}, 9, 0, 9).empty());
  EXPECT_THROW(index.add({3}), ArgumentError);
  EXPECT_THROW(InvertedIndex({}), ArgumentError);
}

TEST(InvertedIndex, LearnsTheWeightsFromTheViewsItSaw) {
  InvertedIndex index({1, 1, 1, 1});
  for (std::uint32_t view = 0; view < 20; ++view) index.add({0, 1 + view % 3});
  // Word 0 is in all views and tells nothing: log(21/21) = 0.
  EXPECT_TRUE(index.query({0}, 9, 0, 19).empty());
  const auto list = index.query({0, 2}, 20, 0, 19);
  ASSERT_EQ(list.size(), 7u);
  for (const PlaceSimilarity& similarity : list) {
    EXPECT_EQ(similarity.view % 3, 1);
    EXPECT_NEAR(similarity.score, 1, 1e-6);
  }
}

TEST(DenseIndex, FindsInTheGraphWhatLookingAtAllFinds) {
  Random random(4);
  constexpr int kViews = 400, kDimension = 16;
  DenseIndex exact(kDimension), graph(kDimension, 10);
  FloatDescriptors vectors = random_rows(kViews, kDimension, random);
  vectors.rowwise().normalize();
  const auto row = [&](Eigen::Index i) {
    return std::span<const float>(vectors.row(i).data(), kDimension);
  };
  for (int i = 0; i < kViews; ++i) {
    EXPECT_EQ(exact.add(row(i)), i);
    graph.add(row(i));
  }
  int same = 0;
  for (int i = 0; i < 20; ++i) {
    const auto all = exact.query(row(i), 10, 50, 349);
    const auto followed = graph.query(row(i), 10, 50, 349);
    ASSERT_EQ(all.size(), 10u);
    for (const PlaceSimilarity& similarity : followed) {
      EXPECT_TRUE(similarity.view >= 50 && similarity.view < 350);
      same += std::any_of(all.begin(), all.end(),
                          [&](const auto& other) { return other.view == similarity.view; });
    }
    EXPECT_NEAR(graph.query(row(i), 1, 0, kViews).front().score, 1, 1e-5);
  }
  EXPECT_GT(same, 190);  // 95 %
  EXPECT_TRUE(exact.query(row(0), 10, 5, 4).empty());
  EXPECT_THROW(exact.add(std::span<const float>(vectors.data(), 3)), ArgumentError);
}

TEST(FloatVocabulary, SendsSimilarDescriptorsToOneWord) {
  Random random(5);
  const FloatDescriptors centres = 5 * random_rows(9, 6, random);
  FloatDescriptors descriptors(90, 6);
  for (Eigen::Index i = 0; i < 90; ++i)
    descriptors.row(i) = centres.row(i % 9) + 0.01f * random_rows(1, 6, random);
  const FloatVocabulary words =
      FloatVocabulary::train(descriptors, {.branching = 3, .depth = 4}, random);
  for (Eigen::Index i = 9; i < 90; ++i)
    for (Eigen::Index k = 0; k < 9; ++k) {
      if (k == i % 9) continue;
      EXPECT_NE(words.word(descriptors.row(i)), words.word(descriptors.row(k)));
    }
  EXPECT_FALSE(words.tree().problem());
  EXPECT_EQ(words.centres(1000).rows(), words.words());
  EXPECT_EQ(words.centres(4).rows(), 3);
  EXPECT_EQ(words.centres(1).rows(), 3);
  EXPECT_THROW((void)words.word(Eigen::RowVectorXf::Zero(5)), ArgumentError);
  EXPECT_THROW((void)FloatVocabulary::train(FloatDescriptors(0, 6), {}, random), ArgumentError);
  EXPECT_THROW(Vocabulary(words.tree()), ArgumentError);
  EXPECT_EQ(FloatVocabulary(words.tree()).word(descriptors.row(3)), words.word(descriptors.row(3)));
}

TEST(FloatVocabulary, IsTheSameForTheSameSeed) {
  Random random(6);
  const FloatDescriptors descriptors = random_rows(200, 4, random);
  Random first(7), again(7);
  EXPECT_EQ(
      FloatVocabulary::train(descriptors, {.branching = 4, .depth = 2}, first).tree().centres,
      FloatVocabulary::train(descriptors, {.branching = 4, .depth = 2}, again).tree().centres);
}

/// Small images, so few points and quick.
PlaceCodeOptions small() {
  PlaceCodeOptions options;
  options.corners.width_px = options.features.width_px = 160;
  options.corners.max_corners = options.features.max_features = 100;
  return options;
}

WordTree words_of(bool binary) {
  Random random(8);
  if (binary) {
    std::vector<BinaryDescriptor> descriptors;
    for (int place = 10; place < 13; ++place)
      for (const Feature& corner : corners_of_view(picture(place), small().corners))
        descriptors.push_back(corner.descriptor);
    return Vocabulary::train(descriptors, {.branching = 8, .depth = 2, .iterations = 2}, random)
        .tree();
  }
  const FloatDescriptors descriptors = float_features(picture(10), small().features).descriptors;
  return FloatVocabulary::train(descriptors, {.branching = 8, .depth = 2, .iterations = 2}, random)
      .tree();
}

TEST(CodeDatabase, FindsThePlaceSeenFromBesideByEveryCode) {
  const WordTree binary = words_of(true), real = words_of(false);
  for (const PlaceCode code :
       {PlaceCode::kBow, PlaceCode::kBowFloat, PlaceCode::kLlc, PlaceCode::kLandmarks}) {
    const auto memory =
        make_code_database(code, small(), code == PlaceCode::kBow ? binary : real, 1);
    for (int place = 0; place < 3; ++place)
      EXPECT_TRUE(memory->find_and_add(picture(place), {}).empty());
    const auto list = memory->find_and_add(picture(1, 6), ViewRange{0, 2});
    ASSERT_FALSE(list.empty());
    EXPECT_EQ(list.front().view, 1) << static_cast<int>(code);
    EXPECT_EQ(memory->find_and_add(picture(1), ViewRange{3, 3}).front().view, 3);
  }
}

TEST(CodeDatabase, AnswersNothingForABlankImage) {
  const WordTree real = words_of(false);
  const Image blank(120, 160, CV_8UC1, cv::Scalar(90));
  for (const PlaceCode code : {PlaceCode::kBowFloat, PlaceCode::kLandmarks}) {
    const auto memory = make_code_database(code, small(), real, 1);
    memory->find_and_add(blank, {});
    for (const PlaceSimilarity& similarity : memory->find_and_add(blank, ViewRange{0, 0}))
      EXPECT_EQ(similarity.score, 0);
  }
}

TEST(CodeDatabase, RefusesAVocabularyOfAnotherKind) {
  EXPECT_THROW((void)make_code_database(PlaceCode::kLlc, small(), {}, 1), ArgumentError);
  EXPECT_THROW((void)make_code_database(PlaceCode::kLlc, small(), words_of(true), 1),
               ArgumentError);
  EXPECT_THROW((void)make_code_database(PlaceCode::kBow, small(), words_of(false), 1),
               ArgumentError);
}

}  // namespace place_codes_test
}  // namespace placegraph
