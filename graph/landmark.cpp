#include <placegraph/graph/landmark.h>

#include <bit>

namespace placegraph {

int hamming_distance(const BinaryDescriptor& a, const BinaryDescriptor& b) {
  int bits = 0;
  for (std::size_t i = 0; i < a.size(); ++i) bits += std::popcount(a[i] ^ b[i]);
  return bits;
}

}  // namespace placegraph
