#pragma once
#include <placegraph/frontend/places/sequence_filter.h>

#include <functional>
#include <vector>

namespace placegraph {

/// The answer of a list of likenesses, and how far it stands out: its score less the best score of
/// a view that is not near it.
struct StandingOut {
  int view = -1;  ///< nothing for an empty list
  double margin = 0;
};

/// Whether two stored views show about the same.
using NearViews = std::function<bool(int, int)>;

/// Where no listed view is far from the best, the least listed takes its part.
StandingOut standing_out(const std::vector<PlaceLikeness>& list, const NearViews& near);

/// The lists of consecutive images, each with the evidence of those before and after it: the mean
/// of a SequenceFilter's scores in both directions. Every result holds all of `views`.
std::vector<std::vector<PlaceLikeness>> join_sequence(
    const std::vector<std::vector<PlaceLikeness>>& lists, int views,
    const SequenceFilterOptions& options);

/// How sure an answer is by how far it stands out. Of two hypotheses, equally likely before: the
/// answer is wrong, and its margin one that wrong answers have; the distance of the first to the
/// second of many independent scores is exponential (Renyi 1953), its mean is that of the answers
/// that stored views get when whatever is near them is kept from them. Or it is right, and its
/// margin anything up to what stored views get when they are kept from themselves alone: how like
/// itself a place remains in other light nobody knows beforehand.
class RecognitionOdds {
 public:
  /// Margins of wrong answers and of right ones. Throws ArgumentError without either.
  RecognitionOdds(const std::vector<double>& wrong, std::vector<double> right);
  double probability(double margin) const;
  double mean_wrong() const { return mean_wrong_; }
  double largest_right() const { return largest_right_; }

 private:
  double mean_wrong_ = 0, largest_right_ = 0;
};

}  // namespace placegraph
