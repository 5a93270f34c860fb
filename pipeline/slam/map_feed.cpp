#include <placegraph/graph/image/thumbnail.h>
#include <placegraph/pipeline/slam/map_feed.h>

#include <algorithm>

namespace placegraph {
namespace {

/// Component with the most frames that have a pose.
int main_component(const MapSources& sources) {
  std::map<int, std::size_t> frames;
  for (const FrameRecord& record : sources.recorder.records())
    if (record.T_keyframe_frame) ++frames[sources.mapper.component_of(*record.keyframe)];
  const auto most =
      std::ranges::max_element(frames, {}, [](const auto& component) { return component.second; });
  return most == frames.end() ? 0 : most->first;
}

/// Red, green and blue of a pixel of a grey or BGR image.
std::array<std::uint8_t, 3> colour_at(const Image& image, const Eigen::Vector2f& px) {
  const int u = std::clamp(static_cast<int>(std::lround(px.x())), 0, image.cols - 1);
  const int v = std::clamp(static_cast<int>(std::lround(px.y())), 0, image.rows - 1);
  if (image.channels() == 1) {
    const std::uint8_t grey = image.at<std::uint8_t>(v, u);
    return {grey, grey, grey};
  }
  const cv::Vec3b& bgr = image.at<cv::Vec3b>(v, u);
  return {bgr[2], bgr[1], bgr[0]};
}

}  // namespace

void MapFeed::keep_view(KeyframeId keyframe, const Frame& frame, const LocalMap& map) {
  const Image& image = frame.colour.empty() ? frame.image : frame.colour;
  thumbnails_[keyframe] = thumbnail_of(image);
  for (const auto& [seen_in, observations] : map.observations(keyframe))
    if (seen_in == keyframe)
      for (const LandmarkObservation& seen : observations)
        colours_.try_emplace(seen.landmark, colour_at(image, seen.px));
  if (!views_in_colour_) views_in_colour_ = !frame.colour.empty();
  if (*views_in_colour_ && frame.colour.empty()) return;
  views_[keyframe] = describe_place(*views_in_colour_ ? frame.colour : frame.image, cues_, false);
}

void MapFeed::report_again() { first_view_ = first_landmark_ = 0; }

/// A keyframe without its place.
Keyframe MapFeed::keyframe_of(const LoopCloser::View& view,
                              const TrajectoryRecorder& recorder) const {
  Keyframe keyframe;
  keyframe.id = view.keyframe;
  keyframe.frame = view.frame;
  keyframe.stamp_ns = recorder.stamp_ns_of(view.keyframe);
  keyframe.features = view.features;
  if (const auto kept = views_.find(view.keyframe); kept != views_.end())
    keyframe.view = kept->second;
  if (const auto kept = thumbnails_.find(view.keyframe); kept != thumbnails_.end())
    keyframe.thumbnail = kept->second;
  return keyframe;
}

std::vector<PointLandmark> MapFeed::landmarks(const Odometry& odometry, std::size_t first) const {
  const std::size_t earlier = std::min(first, earlier_landmarks_.size());
  std::vector<PointLandmark> result(
      earlier_landmarks_.begin() + static_cast<std::ptrdiff_t>(earlier), earlier_landmarks_.end());
  for (PointLandmark landmark : odometry.map().landmarks(first - earlier)) {
    if (const auto rgb = colours_.find(landmark.id); rgb != colours_.end())
      landmark.rgb = rgb->second;
    landmark.id = LandmarkId(landmark.id.value() + first_landmark_id_);
    result.push_back(landmark);
  }
  return result;
}

std::vector<std::pair<KeyframeId, std::vector<LandmarkObservation>>> MapFeed::observations(
    const LocalMap& map, KeyframeId from) const {
  auto result = map.observations(from);
  for (auto& [keyframe, observations] : result)
    for (LandmarkObservation& observation : observations)
      observation.landmark = LandmarkId(observation.landmark.value() + first_landmark_id_);
  return result;
}

Map MapFeed::snapshot(const MapSources& sources) const {
  Map map;
  map.place_graph = sources.mapper.place_graph();
  sources.environments.label(map.place_graph.places);
  std::map<KeyframeId, std::pair<PlaceId, PlaceMember>> members;
  for (Place& place : map.place_graph.places) {
    place.appearance = sources.closer.appearance(place.anchor_keyframe);
    for (const PlaceMember& member : place.members) members[member.keyframe] = {place.id, member};
  }
  for (const auto& view : sources.closer.views()) {
    Keyframe& keyframe = map.keyframes.emplace_back(keyframe_of(view, sources.recorder));
    const auto& [place, member] = members.at(view.keyframe);
    keyframe.place = place;
    keyframe.T_place_keyframe = member.T_place_keyframe;
    keyframe.scale = member.scale;
  }
  map.landmarks = landmarks(sources.odometry, 0);
  auto seen = earlier_observations_;
  for (auto& [keyframe, observed] : observations(sources.odometry.map(), KeyframeId()))
    seen[keyframe] = std::move(observed);
  for (Keyframe& keyframe : map.keyframes)
    if (const auto found = seen.find(keyframe.id); found != seen.end())
      keyframe.observations = std::move(found->second);
  map.frames = sources.recorder.records();
  map.loops = sources.closer.records();
  map.metric = sources.mapper.metric();
  map.trajectory_online.poses = sources.recorder.online(main_component(sources));
  return map;
}

MapChanges MapFeed::take_changes(const MapSources& sources) {
  // Landmarks that are saved as one block. Chosen.
  constexpr std::size_t kLandmarksSavedTogether = 1000;
  const LoopCloser& closer = sources.closer;
  TrajectoryRecorder& recorder = sources.recorder;
  MapChanges changes;
  changes.places = sources.mapper.places();
  sources.environments.label(changes.places);
  const bool vocabulary_changed = closer.trained_views() != reported_training_;
  for (const Place& place : changes.places)
    if (described_places_.insert(place.id).second || vocabulary_changed)
      changes.appearances.emplace_back(place.id, closer.appearance(place.anchor_keyframe));
  changes.constraints = sources.mapper.take_constraint_changes();
  const auto& views = closer.views();
  for (std::size_t i = first_view_; i < views.size(); ++i)
    changes.keyframes.push_back(keyframe_of(views[i], recorder));
  views_.clear();
  thumbnails_.clear();
  const LocalMap& local = sources.odometry.map();
  changes.observations = observations(local, first_observed_);
  first_observed_ = local.window_begin().value_or(first_observed_);
  // The online poses of another component take the place of those that were reported.
  const int main = main_component(sources);
  changes.first_frame = main == reported_component_ ? recorder.first_changed() : 0;
  reported_component_ = main;
  const auto from = static_cast<std::ptrdiff_t>(changes.first_frame);
  changes.frames.assign(recorder.records().begin() + from, recorder.records().end());
  changes.online = recorder.online(main, changes.first_frame);
  changes.first_landmark = first_landmark_ / kLandmarksSavedTogether * kLandmarksSavedTogether;
  changes.landmarks = landmarks(sources.odometry, changes.first_landmark);
  changes.loops = closer.records();
  changes.history = sources.mapper.history();
  changes.history.median_depth_m = sources.odometry.map().median_depth();
  changes.metric = sources.mapper.metric();

  reported_training_ = closer.trained_views();
  first_view_ = views.empty() ? 0 : views.size() - 1;  // the next view adds depth to its features
  first_landmark_ = earlier_landmarks_.size() + sources.odometry.map().settled_landmarks();
  recorder.report_all();
  return changes;
}

void MapFeed::take_up(const Map& map, const LoopCloser& closer) {
  for (const Keyframe& keyframe : map.keyframes)
    if (!keyframe.view.empty() && !views_in_colour_)
      views_in_colour_ = !keyframe.view.colour.empty();
  for (const Place& place : map.place_graph.places) described_places_.insert(place.id);
  earlier_landmarks_ = map.landmarks;
  for (const Keyframe& keyframe : map.keyframes)
    earlier_observations_[keyframe.id] = keyframe.observations;
  for (const PointLandmark& landmark : map.landmarks)
    first_landmark_id_ = std::max(first_landmark_id_, landmark.id.value() + 1);
  first_view_ = map.keyframes.size();
  first_landmark_ = earlier_landmarks_.size();
  reported_training_ = closer.trained_views();
}

}  // namespace placegraph
