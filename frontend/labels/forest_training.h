#pragma once
#include <placegraph/graph/core/options.h>
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

struct ForestOptions {
  int trees = 50;
  int max_depth = 18;
  int min_leaf = 15;           ///< minimum number of rows of a leaf
  int tries = 40;              ///< number of features tried for a split
  double share_blocks = 0.66;  ///< share of the blocks that a tree uses
  double share_rows = 0.2;     ///< share of the rows of its blocks that a tree uses
  std::uint64_t seed = 1;
  void check() const;
};
void visit(OptionVisitor& field, ForestOptions& options);

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
