#include <placegraph/pipeline/cues/cue_options.h>

namespace placegraph {

void GroundPlaneScaleOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, GroundPlaneScaleOptions& o) {
  field.internal().group("plane", o.plane, "direct alignment of the ground");
  field.basic()("enabled", o.enabled, "use the ground plane where the camera height is known");
  field("sigma_relative", o.sigma_relative,
        "relative standard deviation of one scale, beyond that of the alignment", {0, 1});
  field.internal()("max_log_jump", o.max_log_jump,
                   "maximum distance of a used scale from the median of the last five (logarithm)",
                   {0.01, 5});
  field("mounting_sigma_deg", o.mounting_sigma_deg,
        "initial standard deviation of the camera's pitch and roll [deg]", {0.01, 45});
  field("pitching_sigma_deg", o.pitching_sigma_deg,
        "standard deviation of one frame's pitch and roll about their mean [deg]", {0.01, 45});
  field("min_baseline_heights", o.min_baseline_heights,
        "minimum translation between the two frames, in camera heights", {0.01, 10});
  field.retired({{"mounting_drift_deg", 0.03}, {"level_sigma_deg", 0.03}});
}

void FloorLineScaleOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, FloorLineScaleOptions& o) {
  field.internal().group("floor", o.floor, "selection of the lines on the floor");
  field("sigma_relative", o.sigma_relative,
        "relative standard deviation of one height, beyond that of its lines", {0, 1});
  field.internal()("max_sigma_at_first", o.max_sigma_at_first,
                   "maximum relative standard deviation of the height for the first scale",
                   {0.001, 1});
  field.retired({{"max_log_jump", 0.12}});
}

void LineCueOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LineCueOptions& o) {
  field.group("tracker", o.tracker, "tracking of lines");
  field.internal().group("stereo", o.stereo, "matching of lines in the right image");
  field.internal().group("triangulation", o.triangulation,
                         "conditions for the triangulation of a line");
  field.internal().group("pose", o.pose, "pose of a frame from lines");
  field.internal().formerly("start").group("initialization", o.initializer,
                                           "first keyframes of a monocular camera without points");
  field.group("floor", o.floor, "metric scale from lines on the floor, without points");
  field.internal().formerly("alike_sightings")(
      "similar_observations", o.similar_observations,
      "observations of an edge in the window that count as one independent one", {1, 1000});
  field("outlier_px", o.outlier_px, "residual above which a line is removed [px]", {0.5, 100});
  field.retired({{"sigma_floor_px", 0.15},
                 {"min_rotation_steered_deg", 0.4},
                 {"min_turn_steered_deg", 0.4},
                 {"stay_frames", 10}});
}

void visit(OptionVisitor& field, ManhattanFrameOptions& o) {
  field("correlation", o.correlation, "number of neighbouring keyframes that count as one",
        {1, 1000});
  field("persistence", o.persistence,
        "keyframes of the window that must observe a new Manhattan frame", {1, 1000});
  field.formerly("max_worlds")("max_count", o.max_count,
                               "maximum number; the one unobserved for longest is removed",
                               {1, 100});
  field.retired({{"sigma_floor_deg", 0.1}, {"sigma_drift_deg", 1}});
}

void ManhattanCueOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, ManhattanCueOptions& o) {
  field.internal().group("segments", o.segments, "detection of straight edges");
  field.internal().group("directions", o.directions,
                         "detection of vanishing points and Manhattan frames");
  field.internal().formerly("worlds").group("frames", o.frames,
                                            "Manhattan frames of the sliding window");
  field("max_width_px", o.max_width_px, "image width above which images are halved first [px]",
        {16, 1e5});
  field("max_sigma_deg", o.max_sigma_deg, "maximum standard deviation of used directions [deg]",
        {0.01, 30});
  field.internal()("few_points", o.few_points,
                   "inliers below which frames also take their rotation from Manhattan frames",
                   {0, 1e6});
}

void PlaneLandmarkOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PlaneLandmarkOptions& o) {
  field.basic()("enabled", o.enabled, "planes in the depth images of keyframes as landmarks");
  field.internal().group("depth", o.depth, "detection of planes in a depth image");
  field.internal()("correlation", o.correlation,
                   "number of neighbouring keyframes that count as one", {1, 1000});
  field("drift_deg", o.drift_deg,
        "standard deviation of a normal, beyond the window's covariance [deg]", {0, 10});
  field("drift_m", o.drift_m,
        "standard deviation of a distance, beyond the window's covariance [m]", {0, 10});
  field("min_overlap", o.min_overlap,
        "minimum overlap of plane and landmark, as a share of the smaller one", {0, 1});
  field("patience", o.patience, "keyframes for which an unobserved landmark is kept", {0, 100000});
  field("max_landmarks", o.max_landmarks,
        "maximum number; the one unobserved for longest is removed", {1, 1000});
}

void DirectCueOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, DirectCueOptions& o) {
  field.internal().group("surface", o.surface, "ground under a vehicle, from depths");
  field.internal().group("planes", o.planes, "fit of planes to the depths of the whole image");
  field.internal().group("align", o.align, "direct alignment of surfaces");
  field("depths", o.depths, "number of depths measured over the image to find planes",
        {50, 1000000});
  field("max_planes", o.max_planes, "maximum number of planes aligned at once", {1, 50});
  field("min_plane_share", o.min_plane_share, "minimum share of the depths that support a plane",
        {0, 1});
  field("keyframe_share", o.keyframe_share,
        "share of the samples in view or inlying below which a keyframe is created", {0, 1});
  field.retired({{"evenness_distance", 0.005},
                 {"evenness_deg", 0.1},
                 {"nodding_deg", 0.4},
                 {"sigma_height", 0.01},
                 {"max_disagreement", 5}});
}

}  // namespace placegraph
