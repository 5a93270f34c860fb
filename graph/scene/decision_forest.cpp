#include <placegraph/graph/scene/decision_forest.h>

#include <algorithm>

namespace placegraph {

void DecisionForest::predict(const std::uint8_t* row, float* shares) const {
  const auto n = static_cast<std::size_t>(classes);
  std::fill_n(shares, n, 0.0f);
  for (const std::uint32_t root : roots) {
    const std::uint8_t* leaf = leaf_of(root, row);
    for (std::size_t c = 0; c < n; ++c) shares[c] += leaf[c];
  }
  float sum = 0;
  for (std::size_t c = 0; c < n; ++c) sum += shares[c];
  for (std::size_t c = 0; c < n; ++c)
    shares[c] = sum > 0 ? shares[c] / sum : 1.0f / static_cast<float>(n);
}

std::optional<std::string> DecisionForest::problem() const {
  if (classes < 1 || dimension < 1 || roots.empty()) return "no classes, no features or no tree";
  const auto n = static_cast<std::size_t>(classes);
  if (leaves.size() % n != 0) return "the leaves do not fit the number of classes";
  for (const std::uint32_t root : roots)
    if (root >= nodes.size()) return "a tree without a root";
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Node& node = nodes[i];
    if (node.feature == kLeaf) {
      if (node.other >= leaves.size() / n)
        return "node " + std::to_string(i) + ": its leaf does not exist";
    } else if (node.feature >= dimension || node.other <= i + 1 || node.other >= nodes.size()) {
      return "node " + std::to_string(i) + " leads back or outside the tree";
    }
  }
  return std::nullopt;
}

}  // namespace placegraph
