#include <placegraph/frontend/places/vocabulary.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace placegraph {
namespace {

using Indices = std::vector<int>;

/// Bitwise majority; ties go to zero. All 64 bits of a word are counted at once: bit b of plane k
/// is bit k of the count of bit b.
BinaryDescriptor majority(const std::vector<BinaryDescriptor>& descriptors,
                          const Indices& members) {
  constexpr int kPlanes = 31;  // counts of an int
  BinaryDescriptor centre{};
  for (std::size_t word = 0; word < centre.size(); ++word) {
    std::array<std::uint64_t, kPlanes> planes{};
    for (const int i : members) {
      std::uint64_t carry = descriptors[i][word];
      for (int k = 0; carry; ++k) {
        const std::uint64_t sum = planes[k] ^ carry;
        carry &= planes[k];
        planes[k] = sum;
      }
    }
    for (int bit = 0; bit < 64; ++bit) {
      std::size_t ones = 0;
      for (int k = 0; k < kPlanes; ++k) ones |= (planes[k] >> bit & 1) << k;
      if (2 * ones > members.size()) centre[word] |= std::uint64_t{1} << bit;
    }
  }
  return centre;
}

int nearest(const std::vector<BinaryDescriptor>& centres, const BinaryDescriptor& d,
            std::vector<int>& distances) {
  hamming_distances(d, centres, distances);
  return static_cast<int>(std::min_element(distances.begin(), distances.end()) - distances.begin());
}

/// Splits `members` into at most `k` non-empty clusters.
std::vector<std::pair<BinaryDescriptor, Indices>> cluster(
    const std::vector<BinaryDescriptor>& descriptors, const Indices& members, int k, int iterations,
    Random& random) {
  std::vector<int> seeds;
  random.sample(static_cast<int>(members.size()), std::min<int>(k, members.size()), seeds);
  std::vector<BinaryDescriptor> centres;
  for (int seed : seeds) centres.push_back(descriptors[members[seed]]);
  std::vector<Indices> groups;
  std::vector<int> distances;
  for (int iteration = 0; iteration <= iterations; ++iteration) {
    groups.assign(centres.size(), {});
    for (int i : members) groups[nearest(centres, descriptors[i], distances)].push_back(i);
    if (iteration == iterations) break;
    std::vector<BinaryDescriptor> moved = centres;
    for (std::size_t c = 0; c < centres.size(); ++c)
      if (!groups[c].empty()) moved[c] = majority(descriptors, groups[c]);
    if (moved == centres) break;
    centres = std::move(moved);
  }
  std::vector<std::pair<BinaryDescriptor, Indices>> clusters;
  for (std::size_t c = 0; c < centres.size(); ++c)
    if (!groups[c].empty()) clusters.emplace_back(centres[c], std::move(groups[c]));
  return clusters;
}

}  // namespace

Vocabulary::Vocabulary(WordTree tree) : tree_(std::move(tree)) {
  require(tree_.kind == WordTree::Kind::kBinary, "Vocabulary: its words are not binary");
  const auto problem = tree_.problem();
  require(!problem, "Vocabulary: " + problem.value_or(""));
}

Vocabulary Vocabulary::train(const std::vector<BinaryDescriptor>& descriptors,
                             const VocabularyOptions& options, Random& random) {
  options.check();
  require(!descriptors.empty(), "Vocabulary::train: no descriptors");
  Vocabulary vocabulary;
  WordTree& tree = vocabulary.tree_;
  const auto add_node = [&](const BinaryDescriptor& centre) {
    tree.nodes.emplace_back();
    tree.bit_centres.push_back(centre);
  };
  add_node({});
  Indices all(descriptors.size());
  std::iota(all.begin(), all.end(), 0);
  struct Work {
    int node, depth;
    Indices members;
  };
  std::vector<Work> queue{{0, 0, std::move(all)}};
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const Work work = std::move(queue[next]);
    if (work.depth == options.depth || work.members.size() < 2) {
      tree.nodes[work.node].word = tree.words++;
      continue;
    }
    auto clusters =
        cluster(descriptors, work.members, options.branching, options.iterations, random);
    if (clusters.size() == 1) {  // all are equal
      tree.nodes[work.node].word = tree.words++;
      continue;
    }
    tree.nodes[work.node].first_child = static_cast<int>(tree.nodes.size());
    tree.nodes[work.node].children = static_cast<int>(clusters.size());
    for (auto& [centre, members] : clusters) {
      queue.push_back({static_cast<int>(tree.nodes.size()), work.depth + 1, std::move(members)});
      add_node(centre);
    }
  }
  tree.idf.assign(static_cast<std::size_t>(tree.words), 1);
  return vocabulary;
}

void Vocabulary::set_idf(std::vector<float> idf) {
  require(idf.size() == static_cast<std::size_t>(words()),
          "Vocabulary::set_idf: needs one idf per word");
  tree_.idf = std::move(idf);
}

std::uint32_t Vocabulary::word(const BinaryDescriptor& descriptor) const {
  require(!empty(), "Vocabulary::word: not trained");
  int node = 0;
  while (tree_.nodes[node].word < 0) {
    const int first = tree_.nodes[node].first_child;
    int best = first, best_distance = 257;
    for (int child = first; child < first + tree_.nodes[node].children; ++child) {
      const int distance = hamming_distance(tree_.bit_centres[child], descriptor);
      if (distance < best_distance) {
        best_distance = distance;
        best = child;
      }
    }
    node = best;
  }
  return static_cast<std::uint32_t>(tree_.nodes[node].word);
}

}  // namespace placegraph
