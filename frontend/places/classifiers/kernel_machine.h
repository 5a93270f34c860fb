#pragma once
#include <placegraph/frontend/places/classifiers/place_machine.h>

namespace placegraph {

/// Kernel exp(-sum_m w_m d_m^2 / sum_m w_m) between all pairs of views of the training set.
Eigen::MatrixXd kernel_of(const PlaceTrainingSet& training_set, const PerCue& weights);
/// Kernel between another view and the views of the training set.
Eigen::VectorXd kernel_of(const std::array<Eigen::VectorXd, kClassifierCues>& distances,
                          const PerCue& weights);

/// Targets, views x places: +1 for the place of a view, -1 for all others.
Eigen::MatrixXd targets_of(const PlaceTrainingSet& training_set);

/// Views in a fold, and all other views.
struct FoldSplit {
  std::vector<Eigen::Index> in, out;
};
FoldSplit split_fold(const PlaceTrainingSet& training_set, int fold);

/// Coefficients of least-squares machines.
Eigen::MatrixXd solve_kernel(Eigen::MatrixXd kernel, const Eigen::MatrixXd& targets, double ridge);

/// Outputs of least-squares machines for the views of the fold that their training left out.
Eigen::MatrixXd left_out_outputs(const PlaceTrainingSet& training_set,
                                 const Eigen::MatrixXd& kernel,
                                 const PlaceClassifierOptions& options);

/// Weights of {0, 1/2, 1} per cue with the least squared error on the left-out folds.
PerCue best_kernel_weights(const PlaceTrainingSet& training_set,
                           const PlaceClassifierOptions& options);

}  // namespace placegraph
