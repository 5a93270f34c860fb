#include <gtest/gtest.h>
#include <placegraph/frontend/places/classifiers/place_classifier.h>
#include <placegraph/frontend/places/classifiers/platt_scaling.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace placegraph {
namespace place_classifier_test {

constexpr int kPlaces = 3, kViewsOfEach = 8;

/// A cue that tells the places apart, three of noise; unit vectors.
PlaceCueVectors view_of(int place, Random& random) {
  PlaceCueVectors view;
  for (std::size_t cue = 0; cue < view.size(); ++cue) {
    view[cue] = Eigen::VectorXf::Zero(6);
    for (Eigen::Index i = 0; i < 6; ++i) view[cue][i] = static_cast<float>(random.uniform(0, 0.4));
    if (cue == 2) view[cue][place] += 2;
    view[cue].normalize();
  }
  return view;
}

struct TrainingSet {
  std::vector<PlaceCueVectors> views;
  std::vector<int> labels;
};

TrainingSet training_set(Random& random) {
  TrainingSet result;
  for (int place = 0; place < kPlaces; ++place)
    for (int i = 0; i < kViewsOfEach; ++i) {
      result.views.push_back(view_of(place, random));
      result.labels.push_back(place);
    }
  return result;
}

TEST(PlaceClassifier, FindsTheCueThatTellsPlacesApart) {
  Random random(3, 0);
  const TrainingSet l = training_set(random);
  const PlaceClassifier classifier = PlaceClassifier::train(l.views, l.labels, {});
  EXPECT_EQ(classifier.weights()[2], 1);
  EXPECT_EQ(classifier.weights()[0] + classifier.weights()[1] + classifier.weights()[3], 0);
  EXPECT_EQ(classifier.cross_validated_accuracy(), 1);
  for (int place = 0; place < kPlaces; ++place) {
    const Eigen::VectorXd p = classifier.classify(view_of(place, random));
    EXPECT_NEAR(p.sum(), 1, 1e-12);
    EXPECT_GT(p[place], 0.8);  // eight views a place: targets of 0.9
  }
}

TEST(PlaceClassifier, LearnsByEveryMachine) {
  Random random(6, 0);
  const TrainingSet l = training_set(random);
  for (const PlaceMachineKind machine : {PlaceMachineKind::kSvm, PlaceMachineKind::kAdaboost}) {
    const PlaceClassifier classifier =
        PlaceClassifier::train(l.views, l.labels, {.machine = machine});
    EXPECT_EQ(classifier.weights()[2], 1);
    EXPECT_EQ(classifier.cross_validated_accuracy(), 1);
    for (int place = 0; place < kPlaces; ++place) {
      const Eigen::VectorXd p = classifier.classify(view_of(place, random));
      EXPECT_NEAR(p.sum(), 1, 1e-12);
      EXPECT_GT(p[place], 0.7) << static_cast<int>(machine);
    }
  }
}

TEST(PlattScaling, FindsTheSigmoidThatOutputsWereDrawnFrom) {
  Random random(9, 0);
  constexpr int kCount = 20000;
  const PlattScaling truth{-3, 0.5};
  Eigen::VectorXd outputs(kCount);
  Eigen::Array<bool, Eigen::Dynamic, 1> positive(kCount);
  for (int i = 0; i < kCount; ++i) {
    outputs[i] = random.normal();
    positive[i] = random.uniform() < truth.probability(outputs[i]);
  }
  // Four deviations: the information of one output about the slope is about 0.1.
  const PlattScaling found = fit_platt_scaling(outputs, positive);
  EXPECT_NEAR(found.slope, truth.slope, 4 / std::sqrt(0.05 * kCount));
  EXPECT_NEAR(found.offset, truth.offset, 4 / std::sqrt(0.05 * kCount));
}

TEST(PlattScaling, StaysFiniteWhereOutputsPartTheClasses) {
  Eigen::VectorXd outputs(4);
  outputs << -1, -1, 1, 1;
  Eigen::Array<bool, Eigen::Dynamic, 1> positive(4);
  positive << false, false, true, true;
  // The targets are 1/4 and 3/4.
  EXPECT_NEAR(fit_platt_scaling(outputs, positive).probability(1), 0.75, 1e-4);
  EXPECT_NEAR(fit_platt_scaling(outputs, positive).probability(-1), 0.25, 1e-4);
  EXPECT_THROW((void)fit_platt_scaling(outputs, positive.head(2)), ArgumentError);
}

TEST(EntropyShare, IsNothingWhereSureAndOneWhereUnknown) {
  EXPECT_DOUBLE_EQ(entropy_share(Eigen::Vector3d(1, 0, 0)), 0);
  EXPECT_DOUBLE_EQ(entropy_share(Eigen::VectorXd::Constant(4, 0.25)), 1);
}

TEST(PlaceClassifier, IsLessSureOfAViewBetweenTwoPlaces) {
  Random random(4, 0);
  const TrainingSet l = training_set(random);
  const PlaceClassifier classifier = PlaceClassifier::train(l.views, l.labels, {});
  PlaceCueVectors between = view_of(0, random);
  between[2][1] = between[2][0];
  between[2].normalize();
  EXPECT_LT(classifier.classify(between).maxCoeff(),
            classifier.classify(view_of(0, random)).maxCoeff());
}

TEST(PlaceClassifier, RefusesTrainingSetsItCannotLearnFrom) {
  Random random(5, 0);
  TrainingSet l = training_set(random);
  EXPECT_THROW((void)PlaceClassifier::train(l.views, {0, 1}, {}), ArgumentError);
  EXPECT_THROW((void)PlaceClassifier::train(l.views, std::vector<int>(l.views.size(), 1), {}),
               ArgumentError);
  l.labels[0] = -1;
  EXPECT_THROW((void)PlaceClassifier::train(l.views, l.labels, {}), ArgumentError);
  l.labels[0] = 0;
  EXPECT_THROW((void)PlaceClassifier::train(l.views, l.labels, {.ridge = 0}), ArgumentError);
  l.views[1][0].resize(0);
  EXPECT_THROW((void)PlaceClassifier::train(l.views, l.labels, {}), ArgumentError);
}

TEST(PlaceClassifier, DescribesGreyImagesWithoutColour) {
  const PlaceCueVectors grey = describe_for_classes(Image(60, 80, CV_8UC1, cv::Scalar(9)));
  EXPECT_EQ(grey[0].size() + grey[1].size(), 0);
  EXPECT_GT(grey[2].size(), 0);
  EXPECT_EQ(describe_for_classes(Image(60, 80, CV_8UC3, cv::Scalar(9, 8, 7)))[0].size(), 256);
  EXPECT_THROW((void)describe_for_classes(Image(60, 80, CV_32FC1)), ArgumentError);
}

TEST(LabelFilter, CountsTransitionsAndHalfAnUnseenOne) {
  // From 0: once to itself and once to 1, each and a half: 1.5 of 3.
  LabelFilter filter({0, 0, 1});
  Eigen::VectorXd certain(2);
  certain << 1, 0;
  EXPECT_DOUBLE_EQ(filter.update(certain)[0], 1);
  Eigen::VectorXd even(2);
  even << 0.5, 0.5;
  EXPECT_DOUBLE_EQ(filter.update(even)[0], 1.5 / 3);
  EXPECT_THROW(filter.update(Eigen::VectorXd::Ones(3)), ArgumentError);
  EXPECT_THROW(LabelFilter({}), ArgumentError);
}

TEST(LabelFilter, SumsOverAllWaysThroughThePlaces) {
  // Transitions counted both ways: 0 stays once, 0-1 once, 1-2 twice; and a half each.
  LabelFilter filter({0, 0, 1, 2, 1});
  Eigen::Matrix3d counts;  // to, from
  counts << 1, 1, 0, 1, 0, 2, 0, 2, 0;
  counts.array() += 0.5;
  Random random(3);
  constexpr int kImages = 4;
  std::vector<Eigen::Vector3d> seen;
  for (int i = 0; i < kImages; ++i)
    seen.emplace_back(random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1));
  Eigen::Vector3d sums = Eigen::Vector3d::Zero();
  for (int code = 0; code < 3 * 3 * 3 * 3 * 3; ++code) {  // a place before, and one an image
    double way = 1;
    int from = code % 3, rest = code / 3;
    for (int i = 0; i < kImages; ++i, rest /= 3) {
      const int to = rest % 3;
      way *= counts(to, from) / counts.col(from).sum() * seen[static_cast<std::size_t>(i)][to];
      from = to;
    }
    sums[from] += way;
  }
  Eigen::VectorXd posterior;
  for (const Eigen::Vector3d& probabilities : seen) posterior = filter.update(probabilities);
  EXPECT_NEAR((posterior - sums / sums.sum()).norm(), 0, 1e-12);
}

TEST(EntropyShare, IsThatOfASmallerNumberOfEqualOnes) {
  for (const int n : {2, 5, 16}) {
    Eigen::VectorXd p = Eigen::VectorXd::Zero(16);
    p.head(n).setConstant(1.0 / n);
    EXPECT_NEAR(entropy_share(p), std::log(n) / std::log(16), 1e-12);
  }
  EXPECT_EQ(entropy_share(Eigen::VectorXd::Ones(1)), 0);
}

}  // namespace place_classifier_test
}  // namespace placegraph
