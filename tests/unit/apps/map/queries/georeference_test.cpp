#include "apps/map/queries/georeference.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>

#include "apps/support/output.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace georeference_test {

using nlohmann::json;
using test::message_of;
using testing::HasSubstr;

constexpr int kNodes = 100;
constexpr double kRadius_m = 20, kAngle_rad = 0.05;  ///< between neighbours
/// Radii of WGS84 at latitude 49 deg, height 115 m: of curvature along the meridian, and of the
/// circle of latitude.
constexpr double kMeridian_m = 6371963.6, kParallel_m = 4192510.4;

/// A drive around a circle in the plane, one pose a tenth of a second, and the fixes along it: the
/// first pose is 100 m east of 49 N 8.4 E and looks north.
class GeoreferenceCommand : public testing::Test {
 protected:
  GeoreferenceCommand() {
    std::ostringstream graph, times;
    graph.precision(12);
    const double chord_m = 2 * kRadius_m * std::sin(kAngle_rad / 2);
    for (int i = 0; i < kNodes; ++i) {
      graph << "VERTEX_SE2 " << i << ' ' << kRadius_m * std::sin(i * kAngle_rad) << ' '
            << kRadius_m * (1 - std::cos(i * kAngle_rad)) << ' ' << i * kAngle_rad << '\n';
      times << 0.1 * i << '\n';
    }
    for (int i = 1; i < kNodes; ++i)
      graph << "EDGE_SE2 " << i - 1 << ' ' << i << ' ' << chord_m * std::cos(kAngle_rad / 2) << ' '
            << chord_m * std::sin(kAngle_rad / 2) << ' ' << kAngle_rad << " 1e4 0 0 1e4 0 1e6\n";
    arguments.graph = folder.write("graph.g2o", graph.str());
    arguments.times = folder.write("times.txt", times.str());
    arguments.gps = folder / "oxts.txt";
    folder.write("times_oxts.txt", times.str());
    arguments.out = folder / "out";
    arguments.origin = "49,8.4,115";
    write_fixes();
  }
  /// Of an antenna on a circle about the same middle. Those numbered in [off_begin, off_end) are
  /// 50 m off to the east.
  void write_fixes(double radius_m = kRadius_m, int off_begin = 0, int off_end = 0) const {
    std::ostringstream out;
    out.precision(15);
    for (int i = 0; i < kNodes; ++i) {
      const double off_m = i >= off_begin && i < off_end ? 50 : 0;
      const double east_m = 100 - kRadius_m + radius_m * std::cos(i * kAngle_rad) + off_m,
                   north_m = radius_m * std::sin(i * kAngle_rad);
      out << 49 + rad_to_deg(north_m / kMeridian_m) << ' ' << 8.4 + rad_to_deg(east_m / kParallel_m)
          << " 115 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0.1 0 4 8 -1 -1 -1\n";
    }
    folder.write("oxts.txt", out.str());
  }
  template <class Exception>
  void expect_nothing_written(const std::string& message) {
    EXPECT_THAT(message_of<Exception>([&] { georeference(arguments); }), HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(arguments.out));
  }
  test::TemporaryFolder folder;
  GeoreferenceArguments arguments;
};

TEST_F(GeoreferenceCommand, PutsTheMapOntoTheEarth) {
  const GeoreferenceReport report = georeference(arguments);
  EXPECT_EQ(report.result.fixes_used, kNodes);
  EXPECT_EQ(report.result.fixes_rejected, 0);
  EXPECT_FALSE(report.result.scale);  // the map has one
  EXPECT_FALSE(report.summary.contains("scale"));
  EXPECT_LT(report.result.residual_rms_m, 0.01);
  EXPECT_EQ(report.summary["origin"]["height_m"], 115.0);
  EXPECT_EQ(json::parse(test::read_file(folder / "out/georeference.json")), json(report.summary));
  const Trajectory written = read_trajectory(folder / "out/trajectory_enu.tum");
  ASSERT_EQ(written.size(), static_cast<std::size_t>(kNodes));
  const Eigen::Isometry3d first = *written.poses[0].T_world_body;
  EXPECT_LT((first.translation() - Eigen::Vector3d(100, 0, 0)).norm(), 0.02);
  // Ahead is the map's x: north.
  EXPECT_LT((first.linear().col(0) - Eigen::Vector3d::UnitY()).norm(), 1e-3);
  EXPECT_EQ(read_g2o(folder / "out/graph_enu.g2o").nodes.size(), static_cast<std::size_t>(kNodes));
  for (const char* name : {"map.geojson", "map.kml", "fixes.csv"})
    EXPECT_TRUE(std::filesystem::exists(folder / ("out/" + std::string(name)))) << name;
}

TEST_F(GeoreferenceCommand, GivesTheFolderOfARunWithoutScaleItsScale) {
  constexpr double kUnit_m = 2.5;
  constexpr int kPlaces = 10, kFramesAPlace = kNodes / kPlaces;
  const auto T_map_cam = [&](int i) {
    const double a = i * kAngle_rad, r = kRadius_m / kUnit_m;
    return SE3(SO3::exp({0, 0, a}), {r * std::sin(a), r * (1 - std::cos(a)), 0});
  };
  PoseGraph graph;
  Trajectory trajectory;
  json places = json::array();
  for (int i = 0; i < kNodes; ++i)
    trajectory.poses.push_back({100'000'000LL * i, T_map_cam(i).isometry()});
  for (int p = 0; p < kPlaces; ++p) {
    const SE3 T_map_place = T_map_cam(kFramesAPlace * p);
    graph.nodes.push_back({NodeId(p), Sim3(T_map_place), p == 0});
    places.push_back({{"id", p}, {"members", {{{"stamp_ns", 100'000'000LL * kFramesAPlace * p}}}}});
    if (p == 0) continue;
    const SE3 T_from_to = T_map_cam(kFramesAPlace * (p - 1)).inverse() * T_map_place;
    graph.constraints.emplace_back(
        RelativePoseConstraint{.from = NodeId(p - 1),
                               .to = NodeId(p),
                               .T_from_to = Sim3(T_from_to),
                               .information = 1e4 * Information::Identity(7, 7),
                               .kernel = {}});
  }
  std::filesystem::create_directory(folder / "run");
  write_g2o(folder / "run/graph.g2o", graph);
  write_trajectory(folder / "run/trajectory_optimized.tum", trajectory, TrajectoryFormat::kTum);
  folder.write("run/places.json", json{{"places", places}}.dump());
  folder.write("run/result.json", R"({"metric": false})");
  arguments.graph = folder / "run";
  arguments.times.clear();
  const GeoreferenceReport report = georeference(arguments);
  ASSERT_TRUE(report.result.scale);
  EXPECT_NEAR(report.result.scale->metres_per_unit, kUnit_m, 1e-3);
  EXPECT_GT(report.result.scale->sigma, 0);
  EXPECT_LT(report.result.scale->sigma, 0.1);
  EXPECT_EQ(report.summary["scale"]["metres_per_unit"], report.result.scale->metres_per_unit);
  EXPECT_EQ(report.summary["scale"]["sigma"], report.result.scale->sigma);
  EXPECT_THAT(to_text(report), HasSubstr("\nscale        2.5 +- "));
  const Trajectory written = read_trajectory(folder / "out/trajectory_enu.tum");
  ASSERT_EQ(written.size(), static_cast<std::size_t>(kNodes));
  for (int i = 0; i < kNodes; ++i) {
    const Eigen::Vector3d at =
        written.poses[static_cast<std::size_t>(i)].T_world_body->translation();
    const Eigen::Vector3d truth_m(100 - kRadius_m + kRadius_m * std::cos(i * kAngle_rad),
                                  kRadius_m * std::sin(i * kAngle_rad), 0);
    EXPECT_LT((at - truth_m).norm(), 0.05) << i;
  }
  const PoseGraph placed = read_g2o(folder / "out/graph_enu.g2o");
  ASSERT_EQ(placed.kind(), PoseKind::kSE3);
  const auto& edge = std::get<RelativePoseConstraint>(placed.constraints.front());
  EXPECT_NEAR(std::get<SE3>(edge.T_from_to).translation().norm(),
              2 * kRadius_m * std::sin(kFramesAPlace * kAngle_rad / 2), 0.02);
}

TEST_F(GeoreferenceCommand, TakesASavedMap) {
  constexpr double kUnit_m = 2.5;
  const auto T_map_cam = [&](int i) {
    const double a = i * kAngle_rad, r = kRadius_m / kUnit_m;
    return SE3(SO3::exp({0, 0, a}), {r * std::sin(a), r * (1 - std::cos(a)), 0});
  };
  StoredMap stored;
  stored.origin.calibration.emplace().camera = {640, 480, 500, 500, 320, 240, Distortion::kNone,
                                                {}};
  Map& map = stored.map;
  for (int i = 0; i < kNodes; ++i) {
    const KeyframeId id(i / 10);
    const std::int64_t stamp_ns = 100'000'000LL * i;
    if (i % 10 == 0) {
      Keyframe keyframe;
      keyframe.id = id;
      keyframe.place = PlaceId(id.value());
      keyframe.frame = FrameId(i);
      keyframe.stamp_ns = stamp_ns;
      map.keyframes.push_back(keyframe);
      Place place;
      place.id = keyframe.place;
      place.anchor_keyframe = id;
      place.T_map_place = T_map_cam(i);
      place.members = {{id, SE3(), 1}};
      map.place_graph.places.push_back(place);
      if (i > 0)
        map.place_graph.constraints.push_back(
            {.from = NodeId(i / 10 - 1),
             .to = NodeId(i / 10),
             .T_from_to = Sim3(T_map_cam(i - 10).inverse() * T_map_cam(i)),
             .information = 1e4 * Information::Identity(7, 7),
             .kernel = {}});
    }
    map.frames.push_back({FrameId(i), stamp_ns, id,
                          map.place_graph.places.back().T_map_place.inverse() * T_map_cam(i), 50});
    map.trajectory_online.poses.push_back({stamp_ns, std::nullopt});
  }
  map.frames.back().keyframe.reset();  // lost
  map.frames.back().T_keyframe_frame.reset();
  write_map(folder / "map.db", stored);
  arguments.graph = folder / "map.db";
  EXPECT_THAT(message_of<ArgumentError>([&] { georeference(arguments); }),
              HasSubstr("--times: a saved map has its own"));
  arguments.times.clear();
  const GeoreferenceReport report = georeference(arguments);
  ASSERT_TRUE(report.result.scale);
  EXPECT_NEAR(report.result.scale->metres_per_unit, kUnit_m, 1e-3);
  EXPECT_EQ(report.result.trajectory.size(), static_cast<std::size_t>(kNodes - 1));
  EXPECT_LT(report.result.residual_rms_m, 0.05);
}

TEST_F(GeoreferenceCommand, AnAntennaBesideTheCameraIsHeeded) {
  write_fixes(kRadius_m - 5);  // to the left of the drive, towards the circle's middle
  expect_nothing_written<NoResult>("fixes agree on an alignment of the map");
  arguments.lever_arm = "0,5,0";
  const GeoreferenceReport report = georeference(arguments);
  EXPECT_LT(report.result.residual_rms_m, 0.01);
  const Eigen::Vector3d first = report.result.trajectory.poses[0].T_world_body->translation();
  EXPECT_LT((first - Eigen::Vector3d(100, 0, 0)).norm(), 0.02);
}

TEST_F(GeoreferenceCommand, FixesThatAreFarOffAreRejected) {
  write_fixes(kRadius_m, 40, 45);
  const GeoreferenceReport report = georeference(arguments);
  EXPECT_EQ(report.result.fixes_rejected, 5);
  EXPECT_EQ(report.result.fixes_used, kNodes - 5);
  EXPECT_THAT(to_text(report), HasSubstr("fixes        95 used, 5 rejected, 0 outside the map's"));
  EXPECT_THAT(to_text(report), HasSubstr("origin       49.000000000, 8.400000000, 115.000 m"));
}

TEST_F(GeoreferenceCommand, NamesTheArgumentThatIsWrong) {
  arguments.lever_arm = "1,2";
  expect_nothing_written<ArgumentError>("--lever-arm: '1,2' is not three numbers x,y,z");
  arguments.lever_arm = "1,2,x";
  expect_nothing_written<ArgumentError>("--lever-arm: 'x' is not a number");
  arguments.lever_arm.clear();
  arguments.origin = "95,8,0";
  expect_nothing_written<ArgumentError>("--origin: latitude");
  arguments.origin.clear();
  arguments.clock_offset = "soon";
  expect_nothing_written<ArgumentError>("--clock-offset: 'soon' is not a number of seconds");
  arguments.clock_offset.clear();
  arguments.times.clear();
  expect_nothing_written<ArgumentError>("--times: needed with a file of a graph");
}

TEST_F(GeoreferenceCommand, NamesTheFileAndTheLineThatAreWrong) {
  folder.write("times.txt", "0\n1\n2\n");
  expect_nothing_written<FileError>("times.txt: holds 3 times, none for node 3");
  folder.write("graph.g2o", "VERTEX_SE2 0 0 0 x\n");
  expect_nothing_written<FileError>("graph.g2o:1");
}

TEST_F(GeoreferenceCommand, WritesNothingWhereTheFixesAreOfAnotherTime) {
  std::ostringstream times;
  for (int i = 0; i < kNodes; ++i) times << 1000 + 0.1 * i << '\n';
  folder.write("times_oxts.txt", times.str());
  expect_nothing_written<NoResult>("no time in common");
}

}  // namespace georeference_test
}  // namespace placegraph::apps
