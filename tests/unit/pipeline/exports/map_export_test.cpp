#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/trajectories/trajectory_file.h>
#include <placegraph/pipeline/exports/map_export.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/support/message_of.h"
#include "tests/support/random_map.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace map_export_test {

using test::message_of;
using testing::HasSubstr;

class MapExportCommand : public testing::Test {
 protected:
  MapExportCommand() {
    save(false);
    arguments.map = folder.path();
    arguments.paths.resize(map_export_forms().size());
  }
  void save(bool scaled) {
    Random random(3);
    stored = test::random_map(random, 4, scaled);
    write_map(folder / "map.db", stored);
  }
  /// The path of the form of this flag.
  std::string& path(const std::string& flag) {
    const std::vector<MapExportForm> forms = map_export_forms();
    for (std::size_t i = 0; i < forms.size(); ++i)
      if (forms[i].flag == flag) return arguments.paths[i];
    throw std::runtime_error("no form " + flag);
  }
  test::TemporaryFolder folder;
  StoredMap stored;
  MapExportArguments arguments;
};

TEST_F(MapExportCommand, WritesTheFormsThatAreAskedForAndNoOther) {
  path("--g2o") = folder / "g.g2o";
  path("--tum") = folder / "t.tum";
  const MapExportResult result = map_export(arguments);
  EXPECT_EQ(result.written, (std::vector<std::string>{folder / "g.g2o", folder / "t.tum"}));
  const PoseGraph graph = read_g2o(folder / "g.g2o");
  EXPECT_EQ(graph.nodes.size(), 4u);
  EXPECT_EQ(graph.constraints.size(), 3u);
  const Trajectory written = read_trajectory(folder / "t.tum");
  EXPECT_EQ(written.posed(), stored.map.trajectory_optimized().posed());
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 3);
}

TEST_F(MapExportCommand, LeavesTheScalesOfPlacesOutForProgramsThatKnowNone) {
  save(true);
  path("--g2o") = folder / "g.g2o";
  path("--g2o-se3") = folder / "rigid.g2o";
  map_export(arguments);
  EXPECT_EQ(read_g2o(folder / "g.g2o").kind(), PoseKind::kSim3);
  EXPECT_EQ(read_g2o(folder / "rigid.g2o").kind(), PoseKind::kSE3);
}

TEST_F(MapExportCommand, WritesEveryFormThatNeedsNoImages) {
  std::vector<std::string> paths;
  for (std::size_t i = 0; i < arguments.paths.size(); ++i) {
    const std::string flag = map_export_forms()[i].flag;
    const std::set<std::string> kOfImages = {"--colmap", "--nerf", "--cloud", "--mesh",
                                             "--undistorted"};
    if (kOfImages.contains(flag)) continue;
    arguments.paths[i] = folder / ("part" + flag + (flag == "--gltf" ? ".glb" : ""));
    paths.push_back(arguments.paths[i]);
  }
  EXPECT_EQ(map_export(arguments).written, paths);
  const auto places = nlohmann::json::parse(test::read_file(path("--places")));
  EXPECT_EQ(places["places"].size(), 4u);
  EXPECT_THAT(test::read_file(path("--dot")), HasSubstr("graph"));
  EXPECT_THAT(test::read_file(path("--graphml")), HasSubstr("<graphml"));
  EXPECT_EQ(read_trajectory(path("--kitti")).size(), stored.map.frames.size());
}

TEST_F(MapExportCommand, AMapOfImagesHasNoPosesToWrite) {
  stored.origin.calibration.reset();
  write_map(folder / "map.db", stored);
  path("--tum") = folder / "t.tum";
  EXPECT_THAT(message_of<NoResult>([&] { map_export(arguments); }),
              HasSubstr(": a map of images without a camera has no poses to write to "));
  EXPECT_FALSE(std::filesystem::exists(folder / "t.tum"));
  path("--tum").clear();
  path("--places") = folder / "p.json";
  EXPECT_EQ(map_export(arguments).written.size(), 1u);
}

TEST_F(MapExportCommand, RefusesWhatItCannotDo) {
  EXPECT_THAT(message_of<ArgumentError>([&] { map_export(arguments); }),
              HasSubstr("map export: nothing to write; see --help for the forms"));
  path("--g2o") = folder.write("g.g2o", "mine");
  EXPECT_THAT(message_of<ArgumentError>([&] { map_export(arguments); }),
              HasSubstr("g.g2o: exists already; --force overwrites it"));
  arguments.force = true;
  arguments.map = folder / "none.db";
  EXPECT_THAT(message_of([&] { map_export(arguments); }), HasSubstr("none.db"));
  EXPECT_EQ(test::read_file(folder / "g.g2o"), "mine");
}

}  // namespace map_export_test
}  // namespace placegraph
