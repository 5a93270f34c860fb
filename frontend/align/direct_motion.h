#pragma once
#include <placegraph/frontend/align/particle_swarm.h>
#include <placegraph/frontend/planes/plane_options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>

#include <vector>

namespace placegraph {

/// A plane n^T X = d of the reference view and its pixels.
struct SurfacePatch {
  Eigen::Vector3d g_ref = Eigen::Vector3d::Zero();  ///< n / d [1/m]; zero: at infinity
  Eigen::Matrix3d g_covariance = Eigen::Matrix3d::Zero();
  std::vector<Eigen::Vector2f> support_px;  ///< pixels on the plane
  double reach_px =
      4;  ///< pixels within this distance of those, in rows and columns, are used as well
};

/// The reference view of an alignment.
///
/// On every level of its pyramid it has the pixel with the greatest gradient of each cell of the
/// planes.
class DirectReference {
 public:
  struct Sample {
    Eigen::Vector3d ray_ref;   ///< z = 1
    Eigen::Vector2d gradient;  ///< [grey per pixel of the level]
    double grey;
    int patch, tile;
  };

  DirectReference() = default;
  /// Takes the samples from `pyramid`, the grey_pyramid of a view by a camera without distortion.
  DirectReference(const std::vector<Image>& pyramid, const Camera& camera,
                  std::vector<SurfacePatch> patches, const DirectMotionOptions& options);

  const Camera& camera() const { return camera_; }
  const std::vector<SurfacePatch>& patches() const { return patches_; }
  const std::vector<std::vector<Sample>>& levels() const { return levels_; }

 private:
  Camera camera_;
  std::vector<SurfacePatch> patches_;
  std::vector<std::vector<Sample>> levels_;
};

/// Prior of the motion.
struct MotionGuess {
  SE3 T_ref_cur;
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
};

/// Motion of the camera and planes estimated by align_motion.
struct DirectMotion {
  Outcome outcome;
  SE3 T_ref_cur;
  Eigen::Matrix<double, 6, 6> covariance;  ///< right tangent, [translation, rotation]
  struct PlaneFit {
    Eigen::Vector3d g_ref;         ///< corrected
    Eigen::Matrix3d g_covariance;  ///< covariance of g_ref, prior included
    double gain = 1, bias = 0;
    int visible = 0;
    double inlier_share = 0;
  };
  std::vector<PlaneFit> planes;  ///< one per patch of the reference
  double agreement = 0, visible_share = 0, inlier_share = 0;
  double last_step_px = 0;
  int iterations = 0;
  struct Seen {
    Eigen::Vector2d px_cur;
    double residual_sigmas;
  };
  std::vector<Seen> seen;  ///< samples of the finest level
};

/// Estimates the motion that aligns all planes of a reference with another image.
///
/// Over the samples of plane k, I_cur(p(T, g_k)) = gain_k I_ref + bias_k with the pixel p of
/// R ray + t (g_k^T ray) (plane-induced homography, Siddiqui 2014, 2.4.2) is solved for the motion
/// (6), gains and biases, and the planes' g_k = n / d (3 each, with their prior covariance), by
/// efficient second-order minimization (Benhimane & Malis 2007) with Tukey weights, coarse to fine.
/// The covariance is H^-1 M H^-1 with the scores summed over tiles before they are squared, so that
/// residuals may be correlated within a tile (Liang & Zeger 1986; Huber's sandwich). It is never
/// less than for independent residuals and includes the planes' uncertainty. Outcomes: too few data
/// (samples in view), degenerate (a direction of the motion is unobservable), inconsistent (the
/// image differs from the planes' appearance), not converged.
[[nodiscard]] DirectMotion align_motion(const DirectReference& reference,
                                        const std::vector<Image>& pyramid_cur,
                                        const SE3& T_ref_cur_start, const MotionGuess& guess);

/// Searches the motion about `T_ref_cur` within deviations `sigmas` [translation, rotation].
///
/// Returns the best particle of a swarm by the correlation on a coarse level.
SE3 search_motion(const DirectReference& reference, const std::vector<Image>& pyramid_cur,
                  const SE3& T_ref_cur, const Eigen::Matrix<double, 6, 1>& sigmas,
                  const DirectMotionOptions& options);

}  // namespace placegraph
