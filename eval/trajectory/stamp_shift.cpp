#include <placegraph/eval/association/stamp_shift.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace placegraph {
namespace {

using Stamps = std::vector<std::int64_t>;

// Stamps of the sparser recording that vote, and neighbours of each on either side: at 10 Hz a
// shift of up to six seconds. Chosen.
constexpr std::ptrdiff_t kVoters = 1000, kNeighbours = 64;
/// Standard deviations by which a constant must pair more than a random one. Chosen.
constexpr double kClear = 4;
/// Standard deviations of the difference of two numbers of unpaired stamps, within which constants
/// are equally good. Chosen.
constexpr double kAlike = 3;

void require_increasing(const Stamps& stamps, const char* whose) {
  require(std::adjacent_find(stamps.begin(), stamps.end(), std::greater_equal<>()) == stamps.end(),
          std::string(whose) + " stamps do not increase");
}

double median_spacing_ns(const Stamps& stamps) {
  std::vector<double> spacings;
  for (std::size_t i = 1; i < stamps.size(); ++i)
    spacings.push_back(static_cast<double>(stamps[i] - stamps[i - 1]));
  return median_of(std::move(spacings));
}

/// Differences of the stamps of `dense` from those of `sparse` near them, in ascending order.
struct Differences {
  Stamps sorted;
  double voters = 0;  ///< stamps of `sparse` that they are of

  Differences(const Stamps& sparse, const Stamps& dense) {
    const auto first = std::lower_bound(sparse.begin(), sparse.end(), dense.front());
    const auto last = std::upper_bound(first, sparse.end(), dense.back());
    const auto stride = 1 + (last - first) / kVoters;
    for (auto stamp = first; stamp < last; stamp += std::min(stride, last - stamp)) {
      const auto at = std::lower_bound(dense.begin(), dense.end(), *stamp);
      const auto end = at + std::min(kNeighbours, dense.end() - at);
      for (auto other = at - std::min(kNeighbours, at - dense.begin()); other != end; ++other)
        sorted.push_back(*other - *stamp);
      ++voters;
    }
    std::sort(sorted.begin(), sorted.end());
  }

  /// The middle of those within `limit_ns` of a value; the value if there are none.
  std::int64_t middle(std::int64_t value, std::int64_t limit_ns) const {
    const auto first = std::lower_bound(sorted.begin(), sorted.end(), value - limit_ns);
    const auto last = std::upper_bound(first, sorted.end(), value + limit_ns);
    return first == last ? value : *(first + (last - first) / 2);
  }

  /// The value around which most lie within `limit_ns`; of equally good ones that nearest to zero.
  std::int64_t densest(std::int64_t limit_ns) const {
    const std::size_t n = sorted.size();
    std::vector<std::size_t> counts(n);
    for (std::size_t begin = 0, end = 0; begin < n; ++begin) {
      while (end < n && sorted[end] - sorted[begin] <= 2 * limit_ns) ++end;
      counts[begin] = end - begin;
    }
    const auto most = static_cast<double>(*std::max_element(counts.begin(), counts.end()));
    const double enough = most - kAlike * std::sqrt(2 * std::max(0.0, voters - most) + 1);
    std::optional<std::int64_t> best;
    for (std::size_t i = 0; i < n; ++i) {
      const std::int64_t value = sorted[i + counts[i] / 2];
      if (static_cast<double>(counts[i]) < enough) continue;
      if (!best || std::abs(value) < std::abs(*best)) best = value;
    }
    // A window that leaves a few out is off the middle of them all.
    return middle(middle(*best, limit_ns), limit_ns);
  }
};

/// Stamps that have a partner, each of one, and the stamps of either in the time of both.
struct PairCount {
  int pairs = 0, of_a = 0, of_b = 0;
};

PairCount count_pairs(const Stamps& a, const Stamps& b, std::int64_t b_plus_ns,
                      std::int64_t limit_ns) {
  PairCount count;
  const auto within = [limit_ns](const Stamps& stamps, std::int64_t from, std::int64_t to) {
    return static_cast<int>(std::upper_bound(stamps.begin(), stamps.end(), to + limit_ns) -
                            std::lower_bound(stamps.begin(), stamps.end(), from - limit_ns));
  };
  count.of_a = within(a, b.front() + b_plus_ns, b.back() + b_plus_ns);
  count.of_b = within(b, a.front() - b_plus_ns, a.back() - b_plus_ns);
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const std::int64_t difference = a[i] - (b[j] + b_plus_ns);
    const bool pair = std::abs(difference) <= limit_ns;
    count.pairs += pair;
    if (pair || difference < 0) ++i;
    if (pair || difference > 0) ++j;
  }
  return count;
}

/// Whether so many pairs are more than a constant at random makes, each with probability `chance`.
bool clear(const PairCount& count, double chance) {
  const double n = std::min(count.of_a, count.of_b), pairs = count.pairs;
  return pairs >= 0.5 * (1 + chance) * n &&
         pairs >= n * chance + kClear * std::sqrt(n * chance * (1 - chance));
}

/// Rounded to a power of ten that is at most a tenth of the largest difference.
std::int64_t rounded(std::int64_t shift_ns, std::int64_t limit_ns) {
  std::int64_t unit = 1;
  while (100 * unit <= limit_ns) unit *= 10;
  return std::llround(static_cast<double>(shift_ns) / static_cast<double>(unit)) * unit;
}

}  // namespace

std::optional<StampShift> constant_shift_that_pairs(const std::vector<std::int64_t>& truth_ns,
                                                    const std::vector<std::int64_t>& estimate_ns,
                                                    double max_difference_s) {
  require(max_difference_s >= 0 && max_difference_s < 1e9,
          "stamp shift: the largest difference is not in [0, 1e9)");
  require_increasing(truth_ns, "the ground truth's");
  require_increasing(estimate_ns, "the estimate's");
  // Two stamps have one spacing, which any two others may have by chance. Chosen.
  constexpr std::size_t kLeastStamps = 3;
  if (std::min(truth_ns.size(), estimate_ns.size()) < kLeastStamps) return {};
  const std::int64_t limit_ns = std::llround(max_difference_s * 1e9);
  const double truth_spacing_ns = median_spacing_ns(truth_ns);
  const double estimate_spacing_ns = median_spacing_ns(estimate_ns);
  const double chance =
      2 * static_cast<double>(limit_ns) / std::min(truth_spacing_ns, estimate_spacing_ns);
  const PairCount now = count_pairs(truth_ns, estimate_ns, 0, limit_ns);
  if (chance >= 1 || clear(now, chance)) return {};

  const bool truth_denser = truth_spacing_ns <= estimate_spacing_ns;
  const Differences differences(truth_denser ? estimate_ns : truth_ns,
                                truth_denser ? truth_ns : estimate_ns);
  if (differences.sorted.empty()) return {};
  const std::int64_t found_ns = differences.densest(limit_ns) * (truth_denser ? 1 : -1);
  const std::int64_t shift_ns = rounded(found_ns, limit_ns);
  const PairCount then = count_pairs(truth_ns, estimate_ns, shift_ns, limit_ns);
  if (std::min(then.of_a, then.of_b) < static_cast<int>(kLeastStamps) || !clear(then, chance))
    return {};
  return StampShift{1e-9 * static_cast<double>(shift_ns), then.pairs, now.pairs,
                    std::min(then.of_a, then.of_b)};
}

}  // namespace placegraph
