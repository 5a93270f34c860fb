#include <placegraph/frontend/lines/line_triangulation.h>
#include <placegraph/frontend/places/verification/loop_refinement.h>
#include <placegraph/frontend/relative_pose/epipolar_error.h>
#include <placegraph/graph/core/median.h>

#include <Eigen/Cholesky>
#include <cmath>

namespace placegraph {
namespace {

/// H step = -g of Huber-weighted pixel errors.
struct NormalEquations {
  double huber_px;
  Matrix7d H = Matrix7d::Zero();
  Vector7d g = Vector7d::Zero();
  double sum = 0, weights = 0;

  template <int kRows>
  void add(const Eigen::Matrix<double, kRows, 1>& r, const Eigen::Matrix<double, kRows, 7>& J) {
    const double weight = r.norm() > huber_px ? huber_px / r.norm() : 1;
    H.noalias() += weight * J.transpose() * J;
    g.noalias() += weight * J.transpose() * r;
    sum += weight * r.squaredNorm();
    weights += kRows * weight;
  }
};

class Residuals {
 public:
  Residuals(const Camera& camera, const Sim3& S_match_query)
      : camera_(camera),
        S_match_query_(S_match_query),
        S_query_match_(S_match_query.inverse()),
        T_match_query_(S_match_query.rotation(), S_match_query.translation()),
        sR_match_query_(S_match_query.scale() * S_match_query.rotation().matrix()),
        epipolar_(camera, T_match_query_) {}

  void add(const LoopPoint& point, NormalEquations& equations) const {
    Eigen::Matrix<double, 3, 7> J;
    if (point.point_match) {
      const Eigen::Vector3d p_query = S_query_match_ * *point.point_match;
      J << -Eigen::Matrix3d::Identity(), hat(p_query), -p_query;
      add_reprojection(p_query, point.px_query, J, equations);
    }
    if (point.point_query) {
      const Eigen::Vector3d& p = *point.point_query;
      J << sR_match_query_, -sR_match_query_ * hat(p), sR_match_query_ * p;
      add_reprojection(S_match_query_ * p, point.px_match, J, equations);
    }
    if (!point.point_match && !point.point_query) add_epipolar(point, equations);
  }

  void add(const LoopLine& line, NormalEquations& equations) const {
    Eigen::Matrix<double, 2, 6> J_pose;
    const auto r = line_residual_px(camera_, T_match_query_, line.line_match,
                                    line.seen_by_query.start, line.seen_by_query.end, &J_pose);
    if (r) equations.add<2>(*r, by_similarity<2>(J_pose));
  }

 private:
  /// Converts a derivative by the right tangent of T_match_query to one by that of S_match_query:
  /// the translation is in the query's scale, and a change of scale does not move the camera.
  template <int kRows>
  Eigen::Matrix<double, kRows, 7> by_similarity(
      const Eigen::Matrix<double, kRows, 6>& J_pose) const {
    Eigen::Matrix<double, kRows, 7> J = Eigen::Matrix<double, kRows, 7>::Zero();
    J.template leftCols<3>() = S_match_query_.scale() * J_pose.template leftCols<3>();
    J.template middleCols<3>(3) = J_pose.template rightCols<3>();
    return J;
  }

  void add_reprojection(const Eigen::Vector3d& point_cam, const Eigen::Vector2d& px,
                        const Eigen::Matrix<double, 3, 7>& J_cam_xi,
                        NormalEquations& equations) const {
    Eigen::Matrix<double, 2, 3> J_px_cam;
    const auto projected = camera_.project(point_cam, &J_px_cam);
    if (projected) equations.add<2>(*projected - px, J_px_cam * J_cam_xi);
  }

  void add_epipolar(const LoopPoint& point, NormalEquations& equations) const {
    const auto x_match = camera_.unproject(point.px_match),
               x_query = camera_.unproject(point.px_query);
    if (!x_match || !x_query) return;
    Eigen::Matrix<double, 1, 6> J;
    const double r = epipolar_(*x_match, *x_query, &J);
    if (std::isfinite(r) && J.allFinite())
      equations.add<1>(Eigen::Matrix<double, 1, 1>(r), by_similarity<1>(J));
  }

  const Camera& camera_;
  Sim3 S_match_query_, S_query_match_;
  SE3 T_match_query_;
  Eigen::Matrix3d sR_match_query_;
  EpipolarError epipolar_;
};

}  // namespace

LoopRefinement refine_loop(const Camera& camera, const LoopEvidence& evidence, const Sim3& start,
                           double huber_px, bool free_scale) {
  LoopRefinement result{start};
  const Eigen::Index dof = free_scale ? 7 : 6;
  for (int iteration = 0; iteration < 10; ++iteration) {
    const Residuals residuals(camera, result.S_match_query);
    NormalEquations equations{huber_px};
    for (const LoopPoint& point : evidence.points) residuals.add(point, equations);
    for (const LoopLine& line : evidence.lines) residuals.add(line, equations);
    result.normal.setZero();
    result.normal.topLeftCorner(dof, dof) = equations.H.topLeftCorner(dof, dof);
    result.rmse_px = equations.weights > 0 ? std::sqrt(equations.sum / equations.weights) : 0;
    Eigen::MatrixXd damped = equations.H.topLeftCorner(dof, dof);
    damped.diagonal().array() += 1e-9 * damped.trace();
    Vector7d step = Vector7d::Zero();
    step.head(dof) = -damped.ldlt().solve(equations.g.head(dof));
    if (!step.allFinite()) break;
    result.S_match_query = result.S_match_query.plus(step);
    if (step.norm() < 1e-8) break;
  }
  return result;
}

std::optional<double> median_log_ratio(const std::vector<LoopPoint>& points,
                                       const SE3& T_query_match) {
  // Ratios with a median, as kMinDepths. Chosen.
  constexpr std::size_t kFewest = 8;
  std::vector<double> log_ratios;
  for (const LoopPoint& point : points) {
    if (!point.point_match || !point.point_query) continue;
    const double z = (T_query_match * *point.point_match).z();
    if (z > 0 && point.point_query->z() > 0)
      log_ratios.push_back(std::log(point.point_query->z() / z));
  }
  if (log_ratios.size() < kFewest) return std::nullopt;
  return median_of(std::move(log_ratios));
}

}  // namespace placegraph
