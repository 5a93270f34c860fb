#pragma once
#include <placegraph/frontend/planes/ground_plane.h>
#include <placegraph/pipeline/cues/cue_options.h>
#include <placegraph/pipeline/cues/ground_mask.h>

#include <deque>
#include <optional>

namespace placegraph {

/// Metric scale from the ground: tracks the plane under a camera of known height over pairs of
/// images and estimates the true length of a motion. The mean normal in the camera (pitch and roll
/// of the mounting) is estimated, never given. The ground before the front one of the two cameras,
/// which both images show, is compared: that of a camera which moves backwards is the old one.
class GroundPlaneScale {
 public:
  GroundPlaneScale(const GroundPlaneScaleOptions& options, const Camera& camera,
                   double camera_height_m);

  struct ScaleMeasurement {
    double factor = 1;  ///< true length = factor * |t| of the given motion
    double sigma_relative = 1;
  };
  /// Estimates the factor of a motion whose scale is unknown; nothing if the ground provides no
  /// estimate. `observation`: ground mask of the new image.
  std::optional<ScaleMeasurement> find(const Image& image_new, const Image& image_old,
                                       const SE3& T_old_new, const GroundMask& observation = {});
  /// Estimates the factor of a motion whose scale is approximately correct.
  std::optional<ScaleMeasurement> follow(const Image& image_new, const Image& image_old,
                                         const SE3& T_old_new, const GroundMask& observation = {});
  /// Whether a level floor may be the ground: its normal agrees with the estimated mounting of the
  /// camera within the uncertainty.
  bool may_be_ground(const Eigen::Vector3d& level) const;
  /// Outline of the ground region in the image.
  std::vector<Eigen::Vector2d> outline_px() const;
  double min_baseline_m() const { return options_.min_baseline_heights * camera_height_m_; }
  /// Mean ground plane in the camera frame, at the camera's height.
  Plane plane_cam() const { return {normal_cam_, camera_height_m_}; }

 private:
  struct Views {
    Image ref, cur;
    SE3 T_cur_ref;
  };
  Views views(const Image& image_new, const Image& image_old, const SE3& T_old_new,
              const GroundMask& observation) const;
  std::optional<ScaleMeasurement> accept(const GroundPlaneResult& found);
  double sigma_of_view_rad() const;
  GroundPlanePrior prior(const GroundMask& observation) const;
  void learn(const GroundPlaneResult& found);

  GroundPlaneScaleOptions options_;
  Camera camera_;
  double camera_height_m_;
  Eigen::Vector3d normal_cam_ = Eigen::Vector3d::UnitY();
  double normal_variance_rad2_;
  std::deque<double> recent_log_factors_;
};

}  // namespace placegraph
