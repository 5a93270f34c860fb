#include <placegraph/graph/core/function_clones.h>
#include <placegraph/graph/measurements/landmark.h>

#include <bit>

namespace placegraph {

PLACEGRAPH_COUNTS_BITS
int hamming_distance(const BinaryDescriptor& a, const BinaryDescriptor& b) {
  int bits = 0;
  for (std::size_t i = 0; i < a.size(); ++i) bits += std::popcount(a[i] ^ b[i]);
  return bits;
}

PLACEGRAPH_COUNTS_BITS
void hamming_distances(const BinaryDescriptor& from, const std::vector<BinaryDescriptor>& to,
                       std::vector<int>& distances) {
  distances.resize(to.size());
  for (std::size_t j = 0; j < to.size(); ++j) {
    int bits = 0;
    for (std::size_t i = 0; i < from.size(); ++i) bits += std::popcount(from[i] ^ to[j][i]);
    distances[j] = bits;
  }
}

}  // namespace placegraph
