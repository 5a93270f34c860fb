#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/scene/scene_model.h>

#include <optional>

namespace placegraph {

/// A camera over level ground.
struct GroundView {
  Camera camera;                                    ///< without distortion
  Eigen::Vector3d down = Eigen::Vector3d::UnitY();  ///< unit, camera frame
  double height_m = 1.5;                            ///< of the camera above the ground
};

/// The point of the ground that a pixel shows, X = h r / (n^T r) for its ray r [m, camera frame];
/// nothing on and above the horizon.
std::optional<Eigen::Vector3d> ground_point(const GroundView& view, const Eigen::Vector2d& px);

/// The point of the ground `right_m` and `forward_m` from the foot of the camera, as it looks.
Eigen::Vector3d ground_place(const GroundView& view, double right_m, double forward_m);

/// A picture folded up: how far everything is, over the ground.
struct PopUp {
  /// CV_32FC1 [m]: distance over the ground of what each pixel shows; 0 where nothing is known,
  /// infinity in the sky.
  Image distance;
};

/// Ground pixels lie on the ground; verticals and objects stand at the distance of the ground that
/// they meet in their column, or, where something hides their foot, at the distance between those
/// of the columns beside (inverse distances interpolated), but behind what hides it; nothing is
/// farther than `farthest_m` but the sky. `surfaces`: CV_8UC1 (Surface), of the camera's size.
/// Throws ArgumentError for another size or a height that is not positive.
PopUp pop_up(const Image& surfaces, const GroundView& view, double farthest_m = 100);

/// The point of a pixel at a distance over the ground [m, camera frame]; nothing where it has none.
std::optional<Eigen::Vector3d> popped_point(const PopUp& popup, const GroundView& view, int u,
                                            int v);

/// A box on the ground, upright, its front turned to the camera's own directions.
struct StandingBox {
  double right_m = 0, forward_m = 10;  ///< middle of its foot
  double width_m = 1, depth_m = 1, tall_m = 1;
};

/// Draws the box into a copy of the picture (CV_8UC3) where nothing nearer hides it; `hidden`, if
/// given, receives CV_8UC1: 0 outside of the box, 128 where it is hidden, 255 where it is seen.
/// Throws ArgumentError if the box reaches behind the camera.
Image overlay_box(const Image& bgr, const PopUp& popup, const GroundView& view,
                  const StandingBox& box, Image* hidden = nullptr);

}  // namespace placegraph
