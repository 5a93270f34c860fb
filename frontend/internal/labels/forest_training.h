#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/scene/decision_forest.h>

#include <cstdint>
#include <vector>

namespace placegraph {

/// What a forest learns from: rows of bytes with a class and a weight. Rows of one `block` are
/// alike (neighbouring pictures of a drive): a tree takes all or none of them.
struct ForestTrainingSet {
  static constexpr std::uint8_t kVoid = 255;  ///< as label: judged, not learned from
  int classes = 0, blocks = 0;
  std::vector<std::vector<std::uint8_t>>
      columns;  ///< one a feature, each as long as there are rows
  std::vector<std::uint8_t> label;
  std::vector<float> weight;
  std::vector<std::int32_t> block;
  int rows() const { return static_cast<int>(label.size()); }
  int dimension() const { return static_cast<int>(columns.size()); }
};

struct ForestOptions {
  int trees = 50;
  int max_depth = 18;
  int min_leaf = 15;           ///< rows
  int tries = 40;              ///< features looked at for a split
  double share_blocks = 0.66;  ///< of the blocks, taken by a tree
  double share_rows = 0.2;     ///< of their rows
  std::uint64_t seed = 1;
  void check() const;
};
void visit(OptionVisitor& field, ForestOptions& options);

struct TrainedForest {
  DecisionForest forest;
  /// What the trees that did not see a row's block say of it, rows x classes; the classes' shares
  /// where all saw it.
  std::vector<float> unseen;
};

/// Learns trees by the Gini impurity, each from blocks and rows drawn for it. The same bits for any
/// number of threads. Throws ArgumentError if the sizes do not agree or there is nothing to learn.
TrainedForest train_forest(const ForestTrainingSet& training_set, const ForestOptions& options,
                           int threads);

}  // namespace placegraph
