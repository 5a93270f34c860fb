#pragma once
#include <placegraph/frontend/planes/ground_plane.h>

#include <optional>

namespace placegraph {

struct GroundScaleOptions {
  GroundPlaneOptions plane;
  bool enabled = true;           ///< use the ground plane where the camera height is known
  double sigma_relative = 0.03;  ///< of a single scale: unevenness of the road, added to its noise
  double max_log_deviation = 0.25;  ///< from the present scale; more is not believed
  double normal_gain = 0.1;         ///< of the slow filter on the mean normal (pitch and roll)
  void check() const;
};
void visit(OptionVisitor& field, GroundScaleOptions& options);

/// Metric scale from the ground: follows the plane under a camera of known height over pairs of
/// views and says what a motion's true length is. The mean normal in the camera (mounting pitch and
/// roll) is estimated, never given.
class GroundScale {
 public:
  GroundScale(const GroundScaleOptions& options, const Camera& camera, double camera_height_m);

  struct Length {
    double factor = 1;  ///< true length = factor * |t| of the motion handed over
    double sigma_relative = 1;
  };
  /// For a motion whose scale is unknown; nothing if the road says nothing.
  std::optional<Length> find(const Image& image_new, const Image& image_old, const SE3& T_old_new);
  /// For a motion whose scale is roughly right.
  std::optional<Length> follow(const Image& image_new, const Image& image_old,
                               const SE3& T_old_new);
  /// Mean ground plane in the camera frame, at the camera's height.
  Plane plane_cam() const { return {normal_cam_, camera_height_m_}; }

 private:
  void learn(const Eigen::Vector3d& normal_cam);
  GroundScaleOptions options_;
  Camera camera_;
  double camera_height_m_;
  Eigen::Vector3d normal_cam_ = Eigen::Vector3d::UnitY();
  int learned_ = 0;
  int refused_ = 0;  // in a row
};

}  // namespace placegraph
