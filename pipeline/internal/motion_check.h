#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/map.h>
#include <placegraph/graph/measurements/data_note.h>

#include <optional>

namespace placegraph {

/// What a camera on a vehicle turned about, over a trajectory of it: sums over steps of a fiftieth
/// of the way [deg].
struct Rotations {
  double about_x_deg = 0;  ///< of the image: pitch of an upright camera
  double about_y_deg = 0;  ///< heading of an upright camera
};
Rotations rotations_of(const Trajectory& trajectory);

/// Whether a camera whose height gives the scale may lie on its side, so that what is below in its
/// images is no ground and lengths are in doubt: it turns about its x axis as vehicles turn about
/// the vertical, or its images are higher than wide and it does not turn about its y axis clearly.
/// EXIF orientation is not applied, so images of a phone may be so.
std::optional<DataNote> odd_posture(const Camera& camera, const Rotations& rotations);

/// How near landmarks come on each side of the way, in camera heights: the lowest fifth of their
/// distances across it, of landmarks ahead of keyframes that move along their optical axis.
/// Negative where fewer than thirty tell.
struct NearestSides {
  double below = -1, nearest_other = -1;
  /// Something as far below as the ground is to be, and nothing nearer elsewhere.
  bool are_upright() const { return below > 0.9 && nearest_other > 1; }
};
NearestSides nearest_sides(const Map& map, double camera_height_m);

/// What the height was taken for cannot be the ground: something other than what is below comes
/// nearer than six tenths of the height, and what is below nearer than eight tenths, where the
/// ground is at one. So it is for cameras on their side or upside down.
std::optional<DataNote> odd_sides(const NearestSides& sides);

/// A camera that is faster than any vehicle or hand (a median of 100 m/s): its baseline, depth unit
/// or height, or the unit of its times, cannot be right. Nothing where all times
/// are whole tenths of a second, as those that recordings without times get (kDefaultRateHz).
std::optional<DataNote> odd_speed(const Trajectory& trajectory);

}  // namespace placegraph
