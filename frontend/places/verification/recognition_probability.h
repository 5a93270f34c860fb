#pragma once
#include <placegraph/frontend/places/sequence_filter.h>

#include <functional>
#include <vector>

namespace placegraph {

/// Evidence for one image: scores of all views from the images before it and from those after it.
///
/// Empty for an image without views to compare.
struct ViewEvidence {
  std::vector<double> forwards, backwards;
};

/// Evidence of images by themselves: both directions are the list; unlisted views get its least
/// score.
std::vector<ViewEvidence> lone_evidence(const std::vector<std::vector<PlaceSimilarity>>& lists,
                                        int views);
/// Evidence of consecutive images: a SequenceFilter in either direction.
std::vector<ViewEvidence> sequence_evidence(const std::vector<std::vector<PlaceSimilarity>>& lists,
                                            int views, const SequenceFilterOptions& options);

/// Whether two stored views show nearly the same scene.
using NearViews = std::function<bool(int, int)>;

/// View with the largest score in both directions together.
struct ViewEstimate {
  int view = -1;        ///< index of the view; -1: none
  double margin = 0;    ///< lead of its score over that of all views that are not near it
  bool agreed = false;  ///< whether the best view of each direction alone is near it
};
/// Finds the best view among those that `allowed` admits.
ViewEstimate view_estimate(const ViewEvidence& evidence, const NearViews& near,
                           const std::function<bool(int)>& allowed);

/// Probability that a prediction is right.
///
/// A map calibrates it with predictions for its own views: wrong predictions, when all views near
/// the correct one are excluded; right predictions, when only the view itself is excluded. By
/// Bayes' rule, with equal prior probabilities:
///
/// - Margins of wrong predictions are exponential with their mean, like the distance between the
/// first
///   and the second of many independent scores (Renyi 1953). The similarity of a place to itself in
///   another light is unknown: margins of right predictions are uniform up to the largest (all but
///   a tenth).
/// - Both directions agree on right and on wrong predictions as often as in the calibration.
/// - Answers of consecutive images that are near each other are right together or wrong together:
///   they share the mean of their log odds over `reach` images to either side.
class RecognitionProbability {
 public:
  /// Calibrates the model. Throws ArgumentError without right or without wrong predictions.
  RecognitionProbability(const std::vector<ViewEstimate>& wrong,
                         const std::vector<ViewEstimate>& right);
  double log_odds(const ViewEstimate& estimate) const;
  /// Probability that each prediction is right; 0 for an image without a prediction.
  std::vector<double> probabilities(const std::vector<ViewEstimate>& estimates,
                                    const NearViews& near, int reach) const;

 private:
  double mean_wrong_ = 0, largest_right_ = 0;
  /// Shares of predictions on which both directions agree.
  double agreed_wrong_ = 0, agreed_right_ = 0;
};

}  // namespace placegraph
