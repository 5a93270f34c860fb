#include <placegraph/pipeline/cues/cue_options.h>

namespace placegraph {

void GroundPlaneScaleOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, GroundPlaneScaleOptions& o) {
  field.group("plane", o.plane, "direct alignment of the road");
  field("enabled", o.enabled, "use the ground plane where the camera height is known");
  field("sigma_relative", o.sigma_relative,
        "noise of a single scale beyond that of the alignment: the road is not flat", {0, 1});
  field("max_log_jump", o.max_log_jump,
        "a scale further from the median of the last ones (in logarithm) is not believed",
        {0.01, 5});
  field("mounting_sigma_deg", o.mounting_sigma_deg,
        "pitch and roll of the camera before anything was seen", {0.01, 45});
  field("pitching_sigma_deg", o.pitching_sigma_deg, "pitch and roll of one view about the mean",
        {0.01, 45});
  field("mounting_drift_deg", o.mounting_drift_deg, "of the mean between measurements", {0, 10});
  field("level_sigma_deg", o.level_sigma_deg,
        "of a floor that edges show to be level, beside that of the edges", {0.001, 45});
  field("min_baseline_heights", o.min_baseline_heights,
        "motion between the two views, in camera heights", {0.01, 10});
}

void FloorLineScaleOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, FloorLineScaleOptions& o) {
  field.group("floor", o.floor, "which lines lie on the floor");
  field("sigma_relative", o.sigma_relative, "of a single height, beyond that of its lines", {0, 1});
  field("max_log_jump", o.max_log_jump,
        "a scale further from the median of the last ones (in logarithm) is not believed",
        {0.01, 5});
  field("max_sigma_at_first", o.max_sigma_at_first, "of the height that gives the unit, relative",
        {0.001, 1});
}

void LineCueOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LineCueOptions& o) {
  field.group("tracker", o.tracker, "lines followed over time");
  field.group("stereo", o.stereo, "lines in the right eye");
  field.group("triangulation", o.triangulation, "when a line's place is known");
  field.group("pose", o.pose, "pose of a frame from lines");
  field.group("start", o.start, "first views of a single eye without points");
  field.group("floor", o.floor, "metric scale from lines on the floor, without points");
  field("sigma_floor_px", o.sigma_floor_px, "no line is placed better across", {0.01, 10});
  field("similar_observations", o.similar_observations,
        "sightings of one edge in the window that are worth one independent one", {1, 1000});
  field("min_rotation_steered_deg", o.min_rotation_steered_deg,
        "triangulation.min_turn_deg where directions show the rotation", {0.01, 45});
  field("stay_frames", o.stay_frames,
        "an edge that the motion takes out of the image before is begun last", {0, 100});
  field("outlier_px", o.outlier_px, "a line that is missed by more is dropped", {0.5, 100});
}

void visit(OptionVisitor& field, ManhattanFrameOptions& o) {
  field("sigma_floor_deg", o.sigma_floor_deg,
        "of the directions of one view beyond the noise of its lines", {1e-3, 10});
  field("correlation", o.correlation, "so many neighbouring views count as one", {1, 1000});
  field("sigma_drift_deg", o.sigma_drift_deg,
        "of a world seen from a new keyframe, beyond what the window claims", {1e-3, 10});
  field("persistence", o.persistence, "keyframes of the window that must show a new world",
        {1, 1000});
  field("max_frames", o.max_frames, "remembered; the one unseen for longest is forgotten",
        {1, 100});
}

void ManhattanCueOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, ManhattanCueOptions& o) {
  field.group("segments", o.segments, "straight edges");
  field.group("directions", o.directions, "vanishing points and rectangular worlds");
  field.group("manhattan_frames", o.manhattan_frames, "the worlds of the window");
  field("max_width_px", o.max_width_px, "wider images are halved first", {16, 1e5});
  field("max_sigma_deg", o.max_sigma_deg, "directions known less well are not believed",
        {0.01, 30});
  field("few_points", o.few_points,
        "a frame between keyframes that is posed by fewer is turned by the worlds, too", {0, 1e6});
}

void PlaneLandmarkOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PlaneLandmarkOptions& o) {
  field("enabled", o.enabled, "walls, floors and tables in the depth of keyframes as landmarks");
  field.group("depth", o.depth, "planes of a depth image");
  field("correlation", o.correlation, "so many neighbouring views count as one", {1, 1000});
  field("drift_deg", o.drift_deg,
        "of a plane seen from a new keyframe, beyond what the window claims", {0, 10});
  field("drift_m", o.drift_m, "the same of its distance", {0, 10});
  field("min_overlap", o.min_overlap, "of the smaller of a plane seen and a landmark", {0, 1});
  field("patience", o.patience, "keyframes that a landmark is remembered unseen", {0, 100000});
  field("max_landmarks", o.max_landmarks, "the one unseen for longest is forgotten", {1, 1000});
}

void DirectCueOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, DirectCueOptions& o) {
  field.group("surface", o.surface, "the ground under a vehicle, by depths");
  field.group("planes", o.planes, "planes through the depths of the whole image");
  field.group("align", o.align, "motion by the grey values of surfaces");
  field("depths", o.depths, "asked for over the whole image, where planes are sought",
        {50, 1000000});
  field("max_planes", o.max_planes, "at once", {1, 50});
  field("min_plane_share", o.min_plane_share, "of the depths, for a plane", {0, 1});
  field("evenness_distance", o.evenness_distance,
        "no surface's distance is known better, as a share of it", {0, 1});
  field("evenness_deg", o.evenness_deg, "no surface's normal is known better", {0, 45});
  field("nodding_deg", o.nodding_deg, "of a vehicle about its mean pitch and roll, for one eye",
        {0, 45});
  field("sigma_height", o.sigma_height, "of the height of one eye, as a share of it", {1e-4, 1});
  field("keyframe_share", o.keyframe_share, "of the surfaces in view below which a keyframe is due",
        {0, 1});
  field("max_disagreement", o.max_disagreement,
        "of the motions there and back, in standard deviations", {0.1, 1000});
}

}  // namespace placegraph
