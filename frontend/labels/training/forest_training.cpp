#include <placegraph/frontend/labels/training/forest_training.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace placegraph {

namespace {

constexpr int kMostClasses = 64;

struct Split {
  int feature = -1, threshold = 0;
  double gain = 0;
};

/// Training of one tree.
class Grower {
 public:
  Grower(const ForestTrainingSet& training_set, const ForestOptions& options, std::uint64_t stream)
      : training_set_(training_set),
        options_(options),
        random_(options.seed, stream),
        n_(static_cast<std::size_t>(training_set.classes)),
        histogram_(256 * n_),
        filled_(256) {}

  DecisionForest grow() {
    draw_rows();
    tree_.classes = training_set_.classes;
    tree_.dimension = training_set_.dimension();
    tree_.roots = {0};
    if (rows_.empty()) add_any_row();
    grow_node(0, rows_.size(), 0);
    return std::move(tree_);
  }
  const std::vector<char>& taken() const { return taken_; }

 private:
  void draw_rows() {
    taken_.resize(static_cast<std::size_t>(training_set_.blocks));
    for (char& taken : taken_) taken = random_.uniform() < options_.share_blocks ? 1 : 0;
    for (int i = 0; i < training_set_.rows(); ++i)
      if (training_set_.label[static_cast<std::size_t>(i)] != ForestTrainingSet::kVoid &&
          taken_[static_cast<std::size_t>(training_set_.block[static_cast<std::size_t>(i)])] &&
          random_.uniform() < options_.share_rows)
        rows_.push_back(static_cast<std::uint32_t>(i));
  }

  // Adds a leaf with the class of one row to a tree without any blocks.
  void add_any_row() {
    for (std::size_t i = 0; i < training_set_.label.size() && rows_.empty(); ++i)
      if (training_set_.label[i] != ForestTrainingSet::kVoid)
        rows_.push_back(static_cast<std::uint32_t>(i));
  }

  void grow_node(std::size_t begin, std::size_t end, int depth) {
    const std::size_t self = tree_.nodes.size();
    tree_.nodes.emplace_back();
    std::array<double, kMostClasses> sums{};
    for (std::size_t i = begin; i < end; ++i)
      sums[training_set_.label[rows_[i]]] += training_set_.weight[rows_[i]];
    const bool pure = std::count_if(sums.begin(), sums.end(), [](double s) { return s > 0; }) <= 1;
    Split split;
    if (!pure && depth < options_.max_depth &&
        end - begin >= 2 * static_cast<std::size_t>(options_.min_leaf))
      split = best_split(begin, end, sums);
    if (split.feature < 0) {
      make_leaf(self, sums);
      return;
    }
    const std::vector<std::uint8_t>& column =
        training_set_.columns[static_cast<std::size_t>(split.feature)];
    const auto middle =
        std::partition(rows_.begin() + static_cast<std::ptrdiff_t>(begin),
                       rows_.begin() + static_cast<std::ptrdiff_t>(end),
                       [&](std::uint32_t row) { return column[row] <= split.threshold; });
    const auto cut = static_cast<std::size_t>(middle - rows_.begin());
    grow_node(begin, cut, depth + 1);
    tree_.nodes[self] = {static_cast<std::uint16_t>(split.feature),
                         static_cast<std::uint16_t>(split.threshold),
                         static_cast<std::uint32_t>(tree_.nodes.size())};
    grow_node(cut, end, depth + 1);
  }

  void make_leaf(std::size_t self, const std::array<double, kMostClasses>& sums) {
    double sum = 0;
    for (std::size_t c = 0; c < n_; ++c) sum += sums[c];
    tree_.nodes[self] = {DecisionForest::kLeaf, 0,
                         static_cast<std::uint32_t>(tree_.leaves.size() / n_)};
    for (std::size_t c = 0; c < n_; ++c)
      tree_.leaves.push_back(static_cast<std::uint8_t>(sum > 0 ? 255 * sums[c] / sum + 0.5 : 0));
  }

  Split best_split(std::size_t begin, std::size_t end,
                   const std::array<double, kMostClasses>& sums) {
    Split best;
    double sum = 0, squares = 0;
    for (std::size_t c = 0; c < n_; ++c) sum += sums[c], squares += sums[c] * sums[c];
    best.gain = squares / sum + 1e-9 * sum;
    for (int i = 0; i < options_.tries; ++i)
      try_feature(random_.index(training_set_.dimension()), begin, end, sums, best);
    return best;
  }

  void try_feature(int feature, std::size_t begin, std::size_t end,
                   const std::array<double, kMostClasses>& sums, Split& best) {
    const std::vector<std::uint8_t>& column =
        training_set_.columns[static_cast<std::size_t>(feature)];
    int low = 255, high = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t row = rows_[i];
      const int value = column[row];
      low = std::min(low, value);
      high = std::max(high, value);
      ++filled_[static_cast<std::size_t>(value)];
      histogram_[static_cast<std::size_t>(value) * n_ + training_set_.label[row]] +=
          training_set_.weight[row];
    }
    std::array<double, kMostClasses> left{};
    double left_sum = 0, sum = 0;
    for (std::size_t c = 0; c < n_; ++c) sum += sums[c];
    std::size_t left_rows = 0;
    const std::size_t all = end - begin, least = static_cast<std::size_t>(options_.min_leaf);
    for (int t = low; t <= high; ++t) {
      const auto at = static_cast<std::size_t>(t);
      if (filled_[at] == 0) continue;
      float* bin = histogram_.data() + at * n_;
      left_rows += static_cast<std::size_t>(filled_[at]);
      double left_squares = 0, right_squares = 0;
      for (std::size_t c = 0; c < n_; ++c) {
        left[c] += static_cast<double>(bin[c]);
        left_sum += static_cast<double>(bin[c]);
        bin[c] = 0;
        left_squares += left[c] * left[c];
        right_squares += (sums[c] - left[c]) * (sums[c] - left[c]);
      }
      filled_[at] = 0;
      if (left_rows < least || all - left_rows < least || t == high) continue;
      const double gain = left_squares / left_sum + right_squares / (sum - left_sum);
      if (gain > best.gain) best = {feature, t, gain};
    }
  }

  const ForestTrainingSet& training_set_;
  const ForestOptions& options_;
  Random random_;
  std::size_t n_;
  std::vector<float> histogram_;
  std::vector<int> filled_;
  std::vector<std::uint32_t> rows_;
  std::vector<char> taken_;
  DecisionForest tree_;
};

/// Leaf of a row that is stored in columns.
const std::uint8_t* leaf_of(const DecisionForest& tree, const ForestTrainingSet& training_set,
                            std::size_t row) {
  const DecisionForest::Node* node = tree.nodes.data();
  while (node->feature != DecisionForest::kLeaf)
    node = training_set.columns[node->feature][row] <= node->threshold ? node + 1
                                                                       : &tree.nodes[node->other];
  return tree.leaves.data() +
         static_cast<std::size_t>(node->other) * static_cast<std::size_t>(tree.classes);
}

void append_tree(DecisionForest& forest, const DecisionForest& tree) {
  const auto node_offset = static_cast<std::uint32_t>(forest.nodes.size());
  const auto leaf_offset =
      static_cast<std::uint32_t>(forest.leaves.size() / static_cast<std::size_t>(forest.classes));
  forest.roots.push_back(node_offset);
  for (DecisionForest::Node node : tree.nodes) {
    node.other += node.feature == DecisionForest::kLeaf ? leaf_offset : node_offset;
    forest.nodes.push_back(node);
  }
  forest.leaves.insert(forest.leaves.end(), tree.leaves.begin(), tree.leaves.end());
}

/// Sums of the predictions of the trees that did not use a row, normalized to shares.
std::vector<float> judge_unseen(const ForestTrainingSet& training_set,
                                const std::vector<DecisionForest>& trees,
                                const std::vector<std::vector<char>>& taken, int threads) {
  const auto n = static_cast<std::size_t>(training_set.classes);
  std::vector<float> unseen(training_set.label.size() * n, 0.0f);
  std::vector<double> prior(n, 0.0);
  double all = 0;
  for (std::size_t i = 0; i < training_set.label.size(); ++i)
    if (training_set.label[i] != ForestTrainingSet::kVoid)
      prior[training_set.label[i]] += static_cast<double>(training_set.weight[i]),
          all += static_cast<double>(training_set.weight[i]);
  constexpr std::size_t kPart = 4096;
  const int parts = static_cast<int>((training_set.label.size() + kPart - 1) / kPart);
  parallel_for(parts, threads, [&](int part) {
    const std::size_t begin = static_cast<std::size_t>(part) * kPart;
    const std::size_t end = std::min(begin + kPart, training_set.label.size());
    for (std::size_t t = 0; t < trees.size(); ++t)
      for (std::size_t i = begin; i < end; ++i) {
        if (taken[t][static_cast<std::size_t>(training_set.block[i])]) continue;
        const std::uint8_t* leaf = leaf_of(trees[t], training_set, i);
        for (std::size_t c = 0; c < n; ++c) unseen[i * n + c] += leaf[c];
      }
    for (std::size_t i = begin; i < end; ++i) {
      float sum = 0;
      for (std::size_t c = 0; c < n; ++c) sum += unseen[i * n + c];
      for (std::size_t c = 0; c < n; ++c)
        unseen[i * n + c] = sum > 0 ? unseen[i * n + c] / sum : static_cast<float>(prior[c] / all);
    }
  });
  return unseen;
}

}  // namespace

TrainedForest train_forest(const ForestTrainingSet& training_set, const ForestOptions& options,
                           int threads) {
  options.check();
  const std::size_t rows = training_set.label.size();
  const auto learned =
      std::count_if(training_set.label.begin(), training_set.label.end(),
                    [](std::uint8_t label) { return label != ForestTrainingSet::kVoid; });
  require(learned > 0 && training_set.classes > 0 && training_set.classes <= kMostClasses &&
              training_set.blocks > 0,
          "train_forest: the training set is empty");
  require(training_set.weight.size() == rows && training_set.block.size() == rows &&
              training_set.dimension() > 0 && training_set.dimension() < DecisionForest::kLeaf,
          "train_forest: the sizes do not agree");
  for (const auto& column : training_set.columns)
    require(column.size() == rows, "train_forest: the sizes do not agree");
  std::vector<DecisionForest> trees(static_cast<std::size_t>(options.trees));
  std::vector<std::vector<char>> taken(trees.size());
  parallel_for(options.trees, threads, [&](int i) {
    Grower grower(training_set, options, static_cast<std::uint64_t>(i));
    trees[static_cast<std::size_t>(i)] = grower.grow();
    taken[static_cast<std::size_t>(i)] = grower.taken();
  });
  TrainedForest result;
  result.forest.classes = training_set.classes;
  result.forest.dimension = training_set.dimension();
  for (const DecisionForest& tree : trees) append_tree(result.forest, tree);
  result.unseen = judge_unseen(training_set, trees, taken, threads);
  return result;
}

}  // namespace placegraph
