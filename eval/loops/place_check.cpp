#include <placegraph/eval/loops/place_check.h>
#include <placegraph/eval/association/frame_pair.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/place_transitions.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <set>

namespace placegraph {
namespace {

using Isometry = Eigen::Isometry3d;

struct Anchor {
  PlaceId place;
  Isometry T_world_anchor;
};

/// The map's frames with their true poses and places.
struct PlacedFrame {
  FrameId frame;
  PlaceId place;
  Isometry T_world_frame;
};

double distance_between(const Isometry& a, const Isometry& b) {
  return (a.translation() - b.translation()).norm();
}

double angle_between(const Isometry& a, const Isometry& b) {
  return rad_to_deg(rotation_angle(a.linear().transpose() * b.linear()));
}

const std::optional<Isometry>& true_pose(const Trajectory& truth, FrameId frame) {
  require(frame.value() >= 0 && frame.value() < static_cast<std::int64_t>(truth.size()),
          "place check: frame " + to_string(frame) + " is beyond the truth's " +
              std::to_string(truth.size()) + " poses");
  return truth.poses[static_cast<std::size_t>(frame.value())].T_world_body;
}

std::vector<PlacedFrame> placed_frames(const Map& map, const Trajectory& truth) {
  std::map<KeyframeId, PlaceId> place_of;
  for (const Keyframe& keyframe : map.keyframes) place_of[keyframe.id] = keyframe.place;
  std::vector<PlacedFrame> frames;
  for (const FrameRecord& record : map.frames) {
    if (!record.T_keyframe_frame) continue;
    const auto place = record.keyframe ? place_of.find(*record.keyframe) : place_of.end();
    require(place != place_of.end(), "place check: a frame's keyframe is not in the map");
    if (const auto& T_world_frame = true_pose(truth, record.frame))
      frames.push_back({record.frame, place->second, *T_world_frame});
  }
  return frames;
}

void count_pure_pairs(const Map& map, const Trajectory& truth, const PlaceCheckOptions& options,
                      PlaceCheck& check) {
  std::map<PlaceId, std::vector<Isometry>> views;
  for (const Keyframe& keyframe : map.keyframes)
    if (const auto& T_world_view = true_pose(truth, keyframe.frame))
      views[keyframe.place].push_back(*T_world_view);
  for (const auto& [place, poses] : views)
    for (std::size_t i = 0; i < poses.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        ++check.pairs;
        check.pure_pairs += distance_between(poses[i], poses[j]) <= options.max_distance_m &&
                            angle_between(poses[i], poses[j]) <= options.max_angle_deg;
      }
}

/// A place with earlier frames is revisited if the true match of a frame belongs to it, independent
/// of the place of that frame in the map.
void count_growth(const std::vector<PlacedFrame>& frames, const Trajectory& truth,
                  const PlaceCheckOptions& options, PlaceCheck& check) {
  const LoopTruth revisits = loop_truth_from_poses(truth, options.revisit);
  std::map<FrameId, PlaceId> place_of_frame;
  std::set<PlaceId> founded_first, revisited, of_revisits;
  for (const PlacedFrame& frame : frames) {
    place_of_frame[frame.frame] = frame.place;
    const auto query = revisits.queries.find(frame.frame);
    if (query == revisits.queries.end() || query->second.matches.empty()) {
      founded_first.insert(frame.place);
      continue;
    }
    of_revisits.insert(frame.place);
    for (const FrameId match : query->second.matches)
      if (const auto place = place_of_frame.find(match); place != place_of_frame.end())
        revisited.insert(place->second);
  }
  for (const PlaceId place : revisited) check.revisited_places += founded_first.count(place);
  for (const PlaceId place : of_revisits) check.added_places += !founded_first.count(place);
}

std::set<std::pair<PlaceId, PlaceId>> true_adjacency(const std::vector<Anchor>& anchors,
                                                     const std::vector<PlacedFrame>& frames,
                                                     const PlaceCheckOptions& options) {
  std::set<std::pair<PlaceId, PlaceId>> pairs;
  const Anchor* before = nullptr;
  std::optional<FrameId> last;
  for (const PlacedFrame& frame : frames) {
    const Anchor* nearest = nullptr;
    double least = options.max_distance_m;
    for (const Anchor& anchor : anchors) {
      const double distance = distance_between(anchor.T_world_anchor, frame.T_world_frame);
      if (distance >= least ||
          angle_between(anchor.T_world_anchor, frame.T_world_frame) > options.max_angle_deg)
        continue;
      least = distance;
      nearest = &anchor;
    }
    if (before && nearest && before != nearest && last->value() + 1 == frame.frame.value())
      pairs.insert(std::minmax(before->place, nearest->place));
    before = nearest;
    last = frame.frame;
  }
  return pairs;
}

}  // namespace

void PlaceCheckOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PlaceCheckOptions& o) {
  field("max_distance_m", o.max_distance_m, "largest distance between two views of one place [m]",
        {0, 1e6});
  field("max_angle_deg", o.max_angle_deg, "largest angle between their viewing directions [deg]",
        {0, 180});
  field.group("revisit", o.revisit, "criteria for a revisit");
}

PlaceCheck check_places(const Map& map, const Trajectory& truth, const PlaceCheckOptions& options) {
  options.check();
  PlaceCheck check;
  check.places = static_cast<int>(map.place_graph.places.size());
  const std::vector<PlacedFrame> frames = placed_frames(map, truth);
  count_pure_pairs(map, truth, options, check);
  count_growth(frames, truth, options, check);

  std::vector<Anchor> anchors;
  for (const Place& place : map.place_graph.places)
    if (const Keyframe* keyframe = map.find_keyframe(place.anchor_keyframe))
      if (const auto& T_world_anchor = true_pose(truth, keyframe->frame))
        anchors.push_back({place.id, *T_world_anchor});
  const auto expected = true_adjacency(anchors, frames, options);
  std::set<std::pair<PlaceId, PlaceId>> found;
  for (const PlaceTransition& transition : place_transitions(map))
    found.insert(std::minmax(transition.from, transition.to));
  check.adjacent = static_cast<int>(found.size());
  check.true_adjacent = static_cast<int>(expected.size());
  check.common = static_cast<int>(std::count_if(
      found.begin(), found.end(), [&](const auto& pair) { return expected.count(pair) != 0; }));
  return check;
}

}  // namespace placegraph
