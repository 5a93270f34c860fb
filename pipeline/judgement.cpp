#include <fmt/format.h>
#include <placegraph/backend/pose_graph/pose_marginals.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/health/motion_check.h>
#include <placegraph/pipeline/run.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Consecutive frames with or without a pose.
struct Span {
  std::size_t first = 0, last = 0;
  std::size_t count() const { return last - first + 1; }
};

/// Spans of frames without a pose in any component, behind the first frame that has one.
std::vector<Span> lost_spans(const Map& map) {
  std::vector<Span> spans;
  bool begun = false;
  for (std::size_t i = 0; i < map.frames.size(); ++i) {
    const bool posed = map.frames[i].T_keyframe_frame.has_value();
    begun = begun || posed;
    if (posed || !begun) continue;
    if (spans.empty() || spans.back().last + 1 != i) spans.push_back({i, i});
    spans.back().last = i;
  }
  return spans;
}

std::string frames_text(const Map& map, const Span& span) {
  return span.count() == 1 ? fmt::format("frame {}", map.frames[span.first].frame.value())
                           : fmt::format("frames {} to {}", map.frames[span.first].frame.value(),
                                         map.frames[span.last].frame.value());
}

std::optional<DataNote> note_of_lost(const Map& map) {
  const std::vector<Span> spans = lost_spans(map);
  if (spans.empty()) return std::nullopt;
  std::size_t lost = 0;
  for (const Span& span : spans) lost += span.count();
  const Span& longest = *std::ranges::max_element(spans, {}, &Span::count);
  std::string text =
      fmt::format("{} of {} frames are lost after the beginning: ", lost, map.frames.size());
  text += spans.size() == 1 ? frames_text(map, longest)
                            : fmt::format("in {} spans, the longest is {}", spans.size(),
                                          frames_text(map, longest));
  return DataNote{text, false, NoteCause::kLostFrames,
                  "look at these images: blank, blurred, covered, or too far from the last ones"};
}

std::optional<DataNote> note_of_components(const Map& map) {
  const std::vector<MapComponent> components = map.components();
  if (components.size() < 2) return std::nullopt;
  std::string spans;
  for (const MapComponent& component : components)
    spans += fmt::format("{}{}{}", spans.empty() ? "" : ", ",
                         frames_text(map, {component.first, component.last}),
                         component.main ? " (main)" : "");
  return DataNote{fmt::format("the map has {} components, each in a frame of its own: {}",
                              components.size(), spans),
                  false, NoteCause::kComponents,
                  "a place seen again or another motion source would join them"};
}

/// Share of the tracked landmarks that agrees with the poses of most frames; 0 without one.
double usual_confidence(const std::vector<FrameRecord>& frames) {
  std::vector<double> confidences;
  for (const FrameRecord& frame : frames)
    if (frame.confidence) confidences.push_back(*frame.confidence);
  return confidences.empty() ? 0 : median_of(confidences);
}

/// Frames in which far fewer of the tracked landmarks agree with the pose than usual.
std::optional<DataNote> note_of_confidence(const std::vector<FrameRecord>& frames) {
  // Half of the usual confidence, in more than one frame in a hundred (docs/datasets.md). Chosen by
  // the faults of group "fixed" (tests/faults/README.md).
  constexpr double kOfUsual = 0.5, kShare = 0.01;
  const double usual = usual_confidence(frames);
  const auto low = [&](const FrameRecord& frame) {
    return frame.confidence && *frame.confidence < kOfUsual * usual;
  };
  const auto count = static_cast<double>(std::ranges::count_if(frames, low));
  const auto posed = static_cast<double>(
      std::ranges::count_if(frames, [](const FrameRecord& f) { return f.confidence.has_value(); }));
  if (count < 2 || count < kShare * posed) return std::nullopt;
  const FrameRecord& first = *std::ranges::find_if(frames, low);
  return DataNote{
      fmt::format("in {} frames less than half of the usual share of the tracked points "
                  "agrees with the pose; the first is frame {}",
                  count, first.frame.value()),
      false, NoteCause::kJump,
      "look at these images: some are missing, covered, or of another place"};
}

/// Spans of frames in which fewer of the tracked landmarks agree with the pose than usual.
std::optional<DataNote> note_of_spans(const std::vector<FrameRecord>& frames) {
  // Ten frames whose median is below two thirds of the usual (docs/datasets.md). Chosen by the
  // faults of group "fixed" (tests/faults/README.md).
  constexpr std::size_t kFrames = 10;
  constexpr double kOfUsual = 2.0 / 3;
  const double usual = usual_confidence(frames);
  std::size_t spans = 0, first = 0, last = 0;
  for (std::size_t i = 0; i + kFrames <= frames.size(); ++i) {
    std::vector<double> confidences;
    for (std::size_t k = i; k < i + kFrames; ++k)
      if (frames[k].confidence) confidences.push_back(*frames[k].confidence);
    if (confidences.size() < kFrames || !(median_of(confidences) < kOfUsual * usual)) continue;
    if (spans++ == 0) first = i;
    last = i + kFrames - 1;
  }
  if (spans == 0) return std::nullopt;
  return DataNote{
      fmt::format("between the frames {} and {} less than two thirds of the usual share of the "
                  "tracked points agrees with the poses",
                  frames[first].frame.value(), frames[last].frame.value()),
      false, NoteCause::kDrift,
      "look for what moves or covers the view there; --mask leaves it out"};
}

std::size_t tracked_frames(const Map& map) {
  return static_cast<std::size_t>(std::ranges::count_if(
      map.frames, [](const FrameRecord& frame) { return frame.T_keyframe_frame.has_value(); }));
}

/// Standard deviation of the position of the last place that constraints connect with the first
/// one, relative to it. In the place graph all errors are independent. Those that all motions share
/// are larger at the end; loops reduce them as they reduce the errors of the odometry in the graph.
std::optional<double> drift_of(const PlaceGraph& places,
                               const std::optional<OdometryError>& odometry) {
  const PoseGraph graph = places.pose_graph();
  const std::vector<int> components = graph.components();
  std::size_t last = 0;
  for (std::size_t i = 1; i < components.size(); ++i)
    if (components[i] == components[0]) last = i;
  if (last == 0) return std::nullopt;
  const PoseMarginals marginals(graph);
  if (!marginals.outcome()) return std::nullopt;
  const double in_graph = marginals.relative_covariance(graph.nodes[0].id, graph.nodes[last].id)
                              .topLeftCorner<3, 3>()
                              .trace();
  if (!odometry) return std::sqrt(in_graph);
  const double kept = std::min(1.0, in_graph / odometry->independent.topLeftCorner<3, 3>().trace());
  return std::sqrt(in_graph + kept * kept * odometry->shared.topLeftCorner<3, 3>().trace());
}

/// Of a camera that turns at the place, whose path is shorter than its view, the drift is compared
/// with the depth of what it sees (landmark_depth).
std::optional<DataNote> note_of_drift(const std::optional<double>& drift, const Map& map,
                                      double depth) {
  // Drift over the length of the path. Chosen by the faults of group "fixed"
  // (tests/faults/README.md).
  constexpr double kMostShare = 0.03;
  if (!drift) return std::nullopt;
  const double length = map.trajectory_optimized().path_length();
  if (!(*drift > kMostShare * std::max(length, depth))) return std::nullopt;
  return DataNote{
      fmt::format("the end is known to {:.3g}{} relative to the beginning, {:.0f} % of the {}",
                  *drift, map.metric ? " m" : "", 100 * *drift / std::max(length, depth),
                  length > depth ? "path" : "depth of the scene"),
      false, NoteCause::kDrift, "places that are seen again reduce it"};
}

/// A camera height beside a sensor that measures the scale itself.
std::optional<DataNote> note_of_height(const RunResult& run) {
  if (run.sensor == Sensor::kMono || !run.calibration.camera_height_m) return std::nullopt;
  return odd_height(nearest_sides(run.map, *run.calibration.camera_height_m), run.sensor,
                    *run.calibration.camera_height_m);
}

/// What gives the scale, and whether the recording has a second length to compare it with.
std::string scale_text(const RunResult& run) {
  const std::optional<double>& height_m = run.calibration.camera_height_m;
  const char* unchecked = "; nothing in the recording checks it";
  const char* roughly = "; the camera height checks it to 40 % only";  // odd_height
  if (run.sensor == Sensor::kStereo)
    return fmt::format("by the baseline of {:g} m{}", run.calibration.baseline_m,
                       height_m ? roughly : unchecked);
  if (run.sensor == Sensor::kRgbd)
    return fmt::format("by the unit of the depth images{}", height_m ? roughly : unchecked);
  if (!run.map.metric) return "one camera alone does not observe the scale";
  if (height_m)
    return fmt::format("by the camera height of {:g} m above the ground{}", *height_m, unchecked);
  return "by the motion that other sensors measured";
}

/// The first finding by which lengths may be wrong; nullptr if there is none.
const DataNote* first_doubt(const std::vector<DataNote>& findings,
                            const std::vector<DataNote>& more) {
  for (const std::vector<DataNote>* notes : {&findings, &more})
    for (const DataNote& note : *notes)
      if (note.doubts_scale) return &note;
  return nullptr;
}

}  // namespace

Judgement judge(RunResult& run, const std::vector<DataNote>& notes, double min_posed) {
  Judgement judgement;
  const std::size_t frames = run.map.frames.size(), posed = tracked_frames(run.map);
  const auto add = [](const std::optional<DataNote>& note, std::vector<DataNote>& findings) {
    if (note && note->cause != NoteCause::kNone) findings.push_back(*note);
  };
  std::vector<DataNote>& findings = judgement.findings;
  const bool failed =
      posed == 0 || static_cast<double>(posed) < min_posed * static_cast<double>(frames);
  if (failed) judgement.verdict = Verdict::kFailed;
  if (failed || 2 * posed < frames)
    add(DataNote{fmt::format("{} of {} frames have a pose", posed, frames), false,
                 NoteCause::kFewPosed,
                 run.unposed.empty() ? "" : "the most frequent reason: " + run.unposed[0].reason},
        findings);
  for (const DataNote& note : notes) add(note, findings);
  for (const DataNote& note : run.notes) add(note, findings);
  add(note_of_height(run), findings);
  std::vector<DataNote> of_motion;
  double depth_of_main = 0;
  for (const MapComponent& component : run.map.components()) {
    const Trajectory trajectory = run.map.trajectory_optimized(component.number);
    const double depth = landmark_depth(run.map, component.number);
    if (component.main) depth_of_main = depth;
    add(odd_steps(trajectory, depth), of_motion);
    add(odd_order(trajectory), of_motion);
  }
  const DataNote* const doubt = first_doubt(findings, of_motion);
  judgement.metric = run.map.metric && !doubt;
  judgement.why_metric = run.map.metric && doubt ? "in doubt: " + doubt->text : scale_text(run);
  const std::optional<double> drift =
      drift_of(run.map.place_graph, run.map.metric ? run.odometry_error : std::nullopt);
  run.map.metric = judgement.metric;
  if (judgement.metric) judgement.expected_drift_m = drift;
  add(note_of_drift(drift, run.map, depth_of_main), findings);
  findings.insert(findings.end(), of_motion.begin(), of_motion.end());
  add(note_of_confidence(run.map.frames), findings);
  add(note_of_spans(run.map.frames), findings);
  add(note_of_components(run.map), findings);
  add(note_of_lost(run.map), findings);
  if (!findings.empty() && judgement.verdict == Verdict::kGood)
    judgement.verdict = Verdict::kDoubtful;
  return judgement;
}

}  // namespace placegraph
