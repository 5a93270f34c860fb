#include <fmt/format.h>
#include <placegraph/backend/pose_graph/pose_graph_doubts.h>
#include <placegraph/backend/pose_graph/pose_graph_report.h>
#include <placegraph/graph/core/chi_squared.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Number of significant digits of a value in decimal notation, at most `most`.
int significant_digits(double value, int most) {
  const std::string text = fmt::format("{:.{}e}", std::abs(value), most - 1);
  const std::size_t last = text.find_last_not_of('0', text.find('e') - 1);
  return last == 1 ? 1 : static_cast<int>(last);  // "1.25e+00": one digit, a point, two digits
}

Eigen::Vector3d translation_of(const Pose& pose) {
  if (const SE2* T = std::get_if<SE2>(&pose)) return {T->translation().x(), T->translation().y(), 0};
  if (const SE3* T = std::get_if<SE3>(&pose)) return T->translation();
  return std::get<Sim3>(pose).translation();
}

/// What was measured, and the weight of its errors.
struct Measured {
  Eigen::Vector3d translation;  ///< [m]
  int dim, rest;                ///< components of the translation, and of rotation and scale
  double weight, rest_weight;   ///< traces of their information
};

Measured measured(const Eigen::Vector3d& translation, const Eigen::MatrixXd& information, int dim) {
  const double all = information.trace(), own = information.topLeftCorner(dim, dim).trace();
  return {translation, dim, static_cast<int>(information.rows()) - dim, own, all - own};
}

int dimension(PoseKind kind) { return kind == PoseKind::kSE2 ? 2 : 3; }

std::vector<Measured> measured_of(const std::vector<Constraint>& constraints) {
  std::vector<Measured> all;
  for (const Constraint& constraint : constraints)
    if (const auto* edge = std::get_if<RelativePoseConstraint>(&constraint))
      all.push_back(measured(translation_of(edge->T_from_to), edge->information,
                             dimension(kind_of(edge->T_from_to))));
    else if (const auto* position = std::get_if<PositionConstraint>(&constraint))
      all.push_back(measured(position->position_world, position->information, 3));
  return all;
}

/// Half a unit of the last digit of translations [m], and of angles and scales.
struct LastDigit {
  double translation = 0, rotation = 0;
};

LastDigit last_digit(const std::vector<Measured>& all) {
  constexpr int kMost = 7;  // digits: a measurement is not better than a millionth
  int digits = 1;
  double largest = 0, finest = 1;
  for (const Measured& each : all)
    for (const double x : each.translation) {
      if (x == 0) continue;
      const int of_x = significant_digits(x, kMost);
      const double unit = std::pow(10, std::floor(std::log10(std::abs(x))));
      digits = std::max(digits, of_x);
      largest = std::max(largest, unit);
      finest = std::min(finest, unit * std::pow(10, 1 - of_x));
    }
  const double relative = std::pow(10, 1 - digits);
  return {0.5 * relative * largest, 0.5 * std::max(relative, finest)};
}

double rounding_of(const std::vector<Measured>& all) {
  const LastDigit half = last_digit(all);
  double bound = 0;
  // e^T Omega e <= trace(Omega) |e|^2 for the translation and for the rest, and twice that for both.
  for (const Measured& each : all)
    bound += 2 * each.dim * std::pow(half.translation, 2) * each.weight +
             2 * each.rest * std::pow(half.rotation, 2) * each.rest_weight;
  return bound;
}

std::vector<NodeId> ids_of(const PoseGraph& graph, const std::vector<int>& nodes) {
  std::vector<NodeId> ids;
  for (const int node : nodes) ids.push_back(graph.nodes[static_cast<std::size_t>(node)].id);
  return ids;
}

/// The constraints that were not rejected.
std::vector<Constraint> kept_constraints(const PoseGraphReport& report) {
  return without_rejected({{}, report.graph.constraints}, report.rejected).constraints;
}

}  // namespace

double chi2_of_rounding(const std::vector<Constraint>& constraints) {
  return rounding_of(measured_of(constraints));
}

double chi2_of_rounding(const LandmarkGraph& graph) {
  std::vector<Measured> all = measured_of(graph.poses.constraints);
  const int dim = dimension(graph.poses.kind());
  for (const PosePriorConstraint& prior : graph.priors)
    all.push_back(measured(translation_of(prior.T_world_node), prior.information, dim));
  for (const PointObservation& observation : graph.observations)
    all.push_back(measured(observation.position_node,
                           observation.information.topLeftCorner(dim, dim), dim));
  return rounding_of(all);
}

std::optional<DoubtKind> doubt_of_chi2(const Chi2Fit& fit) {
  constexpr double kFar = 10;       // factor of chi2 over its expectation, or of that over chi2
  constexpr double kChance = 1e-6;  // probability of a chi2 that is as far by chance
  constexpr double kChance_sigmas = 4.753;  // the same, in standard deviations
  constexpr int kManyDof = 100;             // chi-squared is computed exactly for fewer
  const int dof = fit.degrees_of_freedom;
  if (dof <= 0) return std::nullopt;
  if (fit.chi2 > kFar * dof && chi_squared_tail(fit.chi2, dof) < kChance)
    return DoubtKind::kChi2Above;
  if (!(fit.chi2 > 0) || fit.chi2 <= fit.rounding || kFar * fit.chi2 > dof) return std::nullopt;
  const bool by_chance = dof < kManyDof
                             ? 1 - chi_squared_tail(fit.chi2, dof) > kChance
                             : fit.chi2 > dof * mean_square_quantile(-kChance_sigmas, dof);
  if (by_chance) return std::nullopt;
  return DoubtKind::kChi2Below;
}

std::string some_ids(const std::vector<NodeId>& ids) {
  constexpr std::size_t kMost = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(kMost, ids.size()); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : ", ", ids[i].value());
  if (ids.size() > kMost) text += fmt::format(" and {} more", ids.size() - kMost);
  return text;
}

Doubt not_unique(int count, const std::vector<NodeId>& vertices) {
  return {DoubtKind::kNotUnique,
          fmt::format("the minimum is not unique: the constraints leave {}{} directions free, at "
                      "{} vertices ({}); their information may have been written in another order, "
                      "or has zeros",
                      count >= FreeDirections::kMost ? "at least " : "", count, vertices.size(),
                      some_ids(vertices))};
}

Doubt doubt_about_chi2(DoubtKind kind, const Chi2Fit& fit, const std::string& rejected,
                       const std::string& advice) {
  const double ratio = fit.chi2 / std::max(1, fit.degrees_of_freedom);
  if (kind == DoubtKind::kChi2Above)
    return {kind, fmt::format("chi2 is {:.0f} times what the information of the edges lets "
                              "expect{}: it looks like false loops, or information that promises "
                              "too much{}",
                              ratio, rejected, advice)};
  return {kind, fmt::format("chi2 is far below what the information of the edges lets expect, {:.2g} "
                            "of it{}: it looks like covariances written for information, or other "
                            "units; covariances of the solution are too large by that factor",
                            ratio, rejected)};
}

std::vector<Doubt> doubts_of(const PoseGraphReport& report, RobustMethod method) {
  std::vector<Doubt> doubts;
  Chi2Fit fit{report.chi2_final, report.degrees_of_freedom, 0};
  if (doubt_of_chi2(fit) == DoubtKind::kChi2Below)
    fit.rounding = chi2_of_rounding(kept_constraints(report));
  if (const auto kind = doubt_of_chi2(fit))
    doubts.push_back(doubt_about_chi2(
        *kind, fit,
        report.rejected.empty() ? "" : " without the constraints that were rejected",
        method == RobustMethod::kAuto ? "" : " (try the robust method auto)"));
  if (report.free.count > 0)
    doubts.push_back(not_unique(report.free.count, ids_of(report.graph, report.free.nodes)));
  if (!report.loops_judged)
    doubts.push_back({DoubtKind::kLoopsNotJudged,
                      "too few loops agree to know the noise's scale: the robust method judged none "
                      "of them, and left none out"});
  return doubts;
}

}  // namespace placegraph
