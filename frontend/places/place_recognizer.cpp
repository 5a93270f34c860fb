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
  mark([](const Candidate& c) { return c.score(); }, options.verified);
}

}  // namespace

void PlaceRecognizerOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PlaceRecognizerOptions& o) {
  field.group("cues", o.cues, "what tells places apart, and how much each counts");
  field("short_list", o.short_list, "views compared in full", {1, 1e6});
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
  views_.push_back(std::move(view));
  return size() - 1;
}

std::vector<PlaceLikeness> PlaceRecognizer::query(const PlaceView& query, int first,
                                                  int last) const {
  const auto view_at = [&](int i) -> const PlaceView& {
    return views_[static_cast<std::size_t>(i)];
  };
  std::vector<Candidate> candidates;
  for (int i = std::max(first, 0); i <= std::min(last, size() - 1); ++i)
    candidates.push_back({i, coarse_likeness(query, view_at(i), options_.cues), {}, 0, false});
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
