#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/map_index.h>
#include <placegraph/graph/pose_graph/constraint_source.h>
#include <placegraph/graph/scene/environment.h>
#include <placegraph/pipeline/map/map_geometry.h>

#include <bit>
#include <cstring>
#include <limits>

#include "python/src/arrays.h"
#include "python/src/graph/maps.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

std::int64_t number_or_minus_one(const auto& id) { return id ? id->value() : -1; }

/// Rows of 3 floats; not a number where nothing is known.
void append_point(const std::optional<Eigen::Vector3f>& point, std::vector<float>& values) {
  for (int i = 0; i < 3; ++i)
    values.push_back(point ? (*point)[i] : std::numeric_limits<float>::quiet_NaN());
}

nb::object pose_matrix(const SE3& T) {
  return nb::cast(Eigen::Matrix<double, 4, 4, Eigen::RowMajor>(T.matrix()));
}

}  // namespace

Table frame_table(const Map& map) {
  std::vector<std::int64_t> frame, stamp, keyframe;
  std::vector<std::int32_t> inliers;
  std::vector<double> confidence;
  nb::list reason;
  for (const FrameRecord& each : map.frames) {
    frame.push_back(each.frame.value());
    stamp.push_back(each.stamp_ns);
    keyframe.push_back(number_or_minus_one(each.keyframe));
    inliers.push_back(each.inliers);
    confidence.push_back(each.confidence.value_or(kUnknown));
    reason.append(each.reason);
  }
  const std::size_t n = frame.size();
  Table table;
  table["frame"] = owned_array(std::move(frame), {n});
  table["stamp_ns"] = owned_array(std::move(stamp), {n});
  table["keyframe"] = owned_array(std::move(keyframe), {n});
  table["inliers"] = owned_array(std::move(inliers), {n});
  table["confidence"] = owned_array(std::move(confidence), {n});
  table["reason"] = reason;
  return table;
}

Table keyframe_table(const Map& map) {
  std::vector<std::int64_t> id, frame, stamp, place, component;
  std::vector<double> poses;
  {
    const WithoutGil released;
    const MapIndex index(map);
    for (const Keyframe& keyframe : map.keyframes) {
      const auto at = index.find(keyframe.id);
      if (!at) continue;
      id.push_back(keyframe.id.value());
      frame.push_back(keyframe.frame.value());
      stamp.push_back(keyframe.stamp_ns);
      place.push_back(keyframe.place.value());
      component.push_back(at->component);
      append_rows(rigid_part(at->S_map_keyframe()).matrix(), poses);
    }
  }
  const std::size_t n = id.size();
  Table table;
  table["id"] = owned_array(std::move(id), {n});
  table["frame"] = owned_array(std::move(frame), {n});
  table["stamp_ns"] = owned_array(std::move(stamp), {n});
  table["place"] = owned_array(std::move(place), {n});
  table["component"] = owned_array(std::move(component), {n});
  table["pose"] = owned_array(std::move(poses), {n, 4, 4});
  return table;
}

Table landmark_table(const Map& map) {
  std::vector<std::int64_t> id, keyframe, component;
  std::vector<double> positions, covariances;
  std::vector<std::uint8_t> colours;
  {
    const WithoutGil released;
    const MapIndex index(map);
    for (const PointLandmark& landmark : map.landmarks) {
      const auto at = index.find(landmark.keyframe);
      if (!at) continue;
      const Sim3 S = at->S_map_keyframe();
      const Eigen::Vector3d p = S * landmark.point_cam;
      id.push_back(landmark.id.value());
      keyframe.push_back(landmark.keyframe.value());
      component.push_back(at->component);
      positions.insert(positions.end(), {p.x(), p.y(), p.z()});
      const Eigen::Matrix3d R = S.scale() * S.rotation().matrix();
      append_rows(landmark.covariance ? Eigen::Matrix3d(R * *landmark.covariance * R.transpose())
                                      : Eigen::Matrix3d(Eigen::Matrix3d::Constant(kUnknown)),
                  covariances);
      const auto rgb = landmark.rgb.value_or(kUnknownColour);
      colours.insert(colours.end(), rgb.begin(), rgb.end());
    }
  }
  const std::size_t n = id.size();
  Table table;
  table["id"] = owned_array(std::move(id), {n});
  table["keyframe"] = owned_array(std::move(keyframe), {n});
  table["component"] = owned_array(std::move(component), {n});
  table["position"] = owned_array(std::move(positions), {n, 3});
  table["covariance"] = owned_array(std::move(covariances), {n, 3, 3});
  table["rgb"] = owned_array(std::move(colours), {n, 3});
  return table;
}

Table observation_table(const Map& map) {
  std::vector<std::int64_t> keyframe, landmark;
  std::vector<float> px;
  std::vector<std::int32_t> camera;
  {
    const WithoutGil released;
    for (const Keyframe& each : map.keyframes)
      for (const LandmarkObservation& seen : each.observations) {
        keyframe.push_back(each.id.value());
        landmark.push_back(seen.landmark.value());
        px.insert(px.end(), {seen.px.x(), seen.px.y()});
        camera.push_back(seen.camera);
      }
  }
  const std::size_t n = keyframe.size();
  Table table;
  table["keyframe"] = owned_array(std::move(keyframe), {n});
  table["landmark"] = owned_array(std::move(landmark), {n});
  table["px"] = owned_array(std::move(px), {n, 2});
  table["camera"] = owned_array(std::move(camera), {n});
  return table;
}

Table loop_table(const Map& map) {
  std::vector<std::int64_t> query, match;
  std::vector<std::int32_t> inliers, lines;
  std::vector<double> similarity, probability;
  nb::list accepted, stage, model;
  for (const LoopRecord& loop : map.loops) {
    query.push_back(loop.query_frame.value());
    match.push_back(loop.match_frame.value());
    accepted.append(loop.accepted());
    stage.append(to_string(loop.stage));
    model.append(to_string(loop.model));
    inliers.push_back(loop.inliers);
    lines.push_back(loop.lines);
    similarity.push_back(loop.similarity);
    probability.push_back(loop.probability);
  }
  const std::size_t n = query.size();
  Table table;
  table["query_frame"] = owned_array(std::move(query), {n});
  table["match_frame"] = owned_array(std::move(match), {n});
  table["accepted"] = accepted;
  table["stage"] = stage;
  table["model"] = model;
  table["inliers"] = owned_array(std::move(inliers), {n});
  table["lines"] = owned_array(std::move(lines), {n});
  table["similarity"] = owned_array(std::move(similarity), {n});
  table["probability"] = owned_array(std::move(probability), {n});
  return table;
}

Table feature_table(const Map& map, std::int64_t id) {
  const Keyframe* keyframe = map.find_keyframe(KeyframeId(id));
  if (!keyframe) throw ArgumentError(fmt::format("keyframe: the map has no keyframe {}", id));
  static_assert(std::endian::native == std::endian::little);
  std::vector<float> px, angle, points;
  std::vector<std::int32_t> octave;
  std::vector<std::uint8_t> descriptors(keyframe->features.size() * sizeof(BinaryDescriptor));
  std::uint8_t* next = descriptors.data();
  for (const Feature& feature : keyframe->features) {
    px.insert(px.end(), {feature.px.x(), feature.px.y()});
    angle.push_back(feature.angle_rad);
    octave.push_back(feature.octave);
    append_point(feature.point_cam, points);
    std::memcpy(next, feature.descriptor.data(), sizeof(BinaryDescriptor));
    next += sizeof(BinaryDescriptor);
  }
  const std::size_t n = keyframe->features.size();
  Table table;
  table["px"] = owned_array(std::move(px), {n, 2});
  table["angle_rad"] = owned_array(std::move(angle), {n});
  table["octave"] = owned_array(std::move(octave), {n});
  table["descriptor"] = owned_array(std::move(descriptors), {n, sizeof(BinaryDescriptor)});
  table["point_cam"] = owned_array(std::move(points), {n, 3});
  return table;
}

TableList place_rows(const Map& map) {
  TableList rows;
  const std::vector<int> components = map.place_graph.joined_components();
  for (std::size_t i = 0; i < map.place_graph.places.size(); ++i) {
    const Place& place = map.place_graph.places[i];
    std::vector<std::int64_t> members;
    for (const PlaceMember& member : place.members) members.push_back(member.keyframe.value());
    const std::optional<Environment> environment = environment_of(place);
    Table row;
    row["id"] = place.id.value();
    row["anchor_keyframe"] = place.anchor_keyframe.value();
    row["component"] = components[i];
    row["labels"] = place.labels;
    row["environment"] = environment ? nb::cast(environment_name(*environment)) : nb::none();
    row["pose"] = pose_matrix(place.T_map_place);
    row["scale"] = place.scale;
    row["keyframes"] = members;
    rows.append(row);
  }
  return rows;
}

TableList edge_rows(const Map& map) {
  TableList rows;
  for (const RelativePoseConstraint& edge : map.place_graph.constraints) {
    Table row;
    row["from"] = place_of_node(edge.from).value();
    row["to"] = place_of_node(edge.to).value();
    row["source"] = to_string(edge.source);
    rows.append(row);
  }
  return rows;
}

TableList component_rows(const Map& map) {
  TableList rows;
  for (const MapComponent& component : map.components()) {
    Table row;
    row["number"] = component.number;
    row["main"] = component.main;
    row["posed"] = component.posed;
    row["first_frame"] = map.frames[component.first].frame.value();
    row["last_frame"] = map.frames[component.last].frame.value();
    rows.append(row);
  }
  return rows;
}

}  // namespace placegraph::python
