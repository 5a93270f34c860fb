#pragma once
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/pose_graph/landmark_graph.h>

#include <optional>
#include <vector>

namespace placegraph {

/// The chi2 of a graph beside its expectation.
struct Chi2Fit {
  double chi2 = 0;             ///< of the constraints that were kept
  int degrees_of_freedom = 0;  ///< its expectation
  /// Most that rounding the measurements to the digits that they have contributes to chi2.
  double rounding = 0;
  double largest = 0;   ///< the largest chi2 of one constraint; 0: unknown
  int constraints = 0;  ///< their number
  int dimension = 0;    ///< components of the error of one
};

/// The bound of chi2 that measurements which are exact but for their last digit have.
///
/// At the minimum chi2 is not larger than at the true poses, where every component of an error is
/// at most half a unit of the last digit. That unit is known from the translations, which have a
/// number of decimals or of digits; no measurement is taken for better than a millionth.
///
/// Constraints whose place in `left_out` is not zero are left out; it may be empty.
double chi2_of_rounding(const std::vector<Constraint>& constraints,
                        const std::vector<char>& left_out = {});
/// The same of a graph with priors and observations of points.
double chi2_of_rounding(const LandmarkGraph& graph);

/// Whether chi2 is far above or below its expectation, by a factor of ten and beyond chance; above
/// it also by a factor of three, if one constraint's error is too large for noise of that scale.
std::optional<DoubtKind> doubt_of_chi2(const Chi2Fit& fit);

/// The line on directions that constraints leave free, `count` of them at the given vertices.
Doubt not_unique(int count, const std::vector<NodeId>& vertices);

/// "3, 5, 7 and 12 more"
std::string some_ids(const std::vector<NodeId>& ids);

/// The line on a chi2 far from its expectation; `advice` follows where it is too large.
Doubt doubt_about_chi2(DoubtKind kind, const Chi2Fit& fit, const std::string& rejected,
                       const std::string& advice);

}  // namespace placegraph
