#include <fmt/format.h>
#include <placegraph/eval/edges/edge_consistency.h>
#include <placegraph/graph/core/chi_squared.h>
#include <placegraph/graph/pose_graph/constraint_source.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

constexpr double kLeast = 0.5, kMost = 2;  // bounds of a NEES with which covariances hold

std::string covariances_of(ConstraintSource source) {
  if (source == ConstraintSource::kOdometry) return "The covariances of the odometry";
  if (source == ConstraintSource::kLoop) return "The covariances of the loops";
  return "The covariances of the other edges";
}

/// "errors are 3.2 times the stated standard deviations (NEES 10.2)"
std::string factor_text(const Nees& nees) {
  return fmt::format("errors are {:.2g} times the stated standard deviations (NEES {:.3g})",
                     std::sqrt(nees.mean), nees.mean);
}

/// The axis with errors beyond its deviation; directions that combine axes may have some, too.
std::string worst_axis(const EdgeConsistency& c) {
  const auto worst = std::max_element(c.axes.begin(), c.axes.end(),
                                      [](const AxisConsistency& a, const AxisConsistency& b) {
                                        return a.normalized < b.normalized;
                                      });
  if (worst == c.axes.end() || worst->normalized <= 1)
    return "each axis alone is within its deviation, combinations of axes are not";
  return fmt::format("largest: {}, {:.2g} standard deviations", worst->name, worst->normalized);
}

}  // namespace

const char* to_string(EdgeVerdict verdict) {
  switch (verdict) {
    case EdgeVerdict::kNoEdges:
      return "no edges";
    case EdgeVerdict::kTooFewEdges:
      return "too few edges";
    case EdgeVerdict::kNotTestable:
      return "not testable";
    case EdgeVerdict::kTooLarge:
      return "too large";
    case EdgeVerdict::kHold:
      return "hold";
    case EdgeVerdict::kTooSmall:
      return "too small";
  }
  return "";
}

std::pair<double, double> nees_interval(const Nees& nees, int degrees_of_freedom) {
  constexpr double kDeviations = 1.959964;  // below which the normal distribution has 97.5 %
  if (degrees_of_freedom == 0) return {0, 0};
  return {nees.mean / mean_square_quantile(kDeviations, degrees_of_freedom),
          nees.mean / mean_square_quantile(-kDeviations, degrees_of_freedom)};
}

EdgeVerdict verdict_on(const EdgeConsistency& c) {
  if (c.edges == 0) return EdgeVerdict::kNoEdges;
  const auto [stated_low, stated_high] = nees_interval(c.by_stated, c.degrees_of_freedom);
  const auto [low, high] = nees_interval(c.with_truth, c.degrees_of_freedom);
  if (stated_high < kLeast) return EdgeVerdict::kTooLarge;
  if (c.truth_share > 0.5) return EdgeVerdict::kNotTestable;
  if (low > kMost) return EdgeVerdict::kTooSmall;
  return stated_low >= kLeast && high <= kMost ? EdgeVerdict::kHold : EdgeVerdict::kTooFewEdges;
}

std::string sentence_of(ConstraintSource source, const EdgeConsistency& c) {
  const std::string subject = covariances_of(source);
  switch (verdict_on(c)) {
    case EdgeVerdict::kNoEdges:
      return subject + " are not tested: no edge has a truth.";
    case EdgeVerdict::kTooFewEdges: {
      const auto [low, high] = nees_interval(c.with_truth, c.degrees_of_freedom);
      return fmt::format(
          "{}: too few edges to say; NEES {:.2f} (interval of 95 %: {:.2f} to {:.2f}).", subject,
          c.with_truth.mean, low, high);
    }
    case EdgeVerdict::kNotTestable:
      return fmt::format("{} are not testable: the truth's own noise makes {:.0f} % of the errors.",
                         subject, 100 * c.truth_share);
    case EdgeVerdict::kTooLarge:
      return subject + " are too large: " + factor_text(c.by_stated) + ".";
    case EdgeVerdict::kHold:
      if (c.truth_share > 0)
        return fmt::format("{} hold: NEES {:.2f}, with the noise of the truth {:.2f} (0.5 to 2).",
                           subject, c.by_stated.mean, c.with_truth.mean);
      return fmt::format("{} hold: NEES {:.2f} (0.5 to 2).", subject, c.by_stated.mean);
    case EdgeVerdict::kTooSmall:
      return subject + " are too small: " + factor_text(c.with_truth) + "; " + worst_axis(c) + ".";
  }
  return subject;
}

}  // namespace placegraph
