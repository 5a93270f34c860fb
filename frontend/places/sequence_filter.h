#pragma once
#include <placegraph/frontend/places/place_likeness.h>
#include <placegraph/frontend/places/recognition_options.h>
#include <placegraph/graph/core/options.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Evidence of past images for where the present one is: the best path through the views that led
/// to each, a max-product filter over view, direction of travel (forward or back) and pace (half a
/// view, one and two views an image). It looks at the past alone. A score is the mean of the
/// recognizer's along the path, what is longer ago counting less, so that scores remain comparable
/// over queries. SeqSLAM (Milford & Wyeth 2012) searches straight lines to the same end.
class SequenceFilter {
 public:
  explicit SequenceFilter(const SequenceFilterOptions& options);

  /// The next image's likeness to views among first..last (what is not listed counts as the least
  /// listed), turned into scores with the past's evidence, best first; as many as views. None for
  /// an empty list, which ends the sequence.
  std::vector<PlaceLikeness> update(const std::vector<PlaceLikeness>& list, int first, int last);
  /// How sure an answer of `update` is, comparable over images: its score, and how like the present
  /// image alone is to that view by `list`, as it was given. A path goes on for a while where its
  /// street has been left; which view it leads to is not changed by that.
  double confidence(const PlaceLikeness& answer, const std::vector<PlaceLikeness>& list) const;
  /// Forgets the past, but not how much scores vary.
  void restart() { states_.clear(); }

 private:
  struct State {
    double pace = 1;            ///< views an image, negative for travel backwards
    std::vector<double> score;  ///< of views first_, first_ + 1, ...
  };
  std::vector<double> predict(const State& state, int first, int last) const;

  SequenceFilterOptions options_;
  std::vector<State> states_;
  int first_ = 0;
  double weight_ = 0;  ///< of the images in the scores
};

}  // namespace placegraph
