#pragma once
#include <placegraph/frontend/internal/places/classifiers/place_machine.h>

namespace placegraph {

/// exp(-sum_m w_m d_m^2 / sum_m w_m) of the lesson's views with each other.
Eigen::MatrixXd kernel_of(const PlaceTrainingSet& training_set, const PerCue& weights);
/// The same of another view with them.
Eigen::VectorXd kernel_of(const std::array<Eigen::VectorXd, kClassifierCues>& distances,
                          const PerCue& weights);

/// +1 for a view's place, -1 for the others; views x places.
Eigen::MatrixXd targets_of(const PlaceTrainingSet& training_set);

/// The views of a fold, and all others.
struct FoldSplit {
  std::vector<Eigen::Index> in, out;
};
FoldSplit split_fold(const PlaceTrainingSet& training_set, int fold);

/// Coefficients of least-squares machines.
Eigen::MatrixXd solve_kernel(Eigen::MatrixXd kernel, const Eigen::MatrixXd& targets, double ridge);

/// What least-squares machines trained without a fold say of it.
Eigen::MatrixXd left_out_outputs(const PlaceTrainingSet& training_set,
                                 const Eigen::MatrixXd& kernel,
                                 const PlaceClassifierOptions& options);

/// The weights of {0, 1/2, 1} per cue with the least squared error on left out folds.
PerCue best_kernel_weights(const PlaceTrainingSet& training_set,
                           const PlaceClassifierOptions& options);

}  // namespace placegraph
