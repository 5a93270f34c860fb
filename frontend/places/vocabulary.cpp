#include <placegraph/frontend/places/vocabulary.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <bit>
#include <numeric>

namespace placegraph {
namespace {

using Indices = std::vector<int>;

/// Bitwise majority; ties go to zero.
BinaryDescriptor majority(const std::vector<BinaryDescriptor>& descriptors,
                          const Indices& members) {
  std::array<int, 256> ones{};
  for (int i : members)
    for (int word = 0; word < 4; ++word)
      for (std::uint64_t bits = descriptors[i][word]; bits; bits &= bits - 1)
        ++ones[64 * word + std::countr_zero(bits)];
  BinaryDescriptor centre{};
  for (int bit = 0; bit < 256; ++bit)
    if (2 * ones[bit] > static_cast<int>(members.size()))
      centre[bit / 64] |= std::uint64_t{1} << (bit % 64);
  return centre;
}

int nearest(const std::vector<BinaryDescriptor>& centres, const BinaryDescriptor& d) {
  int best = 0, best_distance = 257;
  for (int c = 0; c < static_cast<int>(centres.size()); ++c) {
    const int distance = hamming_distance(centres[c], d);
    if (distance < best_distance) {
      best_distance = distance;
      best = c;
    }
  }
  return best;
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
  for (int iteration = 0; iteration <= iterations; ++iteration) {
    groups.assign(centres.size(), {});
    for (int i : members) groups[nearest(centres, descriptors[i])].push_back(i);
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

void VocabularyOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, VocabularyOptions& o) {
  field("branching", o.branching, "children of a tree node", {2, 64});
  field("depth", o.depth, "levels of the tree", {1, 6});
  field("iterations", o.iterations, "k-majority rounds per node", {1, 100});
}

Vocabulary Vocabulary::train(const std::vector<BinaryDescriptor>& descriptors,
                             const VocabularyOptions& options, Random& random) {
  options.check();
  require(!descriptors.empty(), "Vocabulary::train: no descriptors");
  Vocabulary vocabulary;
  vocabulary.nodes_.emplace_back();
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
      vocabulary.nodes_[work.node].word = vocabulary.words_++;
      continue;
    }
    auto clusters =
        cluster(descriptors, work.members, options.branching, options.iterations, random);
    if (clusters.size() == 1) {  // all alike
      vocabulary.nodes_[work.node].word = vocabulary.words_++;
      continue;
    }
    vocabulary.nodes_[work.node].first_child = static_cast<int>(vocabulary.nodes_.size());
    vocabulary.nodes_[work.node].children = static_cast<int>(clusters.size());
    for (auto& [centre, members] : clusters) {
      queue.push_back(
          {static_cast<int>(vocabulary.nodes_.size()), work.depth + 1, std::move(members)});
      vocabulary.nodes_.emplace_back().centre = centre;
    }
  }
  return vocabulary;
}

std::uint32_t Vocabulary::word(const BinaryDescriptor& descriptor) const {
  require(!nodes_.empty(), "Vocabulary::word: not trained");
  int node = 0;
  while (nodes_[node].word < 0) {
    const int first = nodes_[node].first_child;
    int best = first, best_distance = 257;
    for (int child = first; child < first + nodes_[node].children; ++child) {
      const int distance = hamming_distance(nodes_[child].centre, descriptor);
      if (distance < best_distance) {
        best_distance = distance;
        best = child;
      }
    }
    node = best;
  }
  return static_cast<std::uint32_t>(nodes_[node].word);
}

}  // namespace placegraph
