#include <placegraph/frontend/labels/training/model_growth.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>

namespace placegraph {
namespace {

/// Converts a forest of `base.classes` classes to one of `classes`. Features from `context_begin`
/// on are groups with one per class, whose positions change.
DecisionForest widened(const DecisionForest& base, int classes, int context_begin) {
  DecisionForest forest = base;
  forest.classes = classes;
  const int before = base.classes;
  if (base.dimension > context_begin)
    forest.dimension = context_begin + (base.dimension - context_begin) / before * classes;
  for (DecisionForest::Node& node : forest.nodes) {
    if (node.feature == DecisionForest::kLeaf || node.feature < context_begin) continue;
    const int at = node.feature - context_begin;
    node.feature = static_cast<std::uint16_t>(context_begin + at / before * classes + at % before);
  }
  forest.leaves.clear();
  for (std::size_t at = 0; at < base.leaves.size(); at += static_cast<std::size_t>(before)) {
    const auto begin = base.leaves.begin() + static_cast<std::ptrdiff_t>(at);
    forest.leaves.insert(forest.leaves.end(), begin, begin + before);
    forest.leaves.insert(forest.leaves.end(), static_cast<std::size_t>(classes - before), 0);
  }
  return forest;
}

void append(DecisionForest& forest, const DecisionForest& more) {
  require(forest.dimension == more.dimension && forest.classes == more.classes,
          "keep_trees: the model to keep has other features");
  const auto nodes = static_cast<std::uint32_t>(forest.nodes.size());
  const auto leaves =
      static_cast<std::uint32_t>(forest.leaves.size() / static_cast<std::size_t>(forest.classes));
  for (const std::uint32_t root : more.roots) forest.roots.push_back(root + nodes);
  for (DecisionForest::Node node : more.nodes) {
    node.other += node.feature == DecisionForest::kLeaf ? leaves : nodes;
    forest.nodes.push_back(node);
  }
  forest.leaves.insert(forest.leaves.end(), more.leaves.begin(), more.leaves.end());
}

}  // namespace

void keep_trees(const SceneModel& base, SceneModel& model) {
  require(base.kind == model.kind && base.classes.size() <= model.classes.size() &&
              std::equal(base.classes.begin(), base.classes.end(), model.classes.begin()),
          "keep_trees: the model to keep has other classes");
  const int classes = model.class_count(), features = model.first.dimension;
  DecisionForest first = widened(base.first, classes, features);
  DecisionForest second = widened(base.second, classes, features);
  append(first, model.first);
  append(second, model.second);
  model.first = std::move(first);
  model.second = std::move(second);
}

}  // namespace placegraph
