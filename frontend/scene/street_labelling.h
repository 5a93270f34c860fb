#pragma once
#include <placegraph/frontend/labels/joint_labels.h>
#include <placegraph/frontend/scene/street_geometry.h>
#include <placegraph/frontend/scene/street_labelling_options.h>
#include <placegraph/graph/scene/street_map.h>

#include <string>
#include <vector>

namespace placegraph {

/// Labels of a street image, and the static points in it.
struct StreetLabelling {
  JointLabels labels;
  SceneView view;
  GroundProfile ground;
  KeyframeStreetPoints observation;  ///< its regions are the superpixels
};

/// Labels the image (BGR or grey) by both models and by the stereo depths of its superpixels.
///
/// `depth_m`: CV_32FC1 of the image's size, 0 = none. METHODS 10: height above ground, normal and
/// depth are unary terms. The pixels are projected back, X = Z K^-1 (u, v, 1)^T, without sky,
/// `moving` classes, points farther than `max_range_m` and depths that disagree with their
/// superpixel's plane. `camera_height_m`: above the ground, 0 if it is unknown; it is used if no
/// ground is in the image. Throws ArgumentError for images of other sizes, models of other kinds
/// and a moving class that the model does not have.
StreetLabelling see_street(const Image& picture, const Image& depth_m, const Camera& camera,
                           double baseline_m, double camera_height_m, const SceneModel& urban,
                           const SceneModel& surfaces, const StreetLabellingOptions& options = {});

/// Whether another image sees through each point.
///
/// If all depths around a point's pixel in that image are farther than the point, it was not on a
/// surface when the image was taken. `depth_m` as above, of that image; `T_other_cam` maps the
/// points into its camera.
std::vector<bool> seen_through(const std::vector<StreetPoint>& points, const SE3& T_other_cam,
                               const Image& depth_m, const Camera& camera, double baseline_m);

}  // namespace placegraph
