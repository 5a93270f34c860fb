#include <placegraph/frontend/places/inverted_index.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {

InvertedIndex::InvertedIndex(std::vector<float> idf)
    : idf_(std::move(idf)), views_with_(idf_.size(), 0), inverted_(idf_.size()) {
  require(!idf_.empty(), "InvertedIndex: no words");
}

InvertedIndex::Counts InvertedIndex::count(const std::vector<std::uint32_t>& words) const {
  std::vector<std::uint32_t> sorted = words;
  std::sort(sorted.begin(), sorted.end());
  require(sorted.empty() || sorted.back() < idf_.size(), "InvertedIndex: no such word");
  Counts counts;
  for (const std::uint32_t word : sorted) {
    if (counts.empty() || counts.back().first != word) counts.emplace_back(word, 0);
    ++counts.back().second;
  }
  return counts;
}

std::vector<InvertedIndex::Weighted> InvertedIndex::weigh(const Counts& counts) const {
  std::vector<Weighted> weights;
  float sum = 0;
  for (const auto& [word, times] : counts) {
    const float weight = static_cast<float>(times) * std::max(idf_[word], 0.f);
    if (weight > 0) weights.push_back({word, weight});
    sum += weight;
  }
  for (Weighted& one : weights) one.weight /= sum;
  return weights;
}

void InvertedIndex::insert(int view) {
  for (const auto& [word, weight] : weigh(views_[static_cast<std::size_t>(view)]))
    inverted_[word].push_back({view, weight});
}

void InvertedIndex::reweigh() {
  for (std::size_t word = 0; word < idf_.size(); ++word) {
    idf_[word] = static_cast<float>(std::log((1.0 + static_cast<double>(views_.size())) /
                                             (1.0 + static_cast<double>(views_with_[word]))));
    inverted_[word].clear();
  }
  for (int view = 0; view < size(); ++view) insert(view);
  weighed_views_ = views_.size();
}

int InvertedIndex::add(const std::vector<std::uint32_t>& words) {
  views_.push_back(count(words));
  for (const auto& [word, times] : views_.back()) ++views_with_[word];
  // Views for weights of words. Chosen.
  constexpr std::size_t kFirstWeighing = 20;
  if (views_.size() >= std::max(kFirstWeighing, 2 * weighed_views_))
    reweigh();
  else
    insert(size() - 1);
  return size() - 1;
}

std::vector<PlaceSimilarity> InvertedIndex::query(const std::vector<std::uint32_t>& words,
                                                  int count_max, int first, int last) const {
  first = std::max(first, 0);
  last = std::min(last, size() - 1);
  if (first > last) return {};
  std::vector<double> scores(static_cast<std::size_t>(last - first + 1), 0);
  for (const auto& [word, weight] : weigh(count(words)))
    for (const Entry& entry : inverted_[word])
      if (entry.view >= first && entry.view <= last)
        scores[static_cast<std::size_t>(entry.view - first)] += std::min(weight, entry.weight);
  std::vector<PlaceSimilarity> list;
  for (std::size_t i = 0; i < scores.size(); ++i)
    if (scores[i] > 0) list.push_back({first + static_cast<int>(i), scores[i]});
  keep_best(list, count_max);
  return list;
}

}  // namespace placegraph
