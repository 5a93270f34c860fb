#pragma once
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/pipeline/local_map/distortion_evidence.h>
#include <placegraph/pipeline/local_map/lens_distortion.h>

#include <optional>
#include <vector>

namespace placegraph {

/// View and motion of a window.
struct WindowMotion {
  SO3 R_map_cam;                                            ///< the view of its first keyframe
  Eigen::Vector3d direction_cam = Eigen::Vector3d::Zero();  ///< to its last keyframe; unit or zero
  SO3 R_first_last;                                         ///< rotation of the camera in it
  void visit_state(auto& archive) { archive(R_map_cam, direction_cam, R_first_last); }
};

/// Radial distortion by the evidence of stretches of motion.
///
/// Errors that are not noise of the points (a rolling shutter, warped patches, points that move)
/// recur as long as the camera moves in the same way, and whenever it does so again. Windows of
/// similar view and motion are therefore one stretch, whenever they occur. Each stretch has an
/// error of its own; the deviation of these errors is known in advance to a few degrees of freedom,
/// and estimated from the dispersion between the stretches.
class LensStretches {
 public:
  /// Adds evidence to the stretch of similar motion, or else to a new one.
  void add(const DistortionEvidence& evidence, const WindowMotion& motion);
  /// Adds evidence as a stretch of its own.
  void add(const DistortionEvidence& evidence);
  /// The k1 at which the evidence of a window is computed: the estimate of the points, or 0 where
  /// their noise explains it.
  double linearization() const;
  /// Mean over the stretches and a prior about 0 by a model of random effects (DerSimonian and
  /// Laird 1986).
  LensDistortion estimate() const;
  void visit_state(auto& archive) { archive(stretches_); }

 private:
  double variance_between() const;

  struct Stretch {
    std::optional<WindowMotion> motion;  // that of its first window
    DistortionEvidence evidence;
    void visit_state(auto& archive) {
      archive(motion, evidence.gradient, evidence.information, evidence.residuals);
    }
  };
  std::vector<Stretch> stretches_;
};

}  // namespace placegraph
