#include <placegraph/frontend/places/place_recognizer.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>

namespace placegraph {
namespace {

/// A view of the short list with what is known of it so far.
struct Candidate {
  int view = 0;
  double coarse = 0;
  GridLikeness grids;
  double corners = 0;
  bool verified = false;
  double score() const { return grids.sum() + corners; }
};

// Best first by some figure; equal ones keep their order.
template <class Figure>
void sort_by(std::vector<Candidate>& candidates, const Figure& figure) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [&](const Candidate& a, const Candidate& b) { return figure(a) > figure(b); });
}

// The corners of a view that any cue puts among its first are looked at, not only of those that
// are first in the sum: where one cue fails, the sum is no good guide.
void nominate(std::vector<Candidate>& candidates, const PlaceRecognizerOptions& options) {
  const auto mark = [&](auto figure, int count) {
    sort_by(candidates, figure);
    const auto longest = std::min(candidates.size(), static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < longest; ++i) candidates[i].verified = true;
  };
  mark([](const Candidate& c) { return c.grids.tiny; }, options.nominated);
  mark([](const Candidate& c) { return c.grids.colour; }, options.nominated);
  mark([](const Candidate& c) { return c.grids.gradients; }, options.nominated);
  if (options.cues.gabor > 0)
    mark([](const Candidate& c) { return c.grids.gabor; }, options.nominated);
  mark([](const Candidate& c) { return c.score(); }, options.verified);
}

}  // namespace

void PlaceRecognizerOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PlaceRecognizerOptions& o) {
  field.group("cues", o.cues, "what tells places apart, and how much each counts");
  field("glanced", o.glanced, "views that pass the first look", {1, 1e6});
  field("short_list", o.short_list, "of those, views compared in full", {1, 1e6});
  field("verified", o.verified, "first views by all grids whose corners are compared", {0, 1e6});
  field("nominated", o.nominated, "first views by each cue whose corners are compared", {0, 1e6});
}

PlaceRecognizer::PlaceRecognizer(const PlaceRecognizerOptions& options) : options_(options) {
  options_.check();
}

int PlaceRecognizer::add(PlaceView view) {
  require(views_.empty() || views_.front().colour.empty() == view.colour.empty(),
          "PlaceRecognizer: one view is grey and one in colour");
  if (view.tiny.size() > 1) view.tiny.resize(1);
  if (view.gradients.size() > 1) view.gradients.resize(1);
  require(views_.empty() || views_.front().glance.size() == view.glance.size(),
          "PlaceRecognizer: views of different cues");
  glances_.insert(glances_.end(), view.glance.begin(), view.glance.end());
  views_.push_back(std::move(view));
  return size() - 1;
}

std::vector<int> PlaceRecognizer::glance(const PlaceView& query, int first, int last) const {
  const auto length = static_cast<std::ptrdiff_t>(query.glance.size());
  std::vector<std::pair<std::int32_t, int>> order;  // minus the likeness, view
  for (int view = first; view <= last; ++view) {
    const std::int16_t* stored = glances_.data() + view * length;
    std::int32_t likeness = 0;  // of three unit vectors: at most 3 * 2^26
    for (std::ptrdiff_t i = 0; i < length; ++i)
      likeness += static_cast<std::int32_t>(query.glance[static_cast<std::size_t>(i)]) * stored[i];
    order.emplace_back(-likeness, view);
  }
  const auto count = std::min(order.size(), static_cast<std::size_t>(options_.glanced));
  if (count < order.size())
    std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count),
                     order.end());
  std::vector<int> views;
  for (std::size_t i = 0; i < count; ++i) views.push_back(order[i].second);
  std::sort(views.begin(), views.end());
  return views;
}

std::vector<PlaceLikeness> PlaceRecognizer::query(const PlaceView& query, int first,
                                                  int last) const {
  const auto view_at = [&](int i) -> const PlaceView& {
    return views_[static_cast<std::size_t>(i)];
  };
  require(views_.empty() || query.glance.size() == views_.front().glance.size(),
          "PlaceRecognizer: a query of other cues than the views");
  std::vector<Candidate> candidates;
  for (const int view : glance(query, std::max(first, 0), std::min(last, size() - 1)))
    candidates.push_back(
        {view, coarse_likeness(query, view_at(view), options_.cues), {}, 0, false});
  sort_by(candidates, [](const Candidate& c) { return c.coarse; });
  if (candidates.size() > static_cast<std::size_t>(options_.short_list))
    candidates.resize(static_cast<std::size_t>(options_.short_list));
  for (Candidate& candidate : candidates)
    candidate.grids = grid_likeness(query, view_at(candidate.view), options_.cues);
  if (options_.cues.corners > 0) {
    nominate(candidates, options_);
    for (Candidate& candidate : candidates)
      if (candidate.verified)
        candidate.corners = corner_likeness(query, view_at(candidate.view), options_.cues);
  }
  sort_by(candidates, [](const Candidate& c) { return c.score(); });
  std::vector<PlaceLikeness> list;
  for (const Candidate& candidate : candidates) list.push_back({candidate.view, candidate.score()});
  return list;
}

}  // namespace placegraph
