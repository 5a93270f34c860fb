#pragma once
#include <placegraph/frontend/places/sequence_filter.h>

#include <functional>
#include <vector>

namespace placegraph {

/// What is known of one image: scores of all views, with the evidence of the images before it and
/// of those after it. Empty for an image with nothing to compare.
struct ViewEvidence {
  std::vector<double> forwards, backwards;
};

/// The lists of images by themselves: both are the list, what is not listed counts as its least.
std::vector<ViewEvidence> lone_evidence(const std::vector<std::vector<PlaceSimilarity>>& lists,
                                        int views);
/// The lists of consecutive images: a SequenceFilter in either direction.
std::vector<ViewEvidence> sequence_evidence(const std::vector<std::vector<PlaceSimilarity>>& lists,
                                            int views, const SequenceFilterOptions& options);

/// Whether two stored views show about the same.
using NearViews = std::function<bool(int, int)>;

/// The view that the evidence of both sides together is for.
struct ViewEstimate {
  int view = -1;        ///< -1: there is none
  double margin = 0;    ///< by how much it stands out above all views that are not near it
  bool agreed = false;  ///< either side alone is for a view near it
};
/// Among the views that `allowed` admits.
ViewEstimate answer_of(const ViewEvidence& evidence, const NearViews& near,
                       const std::function<bool(int)>& allowed);

/// How sure answers are. A map calibrates it with answers that its own views get: wrong ones, when
/// all that is near them is kept from them; right ones, when they are kept from themselves alone.
/// By Bayes' rule, with even odds before:
///
/// - margins of wrong answers are exponential with their mean, as the distance of the first of many
///   independent scores to the second is (Renyi 1953). How like itself a place remains in another
///   light nobody knows: margins of right answers are anything up to the largest (all but a tenth);
/// - both sides agree on right and on wrong answers as often as they did there;
/// - answers of consecutive images that lie near each other are right together or wrong together:
///   they share the mean of their log odds over `reach` images to either side.
class RecognitionProbability {
 public:
  /// Throws ArgumentError without answers of either kind.
  RecognitionProbability(const std::vector<ViewEstimate>& wrong,
                         const std::vector<ViewEstimate>& right);
  double log_odds(const ViewEstimate& answer) const;
  /// Of each answer being right; 0 where there is none.
  std::vector<double> probabilities(const std::vector<ViewEstimate>& answers, const NearViews& near,
                                    int reach) const;

 private:
  double mean_wrong_ = 0, largest_right_ = 0;
  double agreed_wrong_ = 0, agreed_right_ = 0;  ///< shares
};

}  // namespace placegraph
