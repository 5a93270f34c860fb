#pragma once
#include <placegraph/frontend/internal/planes/homography.h>

namespace placegraph {

/// How the noise of a point lies, and with it what a plane's residual is.
enum class PointNoise {
  kAlongRay,   ///< seen from the origin: the inverse depth is off
  kIsotropic,  ///< merged or modelled clouds: the distance across is off
};

/// One point as plane fits take it. Along the ray: `q` is the viewing ray (z = 1, or a unit vector)
/// and `value` the inverse of the depth along it [1/m]; a plane n^T X = d is value = (n/d)^T q.
/// Isotropic: `q` is the point [m] itself. `weight`: one over the variance of the value, or of the
/// distance across.
struct FitPoint {
  Eigen::Vector3d q = Eigen::Vector3d::Zero();
  double value = 0, weight = 0;
};

/// What a surface may bend and still be called a plane: along the ray a share of the depth,
/// isotropic metres.
struct FitModel {
  PointNoise noise = PointNoise::kAlongRay;
  double flatness = 0;
  /// Variance that neighbours have in common, as the steps of a depth camera, over that of the
  /// noise. It does not average out, so planes may bend by it as well.
  double shared = 0;
};

/// A plane with the evidence for it.
struct FittedPlane {
  bool ok = false;                              ///< three points or more that are on no line
  Plane plane;                                  ///< distance_m >= 0
  Eigen::Vector3d g = Eigen::Vector3d::Zero();  ///< n / d [1/m]
  double chi2 = 0;                              ///< weighted squared residuals of its points
  /// Of the closest point n d [m], from the noise put in (Gauss-Markov).
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// Sums over points from which any plane through them is fitted and judged without looking at the
/// points again; sums of two sets add up.
class PlaneSums {
 public:
  void add(const FitPoint& point, const FitModel& model);
  PlaneSums& operator+=(const PlaneSums& other);

  double count() const { return n_; }
  double weight() const { return w_; }
  /// The mean of `q` by weight.
  Eigen::Vector3d centre() const;
  /// The weighted least-squares plane: linear in n / d along the ray, the smallest eigenvector
  /// otherwise. `with_covariance`: fills it.
  FittedPlane fit(const FitModel& model, bool with_covariance = false) const;
  /// Weighted squared residuals against any plane.
  double misfit(const FittedPlane& plane, const FitModel& model) const;
  /// One plus the variance that bending is allowed over that of the noise: a chi2 of points on a
  /// surface as flat as asked for is at most about this often their number.
  double inflation(const FittedPlane& plane, const FitModel& model) const;

 private:
  Eigen::Vector3d centre_q_ = Eigen::Vector3d::Zero();
  double n_ = 0, w_ = 0, c_ = 0;
  Eigen::Vector3d v_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d M_ = Eigen::Matrix3d::Zero();
};

/// |residual| of a point over its deviation, bending included.
double residual_sigmas(const FittedPlane& plane, const FitPoint& point, const FitModel& model);

/// The plane of the closest point n d of another fit, or of three points.
FittedPlane plane_through(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          const Eigen::Vector3d& c);

}  // namespace placegraph
