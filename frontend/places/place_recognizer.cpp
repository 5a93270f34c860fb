#include <placegraph/frontend/places/dense_index.h>
#include <placegraph/frontend/places/place_recognizer.h>
#include <placegraph/frontend/places/place_similarity.h>
#include <placegraph/frontend/places/place_view.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/function_clones.h>
#include <placegraph/graph/core/parallel.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// View of the short list with its similarities so far.
struct Candidate {
  int view = 0;
  double coarse = 0;
  GridSimilarity grids;
  double corners = 0;
  bool verified = false;
  double score() const { return grids.sum() + corners; }
};

// Sorts by some figure, best first; equal ones keep their order.
template <class Figure>
void sort_by(std::vector<Candidate>& candidates, const Figure& figure) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [&](const Candidate& a, const Candidate& b) { return figure(a) > figure(b); });
}

// Marks the views whose corners are compared: those that are among the first in any single cue, not
// only in the sum. If one cue fails, the sum is misleading.
void nominate(std::vector<Candidate>& candidates, const PlaceRecognizerOptions& options) {
  const auto mark = [&](auto figure, int count) {
    sort_by(candidates, figure);
    const auto longest = std::min(candidates.size(), static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < longest; ++i) candidates[i].verified = true;
  };
  mark([](const Candidate& c) { return c.grids.tiny; }, options.nominated);
  mark([](const Candidate& c) { return c.grids.colour; }, options.nominated);
  mark([](const Candidate& c) { return c.grids.gradients; }, options.nominated);
  mark([](const Candidate& c) { return c.score(); }, options.verified);
}

/// Inner products of unit vectors, three at most: far below 2^31.
PLACEGRAPH_CLONES
void inner_products(const std::int16_t* query, const std::int16_t* stored, std::ptrdiff_t length,
                    int count, std::int32_t* products) {
  for (int view = 0; view < count; ++view) {
    const std::int16_t* other = stored + view * length;
    std::int32_t sum = 0;
    for (std::ptrdiff_t i = 0; i < length; ++i)
      sum += static_cast<std::int32_t>(query[i]) * other[i];
    products[view] = sum;
  }
}

std::vector<float> unit_vector(const std::int16_t* thumbnail, std::size_t length) {
  std::vector<float> vector(thumbnail, thumbnail + length);
  float squares = 0;
  for (const float value : vector) squares += value * value;
  const float scale = squares > 0 ? 1 / std::sqrt(squares) : 0;
  for (float& value : vector) value *= scale;
  return vector;
}

}  // namespace

PlaceRecognizer::PlaceRecognizer(const PlaceRecognizerOptions& options) : options_(options) {
  options_.check();
}

PlaceRecognizer::~PlaceRecognizer() = default;
PlaceRecognizer::PlaceRecognizer(PlaceRecognizer&&) noexcept = default;
PlaceRecognizer& PlaceRecognizer::operator=(PlaceRecognizer&&) noexcept = default;

int PlaceRecognizer::add(PlaceView view) {
  require(views_.empty() || views_.front().colour.empty() == view.colour.empty(),
          "PlaceRecognizer: one view is grey and one in colour");
  if (view.tiny.size() > 1) view.tiny.resize(1);
  if (view.gradients.size() > 1) view.gradients.resize(1);
  require(views_.empty() || views_.front().thumbnail.size() == view.thumbnail.size(),
          "PlaceRecognizer: the views have different cues");
  thumbnails_.insert(thumbnails_.end(), view.thumbnail.begin(), view.thumbnail.end());
  views_.push_back(std::move(view));
  grow_graph();
  return size() - 1;
}

// From half of the number on, two views are inserted for each new one, so that none takes long.
void PlaceRecognizer::grow_graph() {
  const std::size_t length = views_.back().thumbnail.size();
  if (length == 0 || size() < options_.indexed_from / 2) return;
  if (!graph_) graph_ = std::make_unique<DenseIndex>(static_cast<int>(length), 0);
  for (int i = 0; i < 2 && graph_->size() < size(); ++i)
    graph_->add(unit_vector(thumbnails_.data() + static_cast<std::size_t>(graph_->size()) * length,
                            length));
}

std::vector<int> PlaceRecognizer::thumbnails_along_graph(const PlaceView& query, int first,
                                                         int last) const {
  std::vector<int> views;
  for (const PlaceSimilarity& similarity :
       graph_->query(unit_vector(query.thumbnail.data(), query.thumbnail.size()),
                     options_.shortlisted, first, last))
    views.push_back(similarity.view);
  std::sort(views.begin(), views.end());
  return views;
}

std::vector<int> PlaceRecognizer::thumbnail(const PlaceView& query, int first, int last) const {
  if (first > last) return {};
  if (graph_ && graph_->size() == size() && last - first + 1 >= options_.indexed_from)
    return thumbnails_along_graph(query, first, last);
  const auto length = static_cast<std::ptrdiff_t>(query.thumbnail.size());
  std::vector<std::int32_t> similarity(static_cast<std::size_t>(last - first + 1));
  inner_products(query.thumbnail.data(), thumbnails_.data() + first * length, length,
                 last - first + 1, similarity.data());
  std::vector<std::pair<std::int32_t, int>> order;  // minus the similarity, view
  order.reserve(similarity.size());
  for (int view = first; view <= last; ++view)
    order.emplace_back(-similarity[static_cast<std::size_t>(view - first)], view);
  const auto count = std::min(order.size(), static_cast<std::size_t>(options_.shortlisted));
  if (count < order.size())
    std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count),
                     order.end());
  std::vector<int> views;
  for (std::size_t i = 0; i < count; ++i) views.push_back(order[i].second);
  std::sort(views.begin(), views.end());
  return views;
}

std::vector<PlaceSimilarity> PlaceRecognizer::query(const PlaceView& query, int first,
                                                    int last) const {
  const auto view_at = [&](int i) -> const PlaceView& {
    return views_[static_cast<std::size_t>(i)];
  };
  require(views_.empty() || query.thumbnail.size() == views_.front().thumbnail.size(),
          "PlaceRecognizer: the query has other cues than the views");
  std::vector<Candidate> candidates;
  for (const int view : thumbnail(query, std::max(first, 0), std::min(last, size() - 1))) {
    check_interruption();
    candidates.push_back(
        {view, coarse_similarity(query, view_at(view), options_.cues), {}, 0, false});
  }
  sort_by(candidates, [](const Candidate& c) { return c.coarse; });
  if (candidates.size() > static_cast<std::size_t>(options_.short_list))
    candidates.resize(static_cast<std::size_t>(options_.short_list));
  for (Candidate& candidate : candidates)
    candidate.grids = grid_similarity(query, view_at(candidate.view), options_.cues);
  if (options_.cues.corners > 0) {
    nominate(candidates, options_);
    for (Candidate& candidate : candidates)
      if (candidate.verified)
        candidate.corners = corner_similarity(query, view_at(candidate.view), options_.cues);
  }
  sort_by(candidates, [](const Candidate& c) { return c.score(); });
  std::vector<PlaceSimilarity> list;
  for (const Candidate& candidate : candidates) list.push_back({candidate.view, candidate.score()});
  return list;
}

}  // namespace placegraph
