#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/base64.h>
#include <placegraph/io/files/little_endian.h>
#include <placegraph/io/exports/mcap_file.h>
#include <placegraph/pipeline/exports/mcap_export.h>
#include <placegraph/pipeline/map/map_geometry.h>

#include <nlohmann/json.hpp>

namespace placegraph {
namespace {

using McapJson = nlohmann::ordered_json;

McapJson foxglove_time(std::int64_t stamp_ns) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  return {{"sec", stamp_ns / kSecond_ns}, {"nsec", stamp_ns % kSecond_ns}};
}

McapJson foxglove_vector(const Eigen::Vector3d& v) {
  return {{"x", v[0]}, {"y", v[1]}, {"z", v[2]}};
}

McapJson foxglove_rotation(const SO3& R) {
  const Eigen::Quaterniond& q = R.quaternion();
  return {{"x", q.x()}, {"y", q.y()}, {"z", q.z()}, {"w", q.w()}};
}

McapJson foxglove_pose(const SE3& T) {
  return {{"position", foxglove_vector(T.translation())},
          {"orientation", foxglove_rotation(T.rotation())}};
}

/// JSON Schema of an object with these members.
McapJson object_schema(McapJson members) {
  return {{"type", "object"}, {"properties", std::move(members)}};
}

McapJson numbers_schema(std::initializer_list<const char*> names, const char* type = "number") {
  McapJson members = McapJson::object();
  for (const char* name : names) members[name] = {{"type", type}};
  return object_schema(std::move(members));
}

std::vector<McapRecording::Schema> foxglove_schemas() {
  const McapJson text = {{"type", "string"}};
  const McapJson time = numbers_schema({"sec", "nsec"}, "integer");
  const McapJson position = numbers_schema({"x", "y", "z"});
  const McapJson rotation = numbers_schema({"x", "y", "z", "w"});
  const McapJson pose = object_schema({{"position", position}, {"orientation", rotation}});
  const McapJson integer = {{"type", "integer"}};
  const McapJson field = object_schema({{"name", text}, {"offset", integer}, {"type", integer}});
  const auto schema = [](const std::string& name, McapJson members) {
    McapJson json = object_schema(std::move(members));
    json["title"] = name;
    return McapRecording::Schema{name, json.dump()};
  };
  return {schema("foxglove.FrameTransform", {{"timestamp", time},
                                             {"parent_frame_id", text},
                                             {"child_frame_id", text},
                                             {"translation", position},
                                             {"rotation", rotation}}),
          schema("foxglove.PosesInFrame", {{"timestamp", time},
                                           {"frame_id", text},
                                           {"poses", {{"type", "array"}, {"items", pose}}}}),
          schema("foxglove.PointCloud",
                 {{"timestamp", time},
                  {"frame_id", text},
                  {"pose", pose},
                  {"point_stride", integer},
                  {"fields", {{"type", "array"}, {"items", field}}},
                  {"data", {{"type", "string"}, {"contentEncoding", "base64"}}}})};
}

/// Positions in `schemas` and `channels` of the recording.
constexpr std::size_t kTransformChannel = 0, kTrajectoryChannel = 1, kLandmarkChannel = 2;

std::string transform_message(std::int64_t stamp_ns, const char* parent, const char* child,
                              const SE3& T_parent_child) {
  return McapJson({{"timestamp", foxglove_time(stamp_ns)},
                   {"parent_frame_id", parent},
                   {"child_frame_id", child},
                   {"translation", foxglove_vector(T_parent_child.translation())},
                   {"rotation", foxglove_rotation(T_parent_child.rotation())}})
      .dump();
}

std::string cloud_message(std::int64_t stamp_ns, const std::vector<PlacedLandmark>& landmarks) {
  constexpr int kByte = 1, kFloat = 7;  // foxglove.NumericType
  std::string bytes;
  for (const PlacedLandmark& landmark : landmarks) {
    for (int i = 0; i < 3; ++i) append_number(bytes, static_cast<float>(landmark.p_map[i]));
    for (const std::uint8_t value : landmark.rgb.value_or(kUnknownColour))
      append_number(bytes, value);
    append_number(bytes, std::uint8_t{255});
  }
  McapJson fields = McapJson::array();
  int offset = 0;
  for (const char* name : {"x", "y", "z"}) {
    fields.push_back({{"name", name}, {"offset", offset}, {"type", kFloat}});
    offset += 4;
  }
  for (const char* name : {"red", "green", "blue", "alpha"})
    fields.push_back({{"name", name}, {"offset", offset++}, {"type", kByte}});
  return McapJson({{"timestamp", foxglove_time(stamp_ns)},
                   {"frame_id", "map"},
                   {"pose", foxglove_pose(SE3())},
                   {"point_stride", offset},
                   {"fields", fields},
                   {"data", to_base64(bytes)}})
      .dump();
}

/// Rotation from the map (x right, y down, z forward) to the axes of robots.
SO3 world_axes() {
  Eigen::Matrix3d R;
  R << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return SO3::from_matrix(R);
}

}  // namespace

std::string map_mcap(const StoredMap& stored, int component) {
  McapRecording recording;
  recording.schemas = foxglove_schemas();
  recording.channels = {{"/tf", kTransformChannel},
                        {"/trajectory", kTrajectoryChannel},
                        {"/landmarks", kLandmarkChannel}};
  std::vector<McapRecording::Message>& messages = recording.messages;
  McapJson poses = McapJson::array();
  for (const StampedPose& pose : stored.map.trajectory_optimized(component).poses) {
    if (!pose.T_world_body) continue;
    const SE3 T_map_cam(*pose.T_world_body);
    poses.push_back(foxglove_pose(T_map_cam));
    messages.push_back({kTransformChannel, pose.stamp_ns,
                        transform_message(pose.stamp_ns, "map", "camera", T_map_cam)});
  }
  if (messages.empty()) throw NoResult("MCAP: no frame of the component has a pose");
  const std::int64_t first = messages.front().time_ns;
  messages.push_back(
      {kTransformChannel, first,
       transform_message(first, "world", "map", SE3(world_axes(), Eigen::Vector3d::Zero()))});
  messages.push_back(
      {kTrajectoryChannel, first,
       McapJson({{"timestamp", foxglove_time(first)}, {"frame_id", "map"}, {"poses", poses}})
           .dump()});
  messages.push_back({kLandmarkChannel, first,
                      cloud_message(first, geometry_of(stored.map, component).landmarks)});
  return to_mcap(recording);
}

}  // namespace placegraph
