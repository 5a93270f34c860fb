#pragma once
#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// PCG32 (O'Neill 2014): small, seeded, the same numbers on every platform and library.
/// Streams of one seed are independent, so parallel work takes one stream per item.
class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0);
  /// The stream of one step of an algorithm for one item: a frame, or the frames of a pair. Streams
  /// of other steps and items are others, so that no step changes the numbers of another.
  Random(std::uint64_t seed, std::string_view step, std::initializer_list<std::int64_t> item);

  std::uint32_t next();                            ///< uniform over 32 bits
  int index(int n);                                ///< uniform in [0, n), n >= 1, unbiased
  double uniform(double min = 0, double max = 1);  ///< uniform in [min, max)
  double normal(double mean = 0, double sigma = 1);
  /// `k` different indices of [0, n), 0 <= k <= n, into `out` (resized); every set is equally
  /// likely, its order is not random. Throws ArgumentError otherwise.
  void sample(int n, int k, std::vector<int>& out);

 private:
  std::uint64_t state_;
  std::uint64_t increment_;
};

}  // namespace placegraph
