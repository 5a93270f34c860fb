#include <placegraph/frontend/labels/label_field.h>
#include <placegraph/frontend/labels/scene_channels.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace placegraph {
namespace {

// Rounds of the mean field, and its least share. Chosen.
constexpr int kRounds = 10;
constexpr float kLeastShare = 1e-3f;

float squared_difference(const std::uint8_t* a, const std::uint8_t* b) {
  constexpr std::array<int, 4> kColours = {SceneChannels::kRank, SceneChannels::kRedRelative,
                                           SceneChannels::kBlueRelative,
                                           SceneChannels::kSaturation};
  float sum = 0;
  for (const int c : kColours) {
    const float d = static_cast<float>(a[c]) - static_cast<float>(b[c]);
    sum += d * d;
  }
  return sum;
}

/// Influence on one side of a border from the other.
struct Link {
  int to, from;
  float weight;   ///< share of the border of `to`
  float similar;  ///< exp(-|c - c'|^2 / 2m)
  /// Shares of the border where `to` has this position relative to `from`.
  float above, below, beside;
};

std::vector<Link> links_of(const Superpixels& superpixels, const ByteFeatures& colours) {
  std::vector<float> differences;
  std::vector<int> whole(static_cast<std::size_t>(superpixels.count), 0);
  double mean = 1e-6;
  for (const SuperpixelBorder& b : superpixels.borders) {
    differences.push_back(squared_difference(colours.row(b.a), colours.row(b.b)));
    mean +=
        static_cast<double>(differences.back()) / static_cast<double>(superpixels.borders.size());
    whole[static_cast<std::size_t>(b.a)] += b.length();
    whole[static_cast<std::size_t>(b.b)] += b.length();
  }
  std::vector<Link> links;
  for (std::size_t k = 0; k < superpixels.borders.size(); ++k) {
    const SuperpixelBorder& b = superpixels.borders[k];
    const auto length = static_cast<float>(b.length());
    const float similar = std::exp(-differences[k] / (2 * static_cast<float>(mean)));
    const float above = static_cast<float>(b.above) / length,
                below = static_cast<float>(b.below) / length;
    const float beside = static_cast<float>(b.beside) / length;
    const float to_a = length / static_cast<float>(whole[static_cast<std::size_t>(b.a)]);
    const float to_b = length / static_cast<float>(whole[static_cast<std::size_t>(b.b)]);
    links.push_back({b.a, b.b, to_a, similar, above, below, beside});
    links.push_back({b.b, b.a, to_b, similar, below, above, beside});
  }
  return links;
}

/// exp and normalize, row by row.
void to_shares(const std::vector<float>& log_shares, std::size_t n, std::vector<float>& shares) {
  for (std::size_t at = 0; at < log_shares.size(); at += n) {
    const float most = *std::max_element(log_shares.begin() + static_cast<std::ptrdiff_t>(at),
                                         log_shares.begin() + static_cast<std::ptrdiff_t>(at + n));
    float sum = 0;
    for (std::size_t c = 0; c < n; ++c) sum += shares[at + c] = std::exp(log_shares[at + c] - most);
    for (std::size_t c = 0; c < n; ++c) shares[at + c] /= sum;
  }
}

}  // namespace

std::vector<float> field_marginals(const LabelField& field, const std::vector<float>& shares,
                                   const Superpixels& superpixels, const ByteFeatures& colours) {
  const auto n = static_cast<std::size_t>(field.classes);
  require(shares.size() == static_cast<std::size_t>(superpixels.count) * n &&
              colours.count == superpixels.count && field.relations.above.size() == n * n &&
              field.relations.beside.size() == n * n,
          "field_marginals: the sizes do not agree");
  std::vector<float> unary(shares.size());
  for (std::size_t i = 0; i < shares.size(); ++i)
    unary[i] = std::log(std::max(shares[i], kLeastShare));
  std::vector<float> marginals(shares.size()), log_marginals;
  to_shares(unary, n, marginals);
  if (field.smoothness == 0 && field.relation_weight == 0) return marginals;
  const std::vector<Link> links = links_of(superpixels, colours);
  const auto smoothness = static_cast<float>(field.smoothness),
             relation = static_cast<float>(field.relation_weight);
  for (int round = 0; round < kRounds; ++round) {
    log_marginals = unary;
    for (const Link& link : links) {
      const float* q = marginals.data() + static_cast<std::size_t>(link.from) * n;
      float* out = log_marginals.data() + static_cast<std::size_t>(link.to) * n;
      for (std::size_t c = 0; c < n; ++c) out[c] += link.weight * smoothness * link.similar * q[c];
      if (relation == 0) continue;
      for (std::size_t d = 0; d < n; ++d) {
        const float w = link.weight * relation * q[d];
        if (w < 1e-4f) continue;
        for (std::size_t c = 0; c < n; ++c)
          out[c] += w * (link.above * field.relations.above[c * n + d] +
                         link.below * field.relations.above[d * n + c] +
                         link.beside * field.relations.beside[c * n + d]);
      }
    }
    to_shares(log_marginals, n, marginals);
  }
  return marginals;
}

RelationCounts::RelationCounts(int classes)
    : classes_(classes), above_(static_cast<std::size_t>(classes * classes), 0), beside_(above_) {}

void RelationCounts::add(const Superpixels& superpixels, const std::vector<int>& labels) {
  const auto at = [&](int a, int b) { return static_cast<std::size_t>(a * classes_ + b); };
  for (const SuperpixelBorder& border : superpixels.borders) {
    const int a = labels[static_cast<std::size_t>(border.a)],
              b = labels[static_cast<std::size_t>(border.b)];
    if (a < 0 || b < 0) continue;
    above_[at(a, b)] += border.above;
    above_[at(b, a)] += border.below;
    beside_[at(a, b)] += border.beside;
    beside_[at(b, a)] += border.beside;
  }
}

RelationTable RelationCounts::table() const {
  const auto n = static_cast<std::size_t>(classes_);
  const auto log_ratios = [&](const std::vector<double>& counts) {
    // Pixels of border by chance: a few observations have little effect.
    constexpr double kPrior = 200;
    constexpr double kMost = 3;
    double sum = 1e-9;
    std::vector<double> first(n, 0), second(n, 0);
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) {
        sum += counts[a * n + b];
        first[a] += counts[a * n + b];
        second[b] += counts[a * n + b];
      }
    std::vector<float> table(n * n);
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) {
        const double chance = first[a] * second[b] / sum;
        const double ratio = std::log((counts[a * n + b] + kPrior) / (chance + kPrior));
        table[a * n + b] = static_cast<float>(std::clamp(ratio, -kMost, kMost));
      }
    return table;
  };
  return {log_ratios(above_), log_ratios(beside_)};
}

}  // namespace placegraph
