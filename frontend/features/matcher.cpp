#include <placegraph/frontend/features/matcher.h>
#include <placegraph/graph/core/function_clones.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace placegraph {
namespace {

struct Best {
  int index = -1, distance = 257, second = 257;
  void offer(int i, int d) {
    if (d < distance) {
      second = distance;
      distance = d;
      index = i;
    } else if (d < second) {
      second = d;
    }
  }
};

/// Descriptors stored word by word, so that several are compared at once.
struct DescriptorColumns {
  std::array<std::vector<std::uint64_t>, 4> word;
  explicit DescriptorColumns(std::size_t count) {
    for (auto& column : word) column.reserve(count);
  }
  void push_back(const BinaryDescriptor& descriptor) {
    for (std::size_t i = 0; i < word.size(); ++i) word[i].push_back(descriptor[i]);
  }
};

/// Results of compare(), one per descriptor.
struct Comparison {
  std::vector<int> distances, nearest, nearest_a;
  explicit Comparison(std::size_t count)
      : distances(count), nearest(count, 257), nearest_a(count, -1) {}
};

/// Computes the distances of `from` to all, and updates those for which `a` is the nearest so far.
/// These loops without branches are most of the cost of comparing two views.
PLACEGRAPH_INLINE void compare_all(const BinaryDescriptor& from, const DescriptorColumns& columns,
                                   int a, Comparison& result) {
  const std::uint64_t *word0 = columns.word[0].data(), *word1 = columns.word[1].data(),
                      *word2 = columns.word[2].data(), *word3 = columns.word[3].data();
  int *distances = result.distances.data(), *nearest = result.nearest.data(),
      *nearest_a = result.nearest_a.data();
  const std::size_t count = result.distances.size();
  for (std::size_t k = 0; k < count; ++k)
    distances[k] = static_cast<int>(std::popcount(from[0] ^ word0[k])) +
                   std::popcount(from[1] ^ word1[k]) + std::popcount(from[2] ^ word2[k]) +
                   std::popcount(from[3] ^ word3[k]);
  for (std::size_t k = 0; k < count; ++k) {
    const bool nearer = distances[k] < nearest[k];
    nearest[k] = nearer ? distances[k] : nearest[k];
    nearest_a[k] = nearer ? a : nearest_a[k];
  }
}

PLACEGRAPH_COUNTS_BITS
void compare(const BinaryDescriptor& from, const DescriptorColumns& columns, int a,
             Comparison& result) {
  compare_all(from, columns, a, result);
}

#ifdef PLACEGRAPH_COUNTS_MANY_BITS
/// Eight words at once; not a target clone, as GCC 12 cannot select this instruction in one.
PLACEGRAPH_COUNTS_MANY_BITS
void compare_eight(const BinaryDescriptor& from, const DescriptorColumns& columns, int a,
                   Comparison& result) {
  compare_all(from, columns, a, result);
}
using Compare = void (*)(const BinaryDescriptor&, const DescriptorColumns&, int, Comparison&);
Compare best_compare() {
  return __builtin_cpu_supports("avx512vpopcntdq") ? compare_eight : compare;
}
#else
auto best_compare() { return &compare; }
#endif

/// Keeps mutual best matches that pass both tests; `best_a[i]` is an index into b, `best_b[j]` into
/// a.
std::vector<FeatureMatch> mutual(const std::vector<Best>& best_a, const std::vector<Best>& best_b,
                                 const MatcherOptions& options) {
  std::vector<FeatureMatch> matches;
  for (int i = 0; i < static_cast<int>(best_a.size()); ++i) {
    const Best& best = best_a[i];
    if (best.index < 0 || best.distance > options.max_distance) continue;
    if (best.distance > options.max_ratio * best.second) continue;
    if (best_b[best.index].index != i) continue;
    matches.push_back({i, best.index, best.distance});
  }
  return matches;
}

}  // namespace

std::vector<FeatureMatch> match_features(const std::vector<Feature>& a,
                                         const std::vector<Feature>& b,
                                         const MatcherOptions& options,
                                         const std::vector<bool>& use_b) {
  std::vector<Best> best_a(a.size()), best_b(b.size());
  std::vector<int> used;
  DescriptorColumns columns(b.size());
  for (int j = 0; j < static_cast<int>(b.size()); ++j) {
    if (!use_b.empty() && !use_b[j]) continue;
    used.push_back(j);
    columns.push_back(b[j].descriptor);
  }
  Comparison comparison(used.size());
  const auto& distances = comparison.distances;
  const auto compare_with = best_compare();
  for (int i = 0; i < static_cast<int>(a.size()); ++i) {
    compare_with(a[i].descriptor, columns, i, comparison);
    Best best;
    for (std::size_t k = 0; k < used.size(); ++k)
      if (distances[k] < best.second) best.offer(used[k], distances[k]);
    best_a[i] = best;
  }
  for (std::size_t k = 0; k < used.size(); ++k) best_b[used[k]].index = comparison.nearest_a[k];
  return mutual(best_a, best_b, options);
}

std::vector<FeatureMatch> match_epipolar(const Camera& camera, const std::vector<Feature>& a,
                                         const std::vector<Feature>& b, const SE3& T_a_b,
                                         double band_px, const MatcherOptions& options) {
  const SE3 T_b_a = T_a_b.inverse();
  const Eigen::Matrix3d K_inverse = camera.K().inverse();
  // l_b = F x_a with F = K^-T [t]x R K^-1 of T_b_a.
  const Eigen::Matrix3d F =
      K_inverse.transpose() * hat(T_b_a.translation()) * T_b_a.rotation().matrix() * K_inverse;
  const Eigen::Matrix3d H_infinity = camera.K() * T_b_a.rotation().matrix() * K_inverse;
  struct Place {
    Eigen::Vector2d px;
    int octave;
  };
  std::vector<Place> places_b;  // contiguous, as all are compared for every line
  for (const Feature& feature : b) places_b.push_back({feature.px.cast<double>(), feature.octave});
  std::vector<Best> best_a(a.size()), best_b(b.size());
  for (int i = 0; i < static_cast<int>(a.size()); ++i) {
    const Eigen::Vector3d x_a = a[i].px.cast<double>().homogeneous();
    Eigen::Vector3d line = F * x_a;
    line /= line.head<2>().norm();
    const Eigen::Vector3d infinity = H_infinity * x_a;
    if (infinity.z() <= 0 || !line.allFinite()) continue;
    const Eigen::Vector2d px_infinity = infinity.hnormalized();
    // From the image of the point at infinity, a nearer point moves along the line towards the
    // epipole or away from it.
    const Eigen::Vector3d Kt = camera.K() * T_b_a.translation();
    const Eigen::Vector2d direction = (Kt.head<2>() - Kt.z() * px_infinity).normalized();
    for (int j = 0; j < static_cast<int>(b.size()); ++j) {
      const auto& [px_b, octave_b] = places_b[j];
      if (std::abs(line.dot(px_b.homogeneous())) > band_px) continue;
      if (std::abs(a[i].octave - octave_b) > 2) continue;
      if (direction.dot(px_b - px_infinity) < -band_px) continue;
      const int d = hamming_distance(a[i].descriptor, b[j].descriptor);
      best_a[i].offer(j, d);
      best_b[j].offer(i, d);
    }
  }
  return mutual(best_a, best_b, options);
}

}  // namespace placegraph
