#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/scene/scene_model.h>

#include <optional>

namespace [[gnu::visibility("default")]] placegraph {

/// Camera above level ground.
struct GroundView {
  Camera camera;                                    ///< without distortion
  Eigen::Vector3d down = Eigen::Vector3d::UnitY();  ///< unit vector, camera frame
  double height_m = 1.5;                            ///< height of the camera above the ground
};

/// Ground point of a pixel, X = h r / (n^T r) for its ray r [m, camera frame].
///
/// No result on and above the horizon.
std::optional<Eigen::Vector3d> ground_point(const GroundView& view, const Eigen::Vector2d& px);

/// Ground point at `right_m` and `forward_m` from the foot of the camera.
///
/// Ahead is its viewing direction.
Eigen::Vector3d ground_place(const GroundView& view, double right_m, double forward_m);

/// Distances over the ground for all pixels of an image (automatic photo pop-up).
struct PopUp {
  /// CV_32FC1 [m]: distance over the ground of each pixel's surface; 0 for unknown, infinity in the
  /// sky.
  Image distance;
};

/// Computes the distances from the surfaces of an image.
///
/// Ground pixels are on the ground. Verticals and objects are at the distance of the ground at
/// their foot in the same column. If their foot is hidden, their distance is interpolated from the
/// columns beside (inverse distances), but behind the hiding object. Nothing except the sky is
/// farther than `farthest_m`. `surfaces`: CV_8UC1 (Surface), of the camera's size. Throws
/// ArgumentError for another size or a height that is not positive.
PopUp pop_up(const Image& surfaces, const GroundView& view, double farthest_m = 100);

/// Point of a pixel by its distance over the ground [m, camera frame].
///
/// Nothing without a distance.
std::optional<Eigen::Vector3d> popped_point(const PopUp& popup, const GroundView& view, int u,
                                            int v);

/// Upright box on the ground, aligned with the camera's directions.
struct StandingBox {
  double right_m = 0, forward_m = 10;  ///< middle of its base
  double width_m = 1, depth_m = 1, tall_m = 1;
};

/// Draws the box into a copy of the image (CV_8UC3) where nothing nearer hides it.
///
/// `hidden`, if given, receives CV_8UC1: 0 outside of the box, 128 where the box is hidden, 255
/// where it is visible. Throws ArgumentError if the box reaches behind the camera.
Image overlay_box(const Image& bgr, const PopUp& popup, const GroundView& view,
                  const StandingBox& box, Image* hidden = nullptr);

}  // namespace placegraph
