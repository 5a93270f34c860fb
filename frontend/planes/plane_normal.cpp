#include <placegraph/frontend/planes/plane_normal.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/chi_squared.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace placegraph {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Minimum of the sum of squares over the normals.
struct Reading {
  Vector3d normal;
  double cost = std::numeric_limits<double>::infinity();
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
};

std::optional<Vector2d> seen(const Matrix3d& H, const Vector2d& px) {
  const Vector3d q = H * px.homogeneous();
  if (!(q.z() > 1e-9)) return std::nullopt;
  return Vector2d(q.hnormalized());
}

/// Corner positions minus their predictions by the nearest motion for a plane of this normal, in
/// standard deviations; a large residual if the motion puts a corner behind the camera.
VectorXd residuals(const Matrix3d& K, const std::vector<Vector2d>& corners,
                   const std::vector<Matrix3d>& views, const Vector3d& normal, double sigma_px) {
  // Residual of a view without a motion: far above any other. Chosen.
  constexpr double kMissPx = 100;
  const auto per_view = static_cast<Eigen::Index>(2 * corners.size());
  VectorXd r(per_view * static_cast<Eigen::Index>(views.size()));
  Eigen::Index at = 0;
  for (const Matrix3d& H : views) {
    const SE3 T_cur_ref = motion_from_homography(K, H, normal);
    const Matrix3d model = homography_from_plane(K, T_cur_ref, {normal, 1});
    for (const Vector2d& corner : corners) {
      const auto measured = seen(H, corner), predicted = seen(model, corner);
      const Vector2d apart =
          measured && predicted ? Vector2d(*measured - *predicted) : Vector2d(kMissPx, kMissPx);
      r.segment<2>(at) = apart.cwiseMax(-kMissPx).cwiseMin(kMissPx) / sigma_px;
      at += 2;
    }
  }
  return r;
}

Vector3d moved(const Vector3d& normal, const Vector2d& by) {
  const Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  return (normal + by.x() * u + by.y() * v).normalized();
}

Reading refined(const Matrix3d& K, const std::vector<Vector2d>& corners,
                const std::vector<Matrix3d>& views, Vector3d normal, double sigma_px) {
  // Step of the difference quotient. Chosen, well above rounding.
  constexpr double kStep = 1e-5;
  Reading best{normal};
  double damping = 1e-6;
  for (int iteration = 0; iteration < 15; ++iteration) {
    const VectorXd r = residuals(K, corners, views, normal, sigma_px);
    best = {normal, r.squaredNorm(), Eigen::Matrix2d::Zero()};
    Eigen::MatrixXd J(r.size(), 2);
    for (int k = 0; k < 2; ++k)
      J.col(k) =
          (residuals(K, corners, views, moved(normal, kStep * Vector2d::Unit(k)), sigma_px) -
           residuals(K, corners, views, moved(normal, -kStep * Vector2d::Unit(k)), sigma_px)) /
          (2 * kStep);
    best.information = J.transpose() * J;
    bool better = false;
    for (; damping < 1e6 && !better; damping *= better ? 0.1 : 10) {
      Eigen::Matrix2d A = best.information;
      A.diagonal() *= 1 + damping;
      A.diagonal().array() += 1e-9;
      Vector2d step = -A.ldlt().solve(J.transpose() * r);
      if (step.norm() > 0.3) step *= 0.3 / step.norm();
      const Vector3d next = moved(normal, step);
      better = residuals(K, corners, views, next, sigma_px).squaredNorm() < best.cost;
      if (better) normal = next;
      if (better && step.norm() < 1e-6) return best;
    }
    if (!better) break;
  }
  return best;
}

bool faces(const Matrix3d& K, const std::vector<Vector2d>& corners, const Vector3d& normal) {
  const Matrix3d K_inverse = K.inverse();
  return std::all_of(corners.begin(), corners.end(), [&](const Vector2d& px) {
    return normal.dot(K_inverse * px.homogeneous()) > 0;
  });
}

/// Minima from every reading of every view, best first, with a distance of at least `distinct`.
std::vector<Reading> readings_of(const Matrix3d& K, const std::vector<Vector2d>& corners,
                                 const std::vector<Matrix3d>& views,
                                 const PlaneNormalOptions& options) {
  const double distinct = std::cos(deg_to_rad(options.distinct_deg));
  std::vector<Vector3d> starts;
  const auto is_new = [&](const std::vector<Vector3d>& others, const Vector3d& n) {
    return std::none_of(others.begin(), others.end(),
                        [&](const Vector3d& other) { return other.dot(n) > distinct; });
  };
  for (const Matrix3d& H : views)
    for (const HomographyMotion& motion : decompose_homography(K, H, corners))
      if (is_new(starts, motion.normal_ref)) starts.push_back(motion.normal_ref.normalized());
  std::vector<Reading> all;
  for (const Vector3d& start : starts) {
    const Reading reading = refined(K, corners, views, start, options.sigma_px);
    if (faces(K, corners, reading.normal)) all.push_back(reading);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Reading& a, const Reading& b) { return a.cost < b.cost; });
  std::vector<Reading> apart;
  std::vector<Vector3d> normals;
  for (const Reading& reading : all)
    if (is_new(normals, reading.normal)) {
      apart.push_back(reading);
      normals.push_back(reading.normal);
    }
  return apart;
}

}  // namespace

PlaneNormalEstimator::PlaneNormalEstimator(const Matrix3d& K,
                                           const std::vector<Vector2d>& corners_ref_px,
                                           const PlaneNormalOptions& options)
    : K_(K), corners_px_(corners_ref_px), options_(options), spacing_px_(options.apart_px) {
  options.check();
  require(corners_ref_px.size() >= 4, "plane normal: needs at least four corners");
}

double PlaneNormalEstimator::apart_px(const Matrix3d& Ha, const Matrix3d& Hb) const {
  double largest = 0;
  for (const Vector2d& corner : corners_px_) {
    const auto a = seen(Ha, corner), b = seen(Hb, corner);
    if (a && b) largest = std::max(largest, (*a - *b).norm());
  }
  return largest;
}

bool PlaneNormalEstimator::add(const Matrix3d& H_cur_ref) {
  for (const Vector2d& corner : corners_px_)
    if (!seen(H_cur_ref, corner)) return false;
  if (apart_px(H_cur_ref, Matrix3d::Identity()) < spacing_px_) return false;
  for (const Matrix3d& view : views_)
    if (apart_px(H_cur_ref, view) < spacing_px_) return false;
  if (static_cast<int>(views_.size()) >= options_.views) {
    // Every second view is dropped, and new ones must differ more.
    std::vector<Matrix3d> kept;
    for (std::size_t i = 0; i < views_.size(); i += 2) kept.push_back(views_[i]);
    views_ = std::move(kept);
    spacing_px_ *= 1.5;
  }
  views_.push_back(H_cur_ref);
  return true;
}

PlaneNormal PlaneNormalEstimator::estimate() const {
  using Code = Outcome::Code;
  PlaneNormal result;
  result.views = static_cast<int>(views_.size());
  if (views_.empty()) {
    result.outcome = Outcome::failure(Code::kTooFewData, "no view differs from the reference");
    return result;
  }
  const std::vector<Reading> readings = readings_of(K_, corners_px_, views_, options_);
  if (readings.empty()) {
    result.outcome = Outcome::failure(Code::kDegenerate, "no reading has the region in front");
    return result;
  }
  const Reading& best = readings.front();
  // A view has eight measurements and a motion with six parameters.
  const double freedom = std::max(1.0, 2.0 * result.views - 2);
  const double spread = std::max(1.0, best.cost / freedom);
  const double least =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(best.information).eigenvalues()[0];
  result.normal_ref = best.normal;
  result.sigma_rad =
      least > 0 ? std::sqrt(spread / least) : std::numeric_limits<double>::infinity();
  static const double chi2 = chi_squared_quantile(0.99, 2);
  if (!(result.sigma_rad < deg_to_rad(options_.max_sigma_deg)))
    result.outcome = Outcome::failure(Code::kDegenerate, "the views do not determine the normal");
  else if (readings.size() > 1 && readings[1].cost < best.cost + chi2 * spread)
    result.outcome =
        Outcome::failure(Code::kDegenerate, "two readings explain the views equally well");
  else
    result.outcome = Outcome::ok();
  return result;
}

}  // namespace placegraph
