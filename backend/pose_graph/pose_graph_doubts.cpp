#include <fmt/format.h>
#include <placegraph/backend/pose_graph/pose_graph_doubts.h>
#include <placegraph/backend/pose_graph/pose_graph_report.h>
#include <placegraph/graph/core/chi_squared.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace placegraph {
namespace {

Eigen::Vector3d translation_of(const Pose& pose) {
  if (const SE2* T = std::get_if<SE2>(&pose))
    return {T->translation().x(), T->translation().y(), 0};
  if (const SE3* T = std::get_if<SE3>(&pose)) return T->translation();
  return std::get<Sim3>(pose).translation();
}

/// What was measured, and the weight of its errors.
struct Measured {
  Eigen::Vector3d translation;  ///< [m]
  int dim, rest;                ///< components of the translation, and of rotation and scale
  double weight, rest_weight;   ///< traces of their information
};

Measured measured(const Eigen::Vector3d& translation,
                  const Eigen::Ref<const Eigen::MatrixXd>& information, int dim) {
  const double all = information.trace(), own = information.topLeftCorner(dim, dim).trace();
  return {translation, dim, static_cast<int>(information.rows()) - dim, own, all - own};
}

int dimension(PoseKind kind) { return kind == PoseKind::kSE2 ? 2 : 3; }

std::vector<Measured> measured_of(const std::vector<Constraint>& constraints,
                                  const std::vector<char>& left_out) {
  std::vector<Measured> all;
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    const Constraint& constraint = constraints[i];
    if (!left_out.empty() && left_out[i]) continue;
    if (const auto* edge = std::get_if<RelativePoseConstraint>(&constraint))
      all.push_back(measured(translation_of(edge->T_from_to), edge->information,
                             dimension(kind_of(edge->T_from_to))));
    else if (const auto* position = std::get_if<PositionConstraint>(&constraint))
      all.push_back(measured(position->position_world, position->information, 3));
  }
  return all;
}

constexpr int kMostDigits = 7;  // a measurement is not better than a millionth

/// The power of ten of a number's first digit, for positive numbers.
double unit_of(double x) {
  double unit = 1;
  while (unit > x) unit /= 10;
  while (unit * 10 <= x) unit *= 10;
  return unit;
}

/// Number of significant digits of a positive number in decimal notation, at most kMostDigits.
int significant_digits(double x) {
  auto mantissa = static_cast<std::int64_t>(std::llround(x / unit_of(x) * 1e6));
  int digits = kMostDigits;
  for (; digits > 1 && mantissa % 10 == 0; mantissa /= 10) --digits;
  return digits;
}

/// How measurements are rounded, by their translations: to a number of decimals, or of digits.
/// The rounding of a number is at most that of both.
struct Rounding {
  double decimal = 0;  ///< unit of the last decimal place
  double digit = 0;    ///< unit of the last digit as a share of that of the first one

  double unit(double largest) const {
    return std::max(decimal, largest > 0 ? digit * unit_of(largest) : 0);
  }
};

Rounding rounding_of(const std::vector<Measured>& all) {
  constexpr std::size_t kRead = 200;  // measurements whose digits show how the file is written
  int most = 1;
  double finest = 1;
  for (std::size_t i = 0; i < all.size(); i += 1 + all.size() / kRead)
    for (const double x : all[i].translation.cwiseAbs()) {
      if (!(x > 0) || !std::isfinite(x)) continue;
      const int digits = significant_digits(x);
      most = std::max(most, digits);
      finest = std::min(finest, unit_of(x) * std::pow(10, 1 - digits));
    }
  return {finest, std::pow(10, 1 - most)};
}

double chi2_of_rounding(const std::vector<Measured>& all) {
  const Rounding rounding = rounding_of(all);
  double bound = 0;
  // e^T Omega e <= trace(Omega) |e|^2 for the translation and for the rest, and twice that for
  // both. A component is off by half a unit; a quaternion's by half of what the rotation is.
  const double rest = rounding.unit(1);
  for (const Measured& each : all) {
    const double translation = 0.5 * rounding.unit(each.translation.cwiseAbs().maxCoeff());
    bound += 2 * each.dim * translation * translation * each.weight +
             2 * each.rest * rest * rest * each.rest_weight;
  }
  return bound;
}

std::vector<NodeId> ids_of(const PoseGraph& graph, const std::vector<int>& nodes) {
  std::vector<NodeId> ids;
  for (const int node : nodes) ids.push_back(graph.nodes[static_cast<std::size_t>(node)].id);
  return ids;
}

}  // namespace

double chi2_of_rounding(const std::vector<Constraint>& constraints,
                        const std::vector<char>& left_out) {
  return chi2_of_rounding(measured_of(constraints, left_out));
}

double chi2_of_rounding(const LandmarkGraph& graph) {
  std::vector<Measured> all = measured_of(graph.poses.constraints, {});
  const int dim = dimension(graph.poses.kind());
  for (const PosePriorConstraint& prior : graph.priors)
    all.push_back(measured(translation_of(prior.T_world_node), prior.information, dim));
  for (const PointObservation& observation : graph.observations)
    all.push_back(
        measured(observation.position_node, observation.information.topLeftCorner(dim, dim), dim));
  return chi2_of_rounding(all);
}

std::optional<DoubtKind> doubt_of_chi2(const Chi2Fit& fit) {
  constexpr double kFar = 10;       // factor of chi2 over its expectation, or of that over chi2
  constexpr double kMuch = 3;       // the same if one constraint stands out
  constexpr double kChance = 1e-6;  // probability of a chi2 that is as far by chance
  constexpr double kChance_sigmas = 4.753;  // the same, in standard deviations
  constexpr int kManyDof = 100;             // chi-squared is computed exactly for fewer
  const int dof = fit.degrees_of_freedom;
  if (dof <= 0) return std::nullopt;
  const double ratio = fit.chi2 / dof;
  const bool one_stands_out =
      ratio > kMuch && fit.largest > 0 &&
      fit.constraints * chi_squared_tail(fit.largest / ratio, fit.dimension) < kChance;
  if ((ratio > kFar || one_stands_out) && chi_squared_tail(fit.chi2, dof) < kChance)
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
    return {kind, fmt::format("chi2 is {:.{}f} times what the information of the edges lets "
                              "expect{}: it looks like false loops, or information that promises "
                              "too much{}",
                              ratio, ratio < 10 ? 1 : 0, rejected, advice)};
  return {kind,
          fmt::format("chi2 is far below what the information of the edges lets expect, {:.2g} "
                      "of it{}: it looks like covariances written for information, or other "
                      "units; covariances of the solution are too large by that factor",
                      ratio, rejected)};
}

std::vector<Doubt> doubts_of(const PoseGraphReport& report, RobustMethod method) {
  std::vector<Doubt> doubts;
  std::vector<char> left_out(report.graph.constraints.size());
  for (const RejectedEdge& edge : report.rejected) left_out.at(edge.constraint) = true;
  Chi2Fit fit{.chi2 = report.chi2_final,
              .degrees_of_freedom = report.degrees_of_freedom,
              .constraints = static_cast<int>(left_out.size() - report.rejected.size()),
              .dimension = degrees_of_freedom(report.graph.kind())};
  for (std::size_t i = 0; i < report.chi2_by_constraint.size(); ++i)
    if (!left_out[i]) fit.largest = std::max(fit.largest, report.chi2_by_constraint[i]);
  if (doubt_of_chi2(fit) == DoubtKind::kChi2Below)
    fit.rounding = chi2_of_rounding(report.graph.constraints, left_out);
  if (const auto kind = doubt_of_chi2(fit))
    doubts.push_back(doubt_about_chi2(
        *kind, fit, report.rejected.empty() ? "" : " without the constraints that were rejected",
        method == RobustMethod::kAuto ? "" : " (try the robust method auto)"));
  if (report.free.count > 0)
    doubts.push_back(not_unique(report.free.count, ids_of(report.graph, report.free.nodes)));
  if (!report.loops_judged)
    doubts.push_back(
        {DoubtKind::kLoopsNotJudged,
         "too few loops agree to know the noise's scale: the robust method judged none "
         "of them, and left none out"});
  return doubts;
}

}  // namespace placegraph
