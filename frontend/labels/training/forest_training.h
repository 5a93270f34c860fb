#pragma once
#include <placegraph/frontend/labels/training/scene_training.h>
#include <placegraph/graph/scene/decision_forest.h>

#include <cstdint>
#include <vector>

namespace placegraph {

/// Training set of a forest: rows of bytes with a class and a weight.
///
/// Rows of one `block` are similar (neighbouring images of a drive): a tree uses all or none of
/// them.
struct ForestTrainingSet {
  /// Label of rows that are classified but not used for training.
  static constexpr std::uint8_t kVoid = 255;
  int classes = 0, blocks = 0;
  std::vector<std::vector<std::uint8_t>> columns;  ///< one per feature, each with one value per row
  std::vector<std::uint8_t> label;
  std::vector<float> weight;
  std::vector<std::int32_t> block;
  int rows() const { return static_cast<int>(label.size()); }
  int dimension() const { return static_cast<int>(columns.size()); }
};

struct TrainedForest {
  DecisionForest forest;
  /// Prediction for each row by the trees that did not use its block, rows x classes; the classes'
  /// shares for a row that all trees used.
  std::vector<float> unseen;
};

/// Trains trees by the Gini impurity, each with its own random blocks and rows.
///
/// The result has the same bits for any number of threads. Throws ArgumentError if the sizes do not
/// agree or the training set is empty.
TrainedForest train_forest(const ForestTrainingSet& training_set, const ForestOptions& options,
                           int threads);

}  // namespace placegraph
