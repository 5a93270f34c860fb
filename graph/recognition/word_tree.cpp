#include <placegraph/graph/recognition/word_tree.h>

#include <cmath>

namespace placegraph {
namespace {

std::string in_node(std::size_t node, const char* what) {
  return "node " + std::to_string(node) + " " + what;
}

bool all_finite(const std::vector<float>& values) {
  for (const float value : values)
    if (!std::isfinite(value)) return false;
  return true;
}

}  // namespace

std::optional<std::string> WordTree::problem() const {
  const std::size_t expected_bits = kind == Kind::kBinary ? nodes.size() : 0;
  const std::size_t expected_numbers =
      kind == Kind::kFloat ? nodes.size() * static_cast<std::size_t>(dimension) : 0;
  if (nodes.empty()) return "no root";
  if (bit_centres.size() != expected_bits || centres.size() != expected_numbers)
    return "not one centre per node";
  if (idf.size() != static_cast<std::size_t>(words)) return "not one weight per word";
  if (!all_finite(centres)) return "a centre is not finite";
  if (!all_finite(idf)) return "a weight is not finite";
  // Children follow their parents and each has one parent: no cycles, all are reached.
  std::vector<bool> has_parent(nodes.size(), false), seen(static_cast<std::size_t>(words), false);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Node& node = nodes[i];
    if (i > 0 && !has_parent[i]) return in_node(i, "has no parent");
    if (node.children == 0) {
      if (node.word < 0 || node.word >= words) return in_node(i, "is a leaf without a word");
      if (seen[static_cast<std::size_t>(node.word)]) return in_node(i, "has another's word");
      seen[static_cast<std::size_t>(node.word)] = true;
      continue;
    }
    const std::int64_t first = node.first_child;
    if (node.children < 0 || first <= static_cast<std::int64_t>(i) ||
        first + node.children > static_cast<std::int64_t>(nodes.size()))
      return in_node(i, "has children outside the tree");
    if (node.word >= 0) return in_node(i, "has children and a word");
    for (std::int64_t child = first; child < first + node.children; ++child) {
      if (has_parent[static_cast<std::size_t>(child)])
        return in_node(static_cast<std::size_t>(child), "has two parents");
      has_parent[static_cast<std::size_t>(child)] = true;
    }
  }
  for (const bool one : seen)
    if (!one) return "a word has no leaf";
  return {};
}

}  // namespace placegraph
