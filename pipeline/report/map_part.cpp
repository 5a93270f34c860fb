#include <placegraph/pipeline/report/map_part.h>

#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/pose_graph/constraint_source.h>
#include <placegraph/io/exports/base64.h>
#include <placegraph/pipeline/map/map_geometry.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include <placegraph/pipeline/report/parts.h>
#include <placegraph/pipeline/report/tables/column.h>

namespace placegraph::report {
namespace {

using nlohmann::json;

/// Image points of a keyframe beyond this number are left out: more would hide its thumbnail.
constexpr std::size_t kMostTracks = 60;

void put_position(std::vector<float>& column, const Eigen::Vector3d& p) {
  for (int i = 0; i < 3; ++i) column.push_back(static_cast<float>(p[i]));
}

/// The observations of the landmarks that most keyframes observe, by landmark.
std::vector<const LandmarkObservation*> longest_tracks(
    const Keyframe& keyframe, const std::unordered_map<LandmarkId, int>& lengths) {
  std::vector<const LandmarkObservation*> seen;
  for (const LandmarkObservation& observation : keyframe.observations)
    if (observation.camera == 0 && lengths.contains(observation.landmark))
      seen.push_back(&observation);
  const auto before = [&](const LandmarkObservation* a, const LandmarkObservation* b) {
    const int length_a = lengths.at(a->landmark), length_b = lengths.at(b->landmark);
    return length_a != length_b ? length_a > length_b : a->landmark < b->landmark;
  };
  std::ranges::sort(seen, before);
  if (seen.size() > kMostTracks) seen.resize(kMostTracks);
  return seen;
}

/// A pixel as a share of the image's side, in 255ths.
std::uint8_t share_of(double pixel, int size) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp((pixel + 0.5) / size, 0.0, 1.0)));
}

json describe_tracks(const Map& map, const Camera& camera) {
  std::unordered_map<LandmarkId, int> lengths;
  for (const PointLandmark& landmark : map.landmarks) lengths[landmark.id] = landmark.observations;
  std::vector<std::int32_t> count, landmark;
  std::vector<std::uint8_t> pixel;
  for (const Keyframe& keyframe : map.keyframes) {
    const auto seen = longest_tracks(keyframe, lengths);
    count.push_back(static_cast<std::int32_t>(seen.size()));
    for (const LandmarkObservation* observation : seen) {
      landmark.push_back(static_cast<std::int32_t>(observation->landmark.value()));
      pixel.push_back(share_of(static_cast<double>(observation->px.x()), camera.width));
      pixel.push_back(share_of(static_cast<double>(observation->px.y()), camera.height));
    }
  }
  if (landmark.empty()) return {};
  return {{"count", column(count)}, {"landmark", column(landmark)}, {"pixel", column(pixel, 2)}};
}

}  // namespace

json describe_keyframes(const Map& map, const Calibration* calibration) {
  std::vector<std::int32_t> id, frame, place;
  json thumbnails = json::array();
  for (const Keyframe& keyframe : map.keyframes) {
    id.push_back(static_cast<std::int32_t>(keyframe.id.value()));
    frame.push_back(static_cast<std::int32_t>(keyframe.frame.value()));
    place.push_back(static_cast<std::int32_t>(keyframe.place.value()));
    thumbnails.push_back(keyframe.thumbnail.empty()
                             ? ""
                             : "data:image/jpeg;base64," + to_base64(keyframe.thumbnail));
  }
  return {{"id", column(id)},
          {"frame", column(frame)},
          {"place", column(place)},
          {"thumbnails", thumbnails},
          {"tracks", calibration ? describe_tracks(map, calibration->camera) : json()}};
}

json describe_landmarks(const Map& map) {
  const std::vector<PlacedLandmark> landmarks = geometry_of(map, std::nullopt).landmarks;
  const std::size_t step = LandmarkRows(landmarks.size()).step();
  std::vector<float> position, sigma;
  std::vector<std::uint8_t> colour;
  std::vector<std::int32_t> keyframe;
  bool coloured = false, certain = false;
  for (std::size_t i = 0; i < landmarks.size(); i += step) {
    const PlacedLandmark& landmark = landmarks[i];
    put_position(position, landmark.p_map);
    coloured = coloured || landmark.rgb;
    certain = certain || landmark.sigma;
    const std::array<std::uint8_t, 3> rgb = landmark.rgb.value_or(kUnknownColour);
    colour.insert(colour.end(), rgb.begin(), rgb.end());
    sigma.push_back(landmark.sigma ? static_cast<float>(*landmark.sigma) : kUnknown);
    keyframe.push_back(static_cast<std::int32_t>(landmark.keyframe.value()));
  }
  return {{"position", column(position, 3)},
          {"colour", coloured ? column(colour, 3) : json()},
          {"sigma_m", certain ? column(sigma) : json()},
          {"keyframe", column(keyframe)}};
}

json describe_places(const PlaceGraph& graph) {
  const std::vector<int> joined = graph.joined_components();
  std::vector<std::int32_t> id, keyframe, component;
  std::vector<float> position;
  for (std::size_t i = 0; i < graph.places.size(); ++i) {
    const Place& place = graph.places[i];
    id.push_back(static_cast<std::int32_t>(place.id.value()));
    keyframe.push_back(static_cast<std::int32_t>(place.anchor_keyframe.value()));
    component.push_back(joined[i]);
    put_position(position, place.T_map_place.translation());
  }
  return {{"id", column(id)},
          {"keyframe", column(keyframe)},
          {"component", column(component)},
          {"position", column(position, 3)}};
}

json describe_constraints(const PlaceGraph& graph) {
  std::vector<std::int32_t> from, to;
  std::vector<std::string> source;
  for (const RelativePoseConstraint& constraint : graph.constraints) {
    from.push_back(static_cast<std::int32_t>(constraint.from.value()));
    to.push_back(static_cast<std::int32_t>(constraint.to.value()));
    source.emplace_back(to_string(constraint.source));
  }
  return {{"from", column(from)}, {"to", column(to)}, {"source", text_column(source)}};
}

json describe_loops(const std::vector<LoopRecord>& loops) {
  std::vector<std::int32_t> query, match, inliers, lines;
  std::vector<float> probability, similarity;
  std::vector<std::string> stage;
  for (const LoopRecord& loop : loops) {
    query.push_back(static_cast<std::int32_t>(loop.query_frame.value()));
    match.push_back(static_cast<std::int32_t>(loop.match_frame.value()));
    inliers.push_back(loop.inliers);
    lines.push_back(loop.lines);
    probability.push_back(static_cast<float>(loop.probability));
    similarity.push_back(static_cast<float>(loop.similarity));
    stage.emplace_back(to_string(loop.stage));
  }
  return {{"query_frame", column(query)},
          {"match_frame", column(match)},
          {"probability", column(probability)},
          {"similarity", column(similarity)},
          {"inliers", column(inliers)},
          {"lines", column(lines)},
          {"stage", text_column(stage)},
          {"reason", nullptr},
          {"rank", nullptr},
          {"judged", false}};
}

json describe_components_for_report(const Map& map) {
  json components = json::array();
  for (const MapComponent& component : map.components())
    components.push_back({{"number", component.number},
                          {"main", component.main},
                          {"first", map.frames[component.first].frame.value()},
                          {"last", map.frames[component.last].frame.value()},
                          {"posed", component.posed}});
  return components;
}

}  // namespace placegraph::report
