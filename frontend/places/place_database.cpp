#include <placegraph/frontend/places/place_database.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Maximum number of features in one training. Chosen.
constexpr int kMaxTrainingFeatures = 60000;

std::vector<BinaryDescriptor> descriptors_of(const std::vector<Feature>& features) {
  std::vector<BinaryDescriptor> descriptors;
  descriptors.reserve(features.size());
  for (const Feature& feature : features) descriptors.push_back(feature.descriptor);
  return descriptors;
}

}  // namespace

PlaceDatabase::PlaceDatabase(const PlaceDatabaseOptions& options, std::uint64_t seed)
    : options_(options), seed_(seed) {
  options_.check();
}

void PlaceDatabase::add(KeyframeId id, const std::vector<Feature>& features) {
  index_of_[id] = views_.size();
  views_.push_back({id, descriptors_of(features), {}});
  const bool first =
      trained_views_ == 0 && static_cast<int>(views_.size()) >= options_.first_training;
  if (first || (trained_views_ > 0 && views_.size() >= 2 * trained_views_))
    train();
  else if (!vocabulary_.empty())
    index(static_cast<int>(views_.size()) - 1);
}

void PlaceDatabase::train() {
  std::size_t total = 0;
  for (const View& view : views_) total += view.descriptors.size();
  if (total == 0) return;
  // Every n-th feature of every view.
  const std::size_t stride = total / kMaxTrainingFeatures + 1;
  std::vector<BinaryDescriptor> sample;
  for (const View& view : views_)
    for (std::size_t i = 0; i < view.descriptors.size(); i += stride)
      sample.push_back(view.descriptors[i]);
  Random random(seed_, "vocabulary", {static_cast<std::int64_t>(views_.size())});
  vocabulary_ = Vocabulary::train(sample, options_.vocabulary, random);
  trained_views_ = views_.size();

  std::vector<int> views_with(vocabulary_.words(), 0), last_view(vocabulary_.words(), -1);
  for (int v = 0; v < static_cast<int>(views_.size()); ++v)
    for (const BinaryDescriptor& d : views_[v].descriptors) {
      const std::uint32_t word = vocabulary_.word(d);
      if (last_view[word] != v) ++views_with[word];
      last_view[word] = v;
    }
  idf_.assign(vocabulary_.words(), 0);
  for (int w = 0; w < vocabulary_.words(); ++w)
    idf_[w] = static_cast<float>(std::log((1.0 + views_.size()) / (1.0 + views_with[w])));
  inverted_.assign(vocabulary_.words(), {});
  for (int v = 0; v < static_cast<int>(views_.size()); ++v) index(v);
}

Appearance PlaceDatabase::weigh(const std::vector<BinaryDescriptor>& descriptors) const {
  Appearance appearance;
  if (vocabulary_.empty()) return appearance;
  std::vector<std::uint32_t> words;
  for (const BinaryDescriptor& d : descriptors) words.push_back(vocabulary_.word(d));
  std::sort(words.begin(), words.end());
  double sum = 0;
  for (std::size_t i = 0; i < words.size();) {
    std::size_t end = i;
    while (end < words.size() && words[end] == words[i]) ++end;
    const float weight = static_cast<float>(end - i) * idf_[words[i]];
    if (weight > 0) appearance.words.emplace_back(words[i], weight);
    sum += weight;
    i = end;
  }
  for (auto& [word, weight] : appearance.words) weight = static_cast<float>(weight / sum);
  return appearance;
}

void PlaceDatabase::index(int view) {
  views_[view].appearance = weigh(views_[view].descriptors);
  for (const auto& [word, weight] : views_[view].appearance.words)
    inverted_[word].emplace_back(view, weight);
}

Appearance PlaceDatabase::describe(const std::vector<Feature>& features) const {
  return weigh(descriptors_of(features));
}

std::vector<PlaceCandidate> PlaceDatabase::query(
    const std::vector<Feature>& features, int count,
    const std::function<bool(KeyframeId)>& allowed) const {
  std::vector<double> scores(views_.size(), 0);
  for (const auto& [word, weight] : describe(features).words)
    for (const auto& [view, other] : inverted_[word]) scores[view] += std::min(weight, other);
  std::vector<PlaceCandidate> candidates;
  for (std::size_t v = 0; v < views_.size(); ++v)
    if (scores[v] > 0 && allowed(views_[v].id)) candidates.push_back({views_[v].id, scores[v]});
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
  if (static_cast<int>(candidates.size()) > count) candidates.resize(count);
  return candidates;
}

const Appearance& PlaceDatabase::appearance(KeyframeId id) const {
  const auto index = index_of_.find(id);
  require(index != index_of_.end(), "PlaceDatabase: unknown view " + to_string(id));
  return views_[index->second].appearance;
}

double PlaceDatabase::similarity(const std::vector<Feature>& features, KeyframeId id) const {
  const auto index = index_of_.find(id);
  if (index == index_of_.end()) return 0;
  const View* view = &views_[index->second];
  const Appearance a = describe(features);
  double score = 0;
  auto b = view->appearance.words.begin();
  for (const auto& [word, weight] : a.words) {
    while (b != view->appearance.words.end() && b->first < word) ++b;
    if (b == view->appearance.words.end()) break;
    if (b->first == word) score += std::min(weight, b->second);
  }
  return score;
}

}  // namespace placegraph
