#pragma once
#include <placegraph/frontend/places/place_recognizer.h>
#include <placegraph/frontend/places/recognition_options.h>
#include <placegraph/graph/core/options.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Finds the best path through the stored views from the similarities of consecutive images.
///
/// A max-product filter over view, direction of travel (forwards or backwards) and pace (half a
/// view, one or two views per image). It uses past images only. A score is the mean of the
/// recognizer's scores along the path, weighted by SequenceFilterOptions::memory per image, so that
/// scores remain comparable over queries. SeqSLAM (Milford & Wyeth 2012) searches straight lines
/// for the same purpose.
class SequenceFilter {
 public:
  /// Starts without past images. Throws ArgumentError for options that check() refuses.
  explicit SequenceFilter(const SequenceFilterOptions& options);

  /// Adds the next image's similarities; returns a score for every view in first..last.
  ///
  /// `list` contains views of first..last (ArgumentError otherwise); a view that is not listed gets
  /// the score of the least similar listed one. The result is sorted by score, best first. An empty
  /// list ends the sequence, and the result is empty.
  std::vector<PlaceSimilarity> update(const std::vector<PlaceSimilarity>& list, int first,
                                      int last);
  /// Returns the confidence of a prediction of `update`, comparable over images.
  ///
  /// The confidence is the weighted mean of the prediction's score and of the similarity of its
  /// view in `list`, the list that `update` received, sorted best first. The reason: a path
  /// continues for some images after the camera has left its street. The choice of the best view
  /// does not change.
  double confidence(const PlaceSimilarity& prediction,
                    const std::vector<PlaceSimilarity>& list) const;
  /// Discards the past; the next image begins a new sequence.
  void restart() { states_.clear(); }

 private:
  struct State {
    double pace = 1;            ///< views per image, negative for travel backwards
    std::vector<double> score;  ///< scores of the views first_, first_ + 1, ...
  };
  std::vector<double> predict(const State& state, int first, int last) const;

  SequenceFilterOptions options_;
  std::vector<State> states_;
  int first_ = 0;
  double weight_ = 0;  ///< sum of the weights of the images in the scores
};

}  // namespace placegraph
