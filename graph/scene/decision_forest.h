#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Decision trees over features of one byte, with a distribution over classes in every leaf.
/// The prediction of a forest is the mean of its trees' distributions (Breiman 2001).
struct DecisionForest {
  static constexpr std::uint16_t kLeaf = 0xffff;  ///< the feature of a leaf
  /// A node of a tree: an inner node compares one feature, a leaf has a distribution.
  /// Descent goes to the next node if row[feature] <= threshold, else to node `other`.
  struct Node {
    std::uint16_t feature = kLeaf;  ///< position in the row; kLeaf: this is a leaf
    std::uint16_t threshold = 0;    ///< compared with the feature
    std::uint32_t other = 0;        ///< position in `nodes`; for a leaf its number
  };
  int classes = 0, dimension = 0;    ///< sizes of a distribution and of a row of features
  std::vector<std::uint32_t> roots;  ///< positions in `nodes`, one for each tree
  std::vector<Node> nodes;           ///< nodes of all trees
  std::vector<std::uint8_t> leaves;  ///< leaf x classes, row by row; 255 is a probability of 1

  /// The distribution of the leaf that a row falls into in the tree at `root`: `classes` bytes.
  /// The forest must be sound, see problem().
  const std::uint8_t* leaf_of(std::uint32_t root, const std::uint8_t* row) const {
    const Node* node = &nodes[root];
    while (node->feature != kLeaf)
      node = row[node->feature] <= node->threshold ? node + 1 : &nodes[node->other];
    return leaves.data() +
           static_cast<std::size_t>(node->other) * static_cast<std::size_t>(classes);
  }

  /// Writes the mean of the trees' distributions to `shares`: one for each class, sum 1.
  /// The forest must be sound, see problem(). `row` has `dimension` features.
  void predict(const std::uint8_t* row, float* shares) const;

  /// A short description of a fault that makes descent unsafe; nothing if there is none.
  /// Faults are a node that leads back or outside, and sizes that do not agree.
  std::optional<std::string> problem() const;
};

}  // namespace placegraph
