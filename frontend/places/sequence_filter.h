#pragma once
#include <placegraph/frontend/places/place_similarity.h>
#include <placegraph/frontend/places/recognition_options.h>
#include <placegraph/graph/core/options.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Joins the similarities of consecutive images into the best path through the stored views.
///
/// A max-product filter over view, direction of travel (forwards or backwards) and pace (half a
/// view, one or two views per image). It uses past images only. A score is the mean of the
/// recognizer's scores along the path, weighted by SequenceFilterOptions::memory per image, so that
/// scores remain comparable over queries. SeqSLAM (Milford & Wyeth 2012) searches straight lines
/// for the same purpose.
class SequenceFilter {
 public:
  /// Begins without a past. Throws ArgumentError for options that check() refuses.
  explicit SequenceFilter(const SequenceFilterOptions& options);

  /// Takes the next image's similarities; returns a score for every view in first..last.
  ///
  /// `list` holds views of first..last (ArgumentError otherwise); views that are not listed count
  /// as the least similar listed one. Sorted by score, best first. An empty list ends the sequence,
  /// and nothing is returned.
  std::vector<PlaceSimilarity> update(const std::vector<PlaceSimilarity>& list, int first,
                                      int last);
  /// Confidence of an answer of `update`, comparable over images.
  ///
  /// The weighted mean of its score and of the similarity that `list`, as it was given to `update`
  /// and sorted best first, has for that view: a path goes on for a while where its street has been
  /// left. Which view is the best is not changed by that.
  double confidence(const PlaceSimilarity& answer, const std::vector<PlaceSimilarity>& list) const;
  /// Forgets the past: the next image begins a new sequence.
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
