#include <placegraph/frontend/places/float_vocabulary.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <numeric>
#include <opencv2/core.hpp>

namespace placegraph {
namespace {

using Rows = std::vector<int>;

struct Cluster {
  Eigen::RowVectorXf centre;
  Rows members;
};

/// k-means uses OpenCV's random generator of this thread: this object seeds it and restores its
/// state.
class SeededKMeans {
 public:
  explicit SeededKMeans(Random& random) : before_(cv::theRNG().state) {
    cv::theRNG().state = static_cast<std::uint64_t>(random.next()) << 32 | (random.next() | 1u);
  }
  ~SeededKMeans() { cv::theRNG().state = before_; }
  SeededKMeans(const SeededKMeans&) = delete;
  SeededKMeans& operator=(const SeededKMeans&) = delete;

 private:
  std::uint64_t before_;
};

/// Splits `members` into at most `k` non-empty clusters.
std::vector<Cluster> cluster(const FloatDescriptors& descriptors, const Rows& members,
                             const VocabularyOptions& options, Random& random) {
  const int k = std::min(options.branching, static_cast<int>(members.size()));
  const auto columns = static_cast<int>(descriptors.cols());
  cv::Mat samples(static_cast<int>(members.size()), columns, CV_32F), labels, centres;
  for (int i = 0; i < samples.rows; ++i)
    std::copy_n(descriptors.row(members[static_cast<std::size_t>(i)]).data(), columns,
                samples.ptr<float>(i));
  const SeededKMeans seeded(random);
  cv::kmeans(samples, k, labels, {cv::TermCriteria::COUNT, options.iterations, 0}, 1,
             cv::KMEANS_PP_CENTERS, centres);
  std::vector<Cluster> clusters(static_cast<std::size_t>(k));
  for (int c = 0; c < k; ++c)
    clusters[static_cast<std::size_t>(c)].centre =
        Eigen::Map<const Eigen::RowVectorXf>(centres.ptr<float>(c), columns);
  for (int i = 0; i < samples.rows; ++i)
    clusters[static_cast<std::size_t>(labels.at<int>(i))].members.push_back(
        members[static_cast<std::size_t>(i)]);
  std::erase_if(clusters, [](const Cluster& c) { return c.members.empty(); });
  return clusters;
}

bool all_equal(const FloatDescriptors& descriptors, const Rows& members) {
  return std::all_of(members.begin(), members.end(),
                     [&](int i) { return descriptors.row(i) == descriptors.row(members.front()); });
}

}  // namespace

FloatVocabulary::FloatVocabulary(WordTree tree) : tree_(std::move(tree)) {
  require(tree_.kind == WordTree::Kind::kFloat, "FloatVocabulary: its words are not vectors");
  const auto problem = tree_.problem();
  require(!problem, "FloatVocabulary: " + problem.value_or(""));
}

FloatVocabulary FloatVocabulary::train(const FloatDescriptors& descriptors,
                                       const VocabularyOptions& options, Random& random) {
  options.check();
  require(descriptors.rows() > 0, "FloatVocabulary::train: no descriptors");
  FloatVocabulary vocabulary;
  WordTree& tree = vocabulary.tree_;
  tree.kind = WordTree::Kind::kFloat;
  tree.dimension = static_cast<int>(descriptors.cols());
  const auto add_node = [&](const Eigen::RowVectorXf& centre) {
    tree.nodes.emplace_back();
    tree.centres.insert(tree.centres.end(), centre.begin(), centre.end());
  };
  add_node(Eigen::RowVectorXf::Zero(descriptors.cols()));
  struct Work {
    std::size_t node;
    int depth;
    Rows members;
  };
  Rows all(static_cast<std::size_t>(descriptors.rows()));
  std::iota(all.begin(), all.end(), 0);
  std::vector<Work> queue{{0, 0, std::move(all)}};
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const Work work = std::move(queue[next]);
    if (work.depth == options.depth || all_equal(descriptors, work.members)) {
      tree.nodes[work.node].word = tree.words++;
      continue;
    }
    std::vector<Cluster> clusters = cluster(descriptors, work.members, options, random);
    tree.nodes[work.node].first_child = static_cast<int>(tree.nodes.size());
    tree.nodes[work.node].children = static_cast<int>(clusters.size());
    for (Cluster& part : clusters) {
      queue.push_back({tree.nodes.size(), work.depth + 1, std::move(part.members)});
      add_node(part.centre);
    }
  }
  tree.idf.assign(static_cast<std::size_t>(tree.words), 1);
  return vocabulary;
}

void FloatVocabulary::set_idf(std::vector<float> idf) {
  require(idf.size() == static_cast<std::size_t>(words()),
          "FloatVocabulary: needs one idf per word");
  tree_.idf = std::move(idf);
}

Eigen::Map<const FloatDescriptors> FloatVocabulary::children(const WordTree::Node& node) const {
  return {tree_.centres.data() + static_cast<std::ptrdiff_t>(node.first_child) * tree_.dimension,
          node.children, tree_.dimension};
}

std::uint32_t FloatVocabulary::word(const Eigen::Ref<const Eigen::RowVectorXf>& descriptor) const {
  require(!empty() && descriptor.size() == dimension(),
          "FloatVocabulary: not trained, or trained on descriptors of another length");
  const WordTree::Node* node = &tree_.nodes.front();
  while (node->word < 0) {
    Eigen::Index best = 0;
    (children(*node).rowwise() - descriptor).rowwise().squaredNorm().minCoeff(&best);
    node = &tree_.nodes[static_cast<std::size_t>(node->first_child + best)];
  }
  return static_cast<std::uint32_t>(node->word);
}

FloatDescriptors FloatVocabulary::centres(int most) const {
  require(!empty(), "FloatVocabulary: not trained");
  std::vector<std::size_t> level = {0};
  for (;;) {
    std::vector<std::size_t> below;
    bool deeper = false;
    for (const std::size_t i : level) {
      const WordTree::Node& node = tree_.nodes[i];
      deeper = deeper || node.children > 0;
      if (node.children == 0) below.push_back(i);
      for (int child = 0; child < node.children; ++child)
        below.push_back(static_cast<std::size_t>(node.first_child + child));
    }
    const bool first = level.size() == 1 && level.front() == 0;
    if (!deeper || (!first && below.size() > static_cast<std::size_t>(most))) break;
    level = std::move(below);
  }
  FloatDescriptors result(static_cast<Eigen::Index>(level.size()), dimension());
  for (std::size_t row = 0; row < level.size(); ++row)
    result.row(static_cast<Eigen::Index>(row)) = Eigen::Map<const Eigen::RowVectorXf>(
        tree_.centres.data() + level[row] * static_cast<std::size_t>(dimension()), dimension());
  return result;
}

}  // namespace placegraph
