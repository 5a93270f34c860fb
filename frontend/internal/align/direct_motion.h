#pragma once
#include <placegraph/frontend/internal/align/particle_swarm.h>
#include <placegraph/frontend/planes/plane_options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>

#include <vector>

namespace placegraph {

/// A plane n^T X = d of the reference view, and where it is seen.
struct SurfacePatch {
  Eigen::Vector3d g_ref = Eigen::Vector3d::Zero();  ///< n / d [1/m]; zero: at infinity
  Eigen::Matrix3d g_covariance = Eigen::Matrix3d::Zero();
  std::vector<Eigen::Vector2f> support_px;  ///< pixels known to lie on it
  double reach_px = 4;                      ///< so far around them, in rows and columns, as well
};

/// The reference view of an alignment: of every level of its pyramid, the pixels of each cell of
/// the planes that have the greatest gradients.
class DirectReference {
 public:
  struct Sample {
    Eigen::Vector3d ray_ref;   ///< z = 1
    Eigen::Vector2d gradient;  ///< [grey per pixel of the level]
    double grey;
    int patch, tile;
  };

  DirectReference() = default;
  /// `pyramid`: grey_pyramid of the view. Camera without distortion.
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

/// What is known of the motion beforehand.
struct MotionGuess {
  SE3 T_ref_cur;
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
};

struct DirectMotion {
  Outcome outcome;
  SE3 T_ref_cur;
  Eigen::Matrix<double, 6, 6> covariance;  ///< right tangent, [translation, rotation]
  struct PlaneFit {
    Eigen::Vector3d g_ref;         ///< corrected
    Eigen::Matrix3d g_covariance;  ///< of it, what was known beforehand included
    double gain = 1, bias = 0;
    int visible = 0;
    double inlier_share = 0;
  };
  std::vector<PlaneFit> planes;  ///< of the reference's patches
  double agreement = 0, visible_share = 0, inlier_share = 0;
  double last_step_px = 0;
  int iterations = 0;
  struct Seen {
    Eigen::Vector2d px_cur;
    double residual_sigmas;
  };
  std::vector<Seen> seen;  ///< samples of the finest level
};

/// The one motion under which all planes of a reference are seen in another image: over the samples
/// of plane k, I_cur(p(T, g_k)) = gain_k I_ref + bias_k with the pixel p of R ray + t (g_k^T ray)
/// (plane-induced homography, Siddiqui 2014, 2.4.2) is solved for the motion (6), gains and biases,
/// and the planes' g_k = n / d (3 each) within what is known of them, by efficient second-order
/// minimization (Benhimane & Malis 2007) with Tukey weights, coarse to fine. The covariance is
/// H^-1 M H^-1 with the scores summed over tiles before they are squared, so that residuals may be
/// correlated within a tile (Liang & Zeger 1986; Huber's sandwich), never less than independent
/// ones would give, and with the planes' uncertainty in it. Outcomes: too few data (samples in
/// view), degenerate (a direction of the motion is not seen), inconsistent (what is seen is not
/// what the planes look like), not converged.
[[nodiscard]] DirectMotion align_motion(const DirectReference& reference,
                                        const std::vector<Image>& pyramid_cur,
                                        const SE3& T_ref_cur_start, const MotionGuess& guess,
                                        const DirectMotionOptions& options);

/// Where a motion may be that deviates from `T_ref_cur` by `sigmas` [translation, rotation]: the
/// best of a particle swarm by the correlation of a coarse level.
SE3 search_motion(const DirectReference& reference, const std::vector<Image>& pyramid_cur,
                  const SE3& T_ref_cur, const Eigen::Matrix<double, 6, 1>& sigmas,
                  const DirectMotionOptions& options);

}  // namespace placegraph
