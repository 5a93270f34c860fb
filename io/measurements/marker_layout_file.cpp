#include <fmt/format.h>
#include <placegraph/io/config/yaml_document.h>
#include <placegraph/io/files/atomic_file.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/measurements/marker_layout_file.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace placegraph {
namespace {

void refuse_unknown(const YamlDocument& yaml, const YAML::Node& map,
                    const std::vector<std::string>& known) {
  if (!map.IsMap()) yaml.fail(map, "expected keys and values");
  std::set<std::string> seen;
  for (const auto& entry : map) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "";
    if (std::find(known.begin(), known.end(), key) == known.end())
      yaml.fail(entry.first, in_quotes(key) + ": unknown key");
    if (!seen.insert(key).second) yaml.fail(entry.first, key + ": comes twice");
  }
}

YAML::Node list(const YamlDocument& yaml, const char* key) {
  const YAML::Node node = yaml.root()[key];
  if (node.IsDefined() && !node.IsSequence()) yaml.fail(node, std::string(key) + ": is not a list");
  return node;
}

Eigen::Vector3d position(const YamlDocument& yaml, const YAML::Node& at, const YAML::Node& node) {
  Eigen::Vector3d p = Eigen::Vector3d::Constant(NAN);
  if (node.IsSequence() && node.size() == 3)
    for (std::size_t i = 0; i < 3; ++i)
      p[static_cast<Eigen::Index>(i)] = yaml_number(node[i]).value_or(NAN);
  constexpr double kFar_m = 1e6;
  if (!p.allFinite() || p.cwiseAbs().maxCoeff() > kFar_m)
    yaml.fail(at, "a position is three numbers [m]");
  return p;
}

/// Reads a marker; returns false if its pose is not given, and then the pose of `marker` is not
/// set.
bool read_marker(const YamlDocument& yaml, const YAML::Node& node, PlacedMarker& marker) {
  refuse_unknown(yaml, node, {"id", "side_m", "position", "quaternion"});
  const double id = yaml.number(node, "id");
  constexpr double kMaxId = 1e6;
  if (!(id >= 0 && id <= kMaxId && id == std::floor(id)))
    yaml.fail(node["id"], "id: is not a whole number from 0 on");
  marker.id = static_cast<int>(id);
  marker.side_m = yaml.number(node, "side_m");
  constexpr double kMaxSide_m = 1000;
  if (!(marker.side_m > 0 && marker.side_m <= kMaxSide_m))
    yaml.fail(node["side_m"], fmt::format("side_m: {} is not a valid side length", marker.side_m));
  if (!node["position"].IsDefined() && !node["quaternion"].IsDefined()) return false;
  const Eigen::Vector3d p =
      position(yaml, yaml.member(node, "position"), yaml.member(node, "position"));
  const std::vector<double> q = yaml.numbers(node, "quaternion", 4);
  const Eigen::Quaterniond quaternion(q[0], q[1], q[2], q[3]);
  // Rounding of a text of three decimals.
  constexpr double kUnitTolerance = 1e-3;
  if (std::abs(quaternion.norm() - 1) > kUnitTolerance)
    yaml.fail(node["quaternion"],
              fmt::format("quaternion: has length {:.4f}, not 1", quaternion.norm()));
  marker.T_world_marker = SE3(SO3(quaternion), p);
  return true;
}

}  // namespace

MarkerLayout read_marker_layout(const std::string& path) {
  const YamlDocument yaml(path);
  if (!yaml.root().IsMap()) yaml.fail(yaml.root(), "expected dictionary, markers and beacons");
  refuse_unknown(yaml, yaml.root(), {"dictionary", "markers", "beacons"});
  MarkerLayout layout;
  layout.dictionary = yaml.text(yaml.root(), "dictionary");
  std::set<int> ids;
  for (const YAML::Node& node : list(yaml, "markers")) {
    PlacedMarker marker;
    if (read_marker(yaml, node, marker))
      layout.markers.push_back(marker);
    else
      layout.unplaced_sides_m[marker.id] = marker.side_m;
    if (!ids.insert(marker.id).second)
      yaml.fail(node["id"], fmt::format("id: {} comes twice", marker.id));
  }
  for (const YAML::Node& node : list(yaml, "beacons"))
    layout.beacons_world.push_back(position(yaml, node, node));
  if (ids.empty() && layout.beacons_world.empty())
    yaml.fail(yaml.root(), "neither markers nor beacons in it");
  return layout;
}

void write_marker_layout(const std::string& path, const MarkerLayout& layout) {
  AtomicFile file(path);
  file.stream()
      << "# T_world_marker of square markers (x right, y up, z out of the face; quaternion "
         "w x y z) and places of beacons [m].\n"
      << "dictionary: " << layout.dictionary << "\nmarkers:"
      << (layout.markers.empty() && layout.unplaced_sides_m.empty() ? " []\n" : "\n");
  for (const PlacedMarker& marker : layout.markers) {
    const Eigen::Vector3d& p = marker.T_world_marker.translation();
    const Eigen::Quaterniond& q = marker.T_world_marker.rotation().quaternion();
    file.stream() << fmt::format(
        "  - {{id: {}, side_m: {}, position: [{:.9f}, {:.9f}, {:.9f}], "
        "quaternion: [{:.12f}, {:.12f}, {:.12f}, {:.12f}]}}\n",
        marker.id, marker.side_m, p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z());
  }
  for (const auto& [id, side_m] : layout.unplaced_sides_m)
    file.stream() << fmt::format("  - {{id: {}, side_m: {}}}\n", id, side_m);
  file.stream() << "beacons:" << (layout.beacons_world.empty() ? " []\n" : "\n");
  for (const Eigen::Vector3d& p : layout.beacons_world)
    file.stream() << fmt::format("  - [{:.9f}, {:.9f}, {:.9f}]\n", p.x(), p.y(), p.z());
  file.commit();
}

}  // namespace placegraph
