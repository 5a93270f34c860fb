#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/measurements/data_note.h>

#include <optional>

namespace placegraph {

/// What a camera on a vehicle turned about, over a trajectory of it: sums over steps of a fiftieth
/// of the way [deg].
struct Turns {
  double about_x_deg = 0;  ///< of the image: pitch of an upright camera
  double about_y_deg = 0;  ///< heading of an upright camera
};
Turns turns_of(const Trajectory& trajectory);

/// Whether a camera whose height gives the scale may lie on its side, so that what is below in its
/// images is no ground and lengths are in doubt: it turns about its x axis as vehicles turn about
/// the vertical, or its images are higher than wide and it does not turn about its y axis clearly.
/// EXIF orientation is not applied, so images of a phone may be so.
std::optional<DataNote> odd_posture(const Camera& camera, const Turns& turns);

/// A camera that is faster than any vehicle or hand (a median of 100 m/s): its baseline, depth unit
/// or height, or the unit of its times, cannot be right.
std::optional<DataNote> odd_speed(const Trajectory& trajectory);

}  // namespace placegraph
