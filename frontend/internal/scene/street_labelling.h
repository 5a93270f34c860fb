#pragma once
#include <placegraph/frontend/internal/labels/urban_geometry.h>
#include <placegraph/frontend/internal/labels/urban_labels.h>
#include <placegraph/frontend/scene/scene_options.h>
#include <placegraph/graph/scene/semantic_map.h>

#include <string>
#include <vector>

namespace placegraph {

/// What a street camera sees: labels, and the points of what stands still.
struct StreetLabelling {
  UrbanLabels labels;
  SceneView view;
  GroundProfile ground;
  KeyframeSemantics observation;  ///< regions are the superpixels
};

/// Labels the picture (BGR or grey) by both models and by where two eyes see its superpixels in
/// space (`depth_m`: CV_32FC1 of the picture's size, 0 = none; METHODS 10: height above ground,
/// normal and depth are unary terms), and projects the pixels back, X = Z K^-1 (u, v, 1)^T. Sky,
/// `moving` classes, what is farther than `max_range_m` and depths that are off their superpixel's
/// plane are left out. `camera_height_m`: above the ground, 0 where it is not known; it serves
/// where no ground is seen. Throws ArgumentError for images of other sizes, models of other kinds
/// and a moving class that the model does not have.
StreetLabelling see_street(const Image& picture, const Image& depth_m, const Camera& camera,
                           double baseline_m, double camera_height_m, const SceneModel& urban,
                           const SceneModel& surfaces, const StreetLabellingOptions& options = {});

/// Which points another image looks through: where it sees them at a pixel and all depths around
/// are farther, nothing stood there when it was taken. `depth_m` as above, of that image;
/// `T_other_cam` maps the points into its camera.
std::vector<bool> seen_through(const std::vector<SemanticPoint>& points, const SE3& T_other_cam,
                               const Image& depth_m, const Camera& camera, double baseline_m,
                               const SeenThroughOptions& options = {});

}  // namespace placegraph
