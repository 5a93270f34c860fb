#include <fmt/format.h>
#include <placegraph/pipeline/run.h>

#include <algorithm>

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

std::size_t tracked_frames(const Map& map) {
  return static_cast<std::size_t>(std::ranges::count_if(
      map.frames, [](const FrameRecord& frame) { return frame.T_keyframe_frame.has_value(); }));
}

std::string scale_text(const RunResult& run) {
  if (run.sensor == Sensor::kStereo)
    return fmt::format("by the baseline of {:g} m", run.calibration.baseline_m);
  if (run.sensor == Sensor::kRgbd) return "by the depth images";
  if (!run.map.metric) return "one camera alone does not observe the scale";
  if (run.calibration.camera_height_m)
    return fmt::format("by the camera height of {:g} m above the ground",
                       *run.calibration.camera_height_m);
  return "by the motion that other sensors measured";
}

}  // namespace

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::kGood:
      return "good";
    case Verdict::kDoubtful:
      return "doubtful";
    case Verdict::kFailed:
      return "failed";
  }
  return "failed";
}

Judgement judge(const RunResult& run, const std::vector<DataNote>& notes, double min_posed) {
  Judgement judgement;
  const std::size_t frames = run.map.frames.size(), posed = tracked_frames(run.map);
  const auto add = [&](const std::optional<DataNote>& note) {
    if (note && note->cause != NoteCause::kNone) judgement.findings.push_back(*note);
  };
  if (posed == 0 || static_cast<double>(posed) < min_posed * static_cast<double>(frames)) {
    judgement.verdict = Verdict::kFailed;
    add(DataNote{fmt::format("{} of {} frames have a pose", posed, frames), false,
                 NoteCause::kFewPosed,
                 run.unposed.empty() ? "" : "the most frequent reason: " + run.unposed[0].reason});
  }
  for (const DataNote& note : notes) add(note);
  for (const DataNote& note : run.notes) add(note);
  add(note_of_components(run.map));
  add(note_of_lost(run.map));
  if (!judgement.findings.empty() && judgement.verdict == Verdict::kGood)
    judgement.verdict = Verdict::kDoubtful;
  const auto doubt = std::ranges::find_if(judgement.findings,
                                          [](const DataNote& note) { return note.doubts_scale; });
  judgement.metric = run.map.metric && doubt == judgement.findings.end();
  judgement.why_metric =
      run.map.metric && !judgement.metric ? "in doubt: " + doubt->text : scale_text(run);
  return judgement;
}

}  // namespace placegraph
