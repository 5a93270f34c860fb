#include <gtest/gtest.h>
#include <placegraph/frontend/places/classifiers/kernel_machine.h>
#include <placegraph/graph/core/random.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace placegraph {
namespace kernel_machine_test {

constexpr int kViews = 18, kPlaces = 3, kFolds = 4;

/// Views as points of the plane about their place, with cues 1 and 3; cue 3 is noise.
PlaceTrainingSet draw_training_set(Random& random, const std::vector<int>& number_of_place) {
  PlaceTrainingSet set;
  set.places = kPlaces;
  std::vector<Eigen::Vector2d> good, noise;
  for (int i = 0; i < kViews; ++i) {
    const int place = i % kPlaces;
    set.labels.push_back(number_of_place[static_cast<std::size_t>(place)]);
    set.fold.push_back(i / kPlaces % kFolds);
    good.emplace_back(2 * std::cos(2 * place) + random.normal(0, 0.6),
                      2 * std::sin(2 * place) + random.normal(0, 0.6));
    noise.emplace_back(random.normal(), random.normal());
  }
  for (const auto& [cue, points] : {std::pair{1, &good}, {3, &noise}}) {
    Eigen::MatrixXd& distances = set.distances[static_cast<std::size_t>(cue)];
    distances.resize(kViews, kViews);
    for (int i = 0; i < kViews; ++i)
      for (int j = 0; j < kViews; ++j)
        distances(i, j) = ((*points)[i] - (*points)[j]).squaredNorm() / 3;
  }
  return set;
}

PlaceTrainingSet draw_training_set(std::uint64_t seed) {
  Random random(seed);
  return draw_training_set(random, {0, 1, 2});
}

/// Distances from one view of a set to all.
std::array<Eigen::VectorXd, kClassifierCues> distances_of(const PlaceTrainingSet& set, int view) {
  std::array<Eigen::VectorXd, kClassifierCues> distances;
  for (std::size_t m = 0; m < distances.size(); ++m)
    if (set.distances[m].size() > 0) distances[m] = set.distances[m].col(view);
  return distances;
}

TEST(KernelOf, IsTheProductOfTheCuesKernelsToTheirShares) {
  const PlaceTrainingSet set = draw_training_set(1);
  PerCue weights{};
  weights[1] = 1, weights[3] = 0.5;
  const Eigen::MatrixXd kernel = kernel_of(set, weights);
  for (int i = 0; i < kViews; ++i) {
    EXPECT_DOUBLE_EQ(kernel(i, i), 1);
    for (int j = 0; j < kViews; ++j)
      EXPECT_NEAR(kernel(i, j),
                  std::pow(std::exp(-set.distances[1](i, j)), 2.0 / 3) *
                      std::pow(std::exp(-set.distances[3](i, j)), 1.0 / 3),
                  1e-12);
    EXPECT_NEAR((kernel_of(distances_of(set, i), weights) - kernel.col(i)).norm(), 0, 1e-12);
  }
  PerCue doubled = weights;
  for (double& weight : doubled) weight *= 2;
  EXPECT_NEAR((kernel_of(set, doubled) - kernel).norm(), 0, 1e-12);
}

TEST(SplitFold, PutsEveryViewOnOneSide) {
  const PlaceTrainingSet set = draw_training_set(2);
  for (int fold = -1; fold < kFolds; ++fold) {
    const FoldSplit split = split_fold(set, fold);
    EXPECT_EQ(split.in.size() + split.out.size(), static_cast<std::size_t>(kViews));
    for (const Eigen::Index i : split.out) EXPECT_EQ(set.fold[i], fold);
    for (const Eigen::Index i : split.in) EXPECT_NE(set.fold[i], fold);
  }
  EXPECT_TRUE(split_fold(set, -1).out.empty());
}

TEST(LeftOutOutputs, AreThoseOfMachinesThatNeverMetTheFold) {
  PlaceTrainingSet set = draw_training_set(3);
  PerCue weights{};
  weights[1] = 1;
  const Eigen::MatrixXd kernel = kernel_of(set, weights);
  const PlaceClassifierOptions options{.ridge = 0.05, .folds = kFolds};
  const Eigen::MatrixXd outputs = left_out_outputs(set, kernel, options);
  // One view by hand: the dense system of the others.
  constexpr int kView = 7;
  const std::vector<Eigen::Index> in = split_fold(set, set.fold[kView]).in;
  const auto n = static_cast<Eigen::Index>(in.size());
  Eigen::MatrixXd system(n, n), targets(n, kPlaces);
  Eigen::VectorXd row(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j)
      system(i, j) = kernel(in[i], in[j]) + (i == j ? options.ridge : 0);
    for (int place = 0; place < kPlaces; ++place)
      targets(i, place) = set.labels[in[i]] == place ? 1 : -1;
    row[i] = kernel(kView, in[i]);
  }
  const Eigen::VectorXd by_hand = (system.inverse() * targets).transpose() * row;
  EXPECT_NEAR((outputs.row(kView).transpose() - by_hand).norm(), 0, 1e-9);
  // Other labels in the fold change the outputs for all other views, but not for the fold.
  for (int i = 0; i < kViews; ++i)
    if (set.fold[i] == 2) set.labels[i] = (set.labels[i] + 1) % kPlaces;
  const Eigen::MatrixXd changed = left_out_outputs(set, kernel, options);
  for (int i = 0; i < kViews; ++i)
    EXPECT_EQ((changed.row(i) - outputs.row(i)).norm() == 0, set.fold[i] == 2) << i;
}

TEST(BestKernelWeights, HaveTheLeastErrorOfAll) {
  for (const std::uint64_t seed : {4, 5, 6}) {
    const PlaceTrainingSet set = draw_training_set(seed);
    const PlaceClassifierOptions options{.folds = kFolds};
    const auto error_of = [&](const PerCue& weights) {
      return (left_out_outputs(set, kernel_of(set, weights), options) - targets_of(set))
          .squaredNorm();
    };
    const PerCue best = best_kernel_weights(set, options);
    EXPECT_EQ(best[0] + best[2] + best[4], 0);  // these cues are missing
    EXPECT_EQ(*std::max_element(best.begin(), best.end()), 1);
    for (const auto& [one, other] :
         {std::pair{1.0, 0.0}, {1.0, 0.5}, {1.0, 1.0}, {0.5, 1.0}, {0.0, 1.0}}) {
      PerCue weights{};
      weights[1] = one, weights[3] = other;
      EXPECT_LE(error_of(best), error_of(weights) + 1e-12);
    }
  }
}

TEST(PlaceMachines, DoNotCareForTheNumbersOfThePlaces) {
  for (const PlaceMachineKind kind :
       {PlaceMachineKind::kKernel, PlaceMachineKind::kSvm, PlaceMachineKind::kAdaboost}) {
    Random random(7), same(7);
    const std::vector<int> numbers = {2, 0, 1};
    const PlaceTrainingSet set = draw_training_set(random, {0, 1, 2}),
                           other = draw_training_set(same, numbers);
    const PlaceClassifierOptions options{.machine = kind, .folds = kFolds, .rounds = 10};
    const TrainedPlaceMachine trained = train_place_machine(set, options),
                              renamed = train_place_machine(other, options);
    EXPECT_EQ(trained.weights, renamed.weights);
    EXPECT_EQ(*std::max_element(trained.weights.begin(), trained.weights.end()), 1);
    int right = 0;
    for (int view = 0; view < kViews; ++view) {
      const Eigen::VectorXd outputs = trained.machine->outputs(distances_of(set, view)),
                            again = renamed.machine->outputs(distances_of(other, view));
      for (int place = 0; place < kPlaces; ++place) {
        EXPECT_NEAR(outputs[place], again[numbers[place]], 1e-6);
        EXPECT_NEAR(trained.left_out(view, place), renamed.left_out(view, numbers[place]), 1e-6);
      }
      Eigen::Index best = 0;
      outputs.maxCoeff(&best);
      right += best == set.labels[view];
    }
    EXPECT_GE(right, kViews - 2) << static_cast<int>(kind);  // places three deviations apart
  }
}

TEST(BoostedMachine, CastsVotesOfAtMostOne) {
  const PlaceTrainingSet set = draw_training_set(8);
  const TrainedPlaceMachine trained = train_boosted_machine(set, {.folds = kFolds, .rounds = 7});
  EXPECT_LE(trained.left_out.cwiseAbs().maxCoeff(), 1 + 1e-12);
  for (int view = 0; view < kViews; ++view)
    EXPECT_LE(trained.machine->outputs(distances_of(set, view)).cwiseAbs().maxCoeff(), 1 + 1e-12);
}

TEST(SupportVectors, AreSureOfAFoldThatHoldsTheOnlyViewsOfAPlace) {
  // Without its fold place 2 has no view: the machine for it says -1 whatever it is shown.
  PlaceTrainingSet set = draw_training_set(9);
  for (int i = 0; i < kViews; ++i) set.fold[i] = set.labels[i] == 2 ? 0 : 1 + i % 2;
  const TrainedPlaceMachine trained = train_support_vectors(set, {.folds = 3});
  for (int i = 0; i < kViews; ++i)
    EXPECT_TRUE(set.labels[i] != 2 || trained.left_out(i, 2) == -1) << i;
}

}  // namespace kernel_machine_test
}  // namespace placegraph
