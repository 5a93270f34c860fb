#pragma once
#include <placegraph/frontend/planes/homography.h>

namespace placegraph {

/// Direction of a point's noise, which defines a plane's residual.
enum class PointNoise {
  kAlongRay,   ///< observed from the origin: the error is in the inverse depth
  kIsotropic,  ///< merged or modelled clouds: the error is in the distance from the plane
};

/// Point in the form that plane fits use.
///
/// Along the ray: `q` is the viewing ray (z = 1, or a unit vector) and `value` the inverse of the
/// depth along it [1/m]; a plane n^T X = d is value = (n/d)^T q. Isotropic: `q` is the point [m]
/// itself. `weight`: one over the variance of the value, or of the distance from the plane.
struct FitPoint {
  Eigen::Vector3d q = Eigen::Vector3d::Zero();
  double value = 0, weight = 0;
};

/// Largest deviation of a surface that counts as a plane.
///
/// Along the ray it is a share of the depth, for isotropic noise it is in metres.
struct FitModel {
  PointNoise noise = PointNoise::kAlongRay;
  double flatness = 0;
  /// Variance that neighbours have in common, like the quantization of a depth camera, over that of
  /// the noise. Averaging does not reduce it, so that it is added to the allowed deviation.
  double shared = 0;
};

/// Plane with the evidence for it.
struct FittedPlane {
  bool ok = false;                              ///< three points or more that are not collinear
  Plane plane;                                  ///< distance_m >= 0
  Eigen::Vector3d g = Eigen::Vector3d::Zero();  ///< n / d [1/m]
  double chi2 = 0;                              ///< weighted squared residuals of its points
  /// Covariance of the closest point n d [m], from the given noise (Gauss-Markov).
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// Sums over points from which any plane through them is fitted and tested without the points.
///
/// The sums of two sets can be added.
class PlaneSums {
 public:
  void add(const FitPoint& point, const FitModel& model);
  PlaneSums& operator+=(const PlaneSums& other);

  double count() const { return n_; }
  double weight() const { return w_; }
  /// Weighted mean of `q`.
  Eigen::Vector3d centre() const;
  /// Weighted least-squares plane: linear in n / d along the ray, the smallest eigenvector
  /// otherwise. `with_covariance`: also computes the covariance.
  FittedPlane fit(const FitModel& model, bool with_covariance = false) const;
  /// Weighted squared residuals against any plane.
  double misfit(const FittedPlane& plane, const FitModel& model) const;
  /// One plus the variance of the allowed deviation over that of the noise: the chi2 of points on a
  /// surface with this flatness is at most about this multiple of their number.
  double inflation(const FittedPlane& plane, const FitModel& model) const;

 private:
  Eigen::Vector3d centre_q_ = Eigen::Vector3d::Zero();
  double n_ = 0, w_ = 0, c_ = 0;
  Eigen::Vector3d v_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d M_ = Eigen::Matrix3d::Zero();
};

/// |residual| of a point over its standard deviation, including the allowed deviation.
double residual_sigmas(const FittedPlane& plane, const FitPoint& point, const FitModel& model);

/// Plane from the closest point n d of another fit, or from three points.
FittedPlane plane_through(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          const Eigen::Vector3d& c);

}  // namespace placegraph
