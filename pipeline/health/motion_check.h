#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/map.h>
#include <placegraph/graph/measurements/data_note.h>

#include <optional>

namespace placegraph {

/// Accumulated rotation of a camera on a vehicle, summed over steps of a fiftieth of the path
/// length [deg].
struct Rotations {
  double about_x_deg = 0;  ///< rotation about the image's x axis: pitch of an upright camera
  double about_y_deg = 0;  ///< rotation about the image's y axis: heading of an upright camera
};
Rotations rotations_of(const Trajectory& trajectory);

/// Reports whether a camera whose height provides the scale may be mounted on its side, so that the
/// lower part of its images does not show the ground and the scale is in doubt. Evidence: it
/// rotates about its x axis as vehicles rotate about the vertical, or its images are higher than
/// wide and it does not clearly rotate about its y axis. This occurs with images of a phone,
/// because EXIF orientation is not applied.
std::optional<DataNote> odd_posture(const Camera& camera, const Rotations& rotations);

/// Distance of the nearest landmarks on each side of the trajectory, in camera heights: the lowest
/// quintile of the distances perpendicular to the trajectory, over landmarks ahead of keyframes
/// that move along their optical axis. Negative if there are fewer than thirty landmarks.
struct NearestSides {
  double below = -1, nearest_other = -1;
  double on_ground = 0;  ///< share of the landmarks below that are 0.9 to 1.1 heights away
  /// Whether the nearest landmarks below are about as far away as the ground, and no others are
  /// nearer.
  bool are_upright() const { return below > 0.9 && nearest_other > 1; }
};
NearestSides nearest_sides(const Map& map, double camera_height_m);

/// Reports that the surface below the camera cannot be the ground: landmarks on another side are
/// nearer than six tenths of the height, and those below are nearer than eight tenths, while the
/// ground is at one and less than a third of those below lie on it. This is the case for cameras on
/// their side or upside down.
std::optional<DataNote> odd_sides(const NearestSides& sides);

/// Reports that the ground is not where the camera height lets expect it, for a sensor that
/// measures the scale itself: the nearest landmarks below are nearer than 0.55 of the height (what
/// stands on the ground is nearer than the ground) or farther than 1.4 of it. Nothing if too few
/// are below.
std::optional<DataNote> odd_height(const NearestSides& sides, Sensor sensor,
                                   double camera_height_m);

/// Median depth of a component's landmarks in the cameras of their keyframes, in the unit of the
/// component's poses; 0 without landmarks.
double landmark_depth(const Map& map, int component);

/// Reports frames whose position jumps: the step from the frame before is longer than five times
/// each of the two steps before and after it, than three times nine tenths of all steps, and than
/// a hundredth of `landmark_depth`. What is shorter the images hardly show: where the camera turns
/// at the place, the correction by a loop is longer than all steps.
std::optional<DataNote> odd_steps(const Trajectory& trajectory, double landmark_depth);

/// Reports a camera that moves to and fro from frame to frame, as if images had changed places: a
/// tenth of the steps that are no shorter than half of the median are opposite to the one before,
/// though it gets on, and the rotation does not go on. Nothing for a camera that trembles at one
/// place, or in a hand that turns it.
std::optional<DataNote> odd_order(const Trajectory& trajectory);

/// Reports a camera that is faster than any vehicle or hand (a median of 100 m/s), so that its
/// baseline, depth unit, height or time unit cannot be correct. Nothing if all time stamps are
/// multiples of a tenth of a second, as in recordings without time stamps (kDefaultRateHz).
std::optional<DataNote> odd_speed(const Trajectory& trajectory);

}  // namespace placegraph
