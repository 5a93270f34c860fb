#include <placegraph/io/graphs/geo_export.h>

#include <nlohmann/json.hpp>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace geo_export_test {

using nlohmann::json;
using test::message_of;
using test::TemporaryFolder;
using testing::HasSubstr;

std::string content_of(const std::string& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

StampedPose at(double east, double north, double up) {
  return {0, SE3(SO3(), {east, north, up}).isometry()};
}

/// Three poses, the third after a lost frame's gap; two nodes and a loop between them.
GeoDocument document(const GeodeticPosition& origin = {49, 8.4, 100}) {
  GeoDocument out;
  out.name = "a \"map\" <of> Karlsruhe & beyond";
  out.origin = origin;
  out.trajectory.poses = {
      at(0, 0, 0), at(100, 0, 1), {0, std::nullopt}, at(200, 0, 2), at(200, 50, 3)};
  out.graph.nodes = {{NodeId(7), SE3(), false}, {NodeId(9), SE3(SO3(), {0, 100, 5}), false}};
  RelativePoseConstraint edge;
  edge.from = NodeId(7);
  edge.to = NodeId(9);
  edge.T_from_to = SE3(SO3(), {0, 100, 5});
  edge.information = Matrix6d::Identity();
  edge.source = ConstraintSource::kLoop;
  out.graph.constraints.emplace_back(edge);
  out.node_stamps_ns = {1000, 2000};
  return out;
}

std::vector<json> features_of(const std::string& path, const std::string& kind) {
  std::vector<json> found;
  const json whole = json::parse(content_of(path));
  for (const json& feature : whole.at("features"))
    if (feature.at("properties").at("kind") == kind) found.push_back(feature);
  return found;
}

TEST(GeoExport, WritesGeoJsonWithLongitudeFirst) {
  const TemporaryFolder folder;
  write_geojson(folder / "map.geojson", document());
  const json whole = json::parse(content_of(folder / "map.geojson"));
  EXPECT_EQ(whole.at("type"), "FeatureCollection");
  EXPECT_EQ(whole.at("placegraph").at("name"), document().name);
  EXPECT_EQ(whole.at("placegraph").at("origin").at("latitude_deg"), 49.0);
  const auto origin = features_of(folder / "map.geojson", "origin");
  ASSERT_EQ(origin.size(), 1u);
  EXPECT_EQ(origin[0].at("geometry").at("coordinates"), json({8.4, 49.0, 100.0}));
  const auto nodes = features_of(folder / "map.geojson", "node");
  ASSERT_EQ(nodes.size(), 2u);
  EXPECT_EQ(nodes[1].at("properties").at("id"), 9);
  EXPECT_EQ(nodes[1].at("properties").at("stamp_ns"), 2000);
  const GeodeticPosition north = EnuFrame({49, 8.4, 100}).to_geodetic({0, 100, 5});
  EXPECT_NEAR(nodes[1].at("geometry").at("coordinates")[1].get<double>(), north.latitude_deg, 1e-9);
  EXPECT_NEAR(nodes[1].at("geometry").at("coordinates")[2].get<double>(), 105, 1e-2);
}

TEST(GeoExport, InterruptsTheTrajectoryWhereFramesAreLost) {
  const TemporaryFolder folder;
  write_geojson(folder / "map.geojson", document());
  const auto lines = features_of(folder / "map.geojson", "trajectory");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].at("geometry").at("type"), "MultiLineString");
  EXPECT_EQ(lines[0].at("geometry").at("coordinates").size(), 2u);
  const auto edges = features_of(folder / "map.geojson", "edge");
  ASSERT_EQ(edges.size(), 1u);
  EXPECT_EQ(edges[0].at("properties").at("source"), "loop");
}

TEST(GeoExport, CutsLinesAtThe180thMeridian) {
  const TemporaryFolder folder;
  write_geojson(folder / "map.geojson", document({0, 179.9995, 0}));
  const json lines =
      features_of(folder / "map.geojson", "trajectory")[0].at("geometry").at("coordinates");
  ASSERT_EQ(lines.size(), 3u);  // 55.66 m to the meridian: the first part of 100 m is cut
  EXPECT_EQ(lines[0].back()[0], 180.0);
  EXPECT_EQ(lines[1].front()[0], -180.0);
  EXPECT_LT(lines[1].back()[0].get<double>(), -179.99);
}

TEST(GeoExport, WritesKmlWithItsOriginAndEscapedNames) {
  const TemporaryFolder folder;
  write_kml(folder / "map.kml", document());
  const std::string kml = content_of(folder / "map.kml");
  EXPECT_THAT(kml, HasSubstr("<name>a \"map\" &lt;of&gt; Karlsruhe &amp; beyond</name>"));
  EXPECT_THAT(kml,
              HasSubstr("latitude 49.000000000 deg, longitude 8.400000000 deg, height 100.0000 m"));
  EXPECT_THAT(kml,
              HasSubstr("<Point><coordinates>8.400000000,49.000000000,100.0000</coordinates>"));
  EXPECT_THAT(kml, HasSubstr("<name>7 - 9</name><styleUrl>#loop</styleUrl>"));
  // Every element that is opened is closed.
  std::vector<std::string> open;
  for (std::size_t i = kml.find("<kml"); i != std::string::npos; i = kml.find('<', i + 1)) {
    const std::size_t end = kml.find_first_of(" >", i);
    const std::string tag = kml.substr(i + 1, end - i - 1);
    if (tag[0] != '/') {
      open.push_back(tag);
      continue;
    }
    ASSERT_FALSE(open.empty());
    EXPECT_EQ("/" + open.back(), tag);
    open.pop_back();
  }
  EXPECT_TRUE(open.empty());
}

TEST(GeoExport, LeavesNoFileBehindWhenItRefuses) {
  const TemporaryFolder folder;
  GeoDocument wrong = document();
  wrong.node_stamps_ns.pop_back();
  EXPECT_THAT(message_of<ArgumentError>([&] { write_geojson(folder / "map.geojson", wrong); }),
              HasSubstr("stamps"));
  EXPECT_THROW(write_kml(folder / "map.kml", document({99, 0, 0})), ArgumentError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_THROW(write_kml(folder / "absent/map.kml", document()), FileError);
}

}  // namespace geo_export_test
}  // namespace placegraph
