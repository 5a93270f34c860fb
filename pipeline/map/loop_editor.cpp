#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/loops/loop_closer.h>
#include <placegraph/pipeline/loops/loop_probability.h>
#include <placegraph/pipeline/map/loop_editor.h>
#include <placegraph/pipeline/places/place_mapper.h>

#include <algorithm>
#include <map>

namespace placegraph {
namespace {

std::size_t component_count(const PlaceGraph& graph) {
  std::vector<int> numbers = graph.joined_components();
  std::ranges::sort(numbers);
  return static_cast<std::size_t>(std::ranges::unique(numbers).begin() - numbers.begin());
}

std::map<KeyframeId, Sim3> keyframe_poses(const PlaceGraph& graph) {
  std::map<KeyframeId, Sim3> poses;
  for (const Place& place : graph.places)
    for (const PlaceMember& member : place.members)
      poses[member.keyframe] = place.S_map_place() * member.S_place_keyframe();
  return poses;
}

MapMotion motion_between(const PlaceGraph& before, const PlaceGraph& after) {
  MapMotion motion{before.places.size(), after.places.size(), component_count(before),
                   component_count(after)};
  const auto earlier = keyframe_poses(before);
  for (const auto& [id, pose] : keyframe_poses(after)) {
    const Sim3& S = earlier.at(id);
    motion.translation =
        std::max(motion.translation, (pose.translation() - S.translation()).norm());
    motion.rotation_rad =
        std::max(motion.rotation_rad, (S.rotation().inverse() * pose.rotation()).log().norm());
  }
  return motion;
}

/// The record of a pair of frames, the last one if there are several.
LoopRecord* find_record(std::vector<LoopRecord>& loops, FrameId query, FrameId match) {
  const auto found = std::find_if(loops.rbegin(), loops.rend(), [&](const LoopRecord& loop) {
    return loop.query_frame == query && loop.match_frame == match;
  });
  return found == loops.rend() ? nullptr : &*found;
}

std::string pair_text(FrameId query, FrameId match) {
  return fmt::format("of frames {} and {}", query.value(), match.value());
}

}  // namespace

LoopEditor::LoopEditor(StoredMap stored, const SlamOptions& options)
    : stored_(std::move(stored)), options_(options) {
  require(!stored_.history.keyframes.empty(),
          "loops of this map cannot be edited: it has no history of its places (an imported map)");
  require(stored_.finished, "loops of this map cannot be edited: its run was interrupted");
  require(stored_.origin.calibration.has_value(),
          "loops of this map cannot be edited: it has no calibration");
  stored_.judgement.reset();
  stored_.run = {};
  state_ = {stored_.map.loops, stored_.history, stored_.map.place_graph, stored_.map.metric};
  scale_doubted_ = !state_.metric && mapper_of(state_).metric();
}

PlaceMapper LoopEditor::mapper_of(const State& state) const {
  return {options_.places, options_.pose_graph, state.place_graph.places, state.history};
}

const Keyframe& LoopEditor::keyframe_of(FrameId frame) const {
  const auto& frames = stored_.map.frames;
  const auto found = std::ranges::lower_bound(frames, frame, {}, &FrameRecord::frame);
  require(found != frames.end() && found->frame == frame,
          fmt::format("the map has no frame {}", frame.value()));
  // A keyframe is its own: its record may name the one that it was tracked from.
  for (const Keyframe& keyframe : stored_.map.keyframes)
    if (keyframe.frame == frame) return keyframe;
  require(found->keyframe.has_value(), fmt::format("frame {} has no pose", frame.value()));
  return *stored_.map.find_keyframe(*found->keyframe);
}

const LoopCloser& LoopEditor::closer() {
  if (!closer_)
    closer_ = std::make_unique<LoopCloser>(options_.loops, *stored_.origin.calibration,
                                           options_.seed, stored_.map);
  return *closer_;
}

LoopEditor::~LoopEditor() = default;

std::string LoopEditor::refuse(FrameId query, FrameId match) {
  State next = state_;
  LoopRecord* record = find_record(next.loops, query, match);
  require(record && record->accepted(),
          fmt::format("the map has no accepted loop {}", pair_text(query, match)));
  const KeyframeId later = keyframe_of(query).id, earlier = keyframe_of(match).id;
  const auto removed = std::erase_if(next.history.loops, [&](const Loop& loop) {
    return loop.query == later && loop.match == earlier;
  });
  require(removed > 0,
          fmt::format("the map has no constraint of the loop {}", pair_text(query, match)));
  record->stage = LoopStage::kManual;
  next.loop_removed = true;
  next.edits.push_back("refused the loop " + pair_text(query, match));
  change(std::move(next));
  return edits().back();
}

std::string LoopEditor::accept(FrameId query, FrameId match) {
  const LoopRecord* record = find_record(state_.loops, query, match);
  require(record, fmt::format("the map has no candidate {}", pair_text(query, match)));
  return take(query, match, "accepted the loop ");
}

std::string LoopEditor::add(FrameId query, FrameId match) {
  FrameId later = keyframe_of(query).frame, earlier = keyframe_of(match).frame;
  if (later < earlier) std::swap(later, earlier);
  require(earlier != later, fmt::format("frames {} and {} have one keyframe, which needs no loop",
                                        query.value(), match.value()));
  return take(later, earlier, "added the loop ");
}

/// Measures the loop between two keyframes, named by their frames, and takes it into the map.
std::string LoopEditor::take(FrameId query, FrameId match, const char* done) {
  State next = state_;
  LoopRecord* record = find_record(next.loops, query, match);
  require(!record || !record->accepted(),
          fmt::format("the loop {} is in the map already", pair_text(query, match)));
  const KeyframeId later = keyframe_of(query).id, earlier = keyframe_of(match).id;
  const PlaceMapper mapper = mapper_of(next);
  LoopRecord measured;
  const std::optional<Loop> loop =
      closer().measure(later, earlier, mapper.scale_unknown(earlier, later), measured);
  require(loop.has_value(),
          fmt::format("the images {} agree with no relative pose: {} points and {} lines agree",
                      pair_text(query, match), measured.inliers, measured.lines));
  measured.stage = LoopStage::kAccepted;
  measured.probability = loop_probability(measured);
  record ? void(*record = measured) : next.loops.push_back(measured);
  next.history.loops.push_back(*loop);
  next.edits.push_back(done + pair_text(query, match) +
                       fmt::format(", {} points agree", measured.inliers));
  change(std::move(next));
  return edits().back();
}

/// Makes an edited state the present one, with the constraints of its loops.
void LoopEditor::change(State next) {
  const PlaceMapper mapper = mapper_of(next);
  next.place_graph.constraints = mapper.place_graph().constraints;
  next.optimized = false;
  next.revision = ++revisions_;
  earlier_.push_back(state_);
  show(std::move(next));
}

MapMotion LoopEditor::optimize() {
  State next = state_;
  next.history.judged_loops = 0;
  PlaceMapper mapper = mapper_of(next);
  if (next.loop_removed) mapper.reconsider();
  const IncrementalStep step = mapper.finish();
  require(static_cast<bool>(step.outcome),
          "the place graph cannot be optimized: " + step.outcome.reason);
  const double median_depth_m = next.history.median_depth_m;
  next.history = mapper.history();
  next.history.median_depth_m = median_depth_m;
  next.place_graph = mapper.place_graph();
  describe_places(next.place_graph);
  next.metric = mapper.metric() && !scale_doubted_;
  next.optimized = true;
  next.loop_removed = false;
  next.revision = ++revisions_;
  const MapMotion motion = motion_between(state_.place_graph, next.place_graph);
  next.edits.push_back(fmt::format("optimized the map: a keyframe moved by {:.3g} {} at most",
                                   motion.translation, next.metric ? "m" : "in the map's scale"));
  earlier_.push_back(state_);
  show(std::move(next));
  return motion;
}

bool LoopEditor::undo() {
  if (earlier_.empty()) return false;
  State before = std::move(earlier_.back());
  earlier_.pop_back();
  show(std::move(before));
  return true;
}

/// Gives places their appearance, and the labels of all places from which their keyframes come.
void LoopEditor::describe_places(PlaceGraph& graph) {
  std::map<KeyframeId, const Place*> place_of;
  for (const Place& place : state_.place_graph.places)
    for (const PlaceMember& member : place.members) place_of[member.keyframe] = &place;
  const bool divided = std::ranges::any_of(graph.places, [&](const Place& place) {
    return place_of.at(place.anchor_keyframe)->anchor_keyframe != place.anchor_keyframe;
  });
  for (Place& place : graph.places) {
    for (const PlaceMember& member : place.members)
      for (const std::string& label : place_of.at(member.keyframe)->labels)
        if (std::ranges::find(place.labels, label) == place.labels.end())
          place.labels.push_back(label);
    // Words of one vocabulary: all appearances are made again, or none.
    place.appearance = divided ? closer().appearance(place.anchor_keyframe)
                               : place_of.at(place.anchor_keyframe)->appearance;
  }
}

void LoopEditor::show(State next) {
  state_ = std::move(next);
  stored_.history = state_.history;
  Map& map = stored_.map;
  map.loops = state_.loops;
  map.place_graph = state_.place_graph;
  map.metric = state_.metric;
  std::map<KeyframeId, std::pair<PlaceId, const PlaceMember*>> members;
  for (const Place& place : map.place_graph.places)
    for (const PlaceMember& member : place.members) members[member.keyframe] = {place.id, &member};
  for (Keyframe& keyframe : map.keyframes) {
    const auto& [place, member] = members.at(keyframe.id);
    keyframe.place = place;
    keyframe.T_place_keyframe = member->T_place_keyframe;
    keyframe.scale = member->scale;
  }
}

}  // namespace placegraph
