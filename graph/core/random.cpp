#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace placegraph {
namespace {

/// A number in which every bit depends on all bits of both (the finalizer of SplitMix64).
std::uint64_t mixed(std::uint64_t a, std::uint64_t b) {
  std::uint64_t x = (a + 1) * 0x9e3779b97f4a7c15ULL + b;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

std::uint64_t stream_of(std::string_view step, std::initializer_list<std::int64_t> item) {
  std::uint64_t stream = step.size();
  for (const char letter : step) stream = mixed(stream, static_cast<unsigned char>(letter));
  for (const std::int64_t number : item) stream = mixed(stream, static_cast<std::uint64_t>(number));
  return stream;
}

}  // namespace

Random::Random(std::uint64_t seed, std::string_view step, std::initializer_list<std::int64_t> item)
    : Random(seed, stream_of(step, item)) {}

Random::Random(std::uint64_t seed, std::uint64_t stream)
    : state_(0), increment_((stream << 1) | 1) {
  next();
  state_ += seed;
  next();
}

std::uint32_t Random::next() {
  const std::uint64_t old = state_;
  state_ = old * 6364136223846793005ULL + increment_;
  const auto xorshifted = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
  const auto rotation = static_cast<std::uint32_t>(old >> 59);
  return (xorshifted >> rotation) | (xorshifted << ((32 - rotation) & 31));
}

int Random::index(int n) {
  require(n >= 1, "random: index of an empty range");
  // The first 2^32 mod n values are refused, so that n divides the rest.
  const auto bound = static_cast<std::uint32_t>(n);
  const std::uint32_t threshold = (0u - bound) % bound;
  std::uint32_t value = next();
  while (value < threshold) value = next();
  return static_cast<int>(value % bound);
}

double Random::uniform(double min, double max) {
  const std::uint64_t high = next() >> 5, low = next() >> 6;
  const double unit = static_cast<double>((high << 26) | low) * 0x1p-53;
  const double value = min + (max - min) * unit;
  return value < max ? value : min;  // rounding may reach max
}

double Random::normal(double mean, double sigma) {
  // Marsaglia's polar method.
  double u, v, s;
  do {
    u = uniform(-1, 1);
    v = uniform(-1, 1);
    s = u * u + v * v;
  } while (s >= 1 || s == 0);
  return mean + sigma * u * std::sqrt(-2 * std::log(s) / s);
}

void Random::sample(int n, int k, std::vector<int>& out) {
  if (k < 0 || k > n)
    throw ArgumentError("random: cannot draw " + std::to_string(k) + " different indices of " +
                        std::to_string(n));
  out.clear();
  if (k <= 32) {  // Floyd's algorithm: the search is fast for small k
    for (int j = n - k; j < n; ++j) {
      const int candidate = index(j + 1);
      const bool taken = std::find(out.begin(), out.end(), candidate) != out.end();
      out.push_back(taken ? j : candidate);
    }
    return;
  }
  out.resize(n);
  std::iota(out.begin(), out.end(), 0);
  for (int i = 0; i < k; ++i) std::swap(out[i], out[i + index(n - i)]);
  out.resize(k);
}

}  // namespace placegraph
