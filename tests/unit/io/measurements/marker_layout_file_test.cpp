#include <placegraph/io/measurements/marker_layout_file.h>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace marker_layout_file_test {

using test::message_of;
using test::TemporaryFolder;
using testing::HasSubstr;

const std::string kHead = "dictionary: apriltag_36h11\n";

std::string refused(const std::string& text) {
  const TemporaryFolder folder;
  const std::string path = folder.write("markers.yaml", text);
  return message_of([&] { (void)read_marker_layout(path); });
}

TEST(MarkerLayoutFile, ReadsMarkersAndBeacons) {
  const TemporaryFolder folder;
  const MarkerLayout layout = read_marker_layout(folder.write(
      "markers.yaml", kHead + "markers:\n  - {id: 7, side_m: 0.2, position: [1, 2, 0], "
                              "quaternion: [0, 0, 0, 1]}\nbeacons:\n  - [3, 4, 0.5]\n"));
  EXPECT_EQ(layout.dictionary, "apriltag_36h11");
  ASSERT_EQ(layout.markers.size(), 1u);
  EXPECT_EQ(layout.markers[0].id, 7);
  EXPECT_EQ(layout.markers[0].side_m, 0.2);
  // Turned half around z: the marker's x is the world's -x.
  EXPECT_LT(
      (layout.markers[0].T_world_marker * Eigen::Vector3d(0.5, 0, 0) - Eigen::Vector3d(0.5, 2, 0))
          .norm(),
      1e-12);
  ASSERT_EQ(layout.beacons_world.size(), 1u);
  EXPECT_EQ(layout.beacons_world[0], Eigen::Vector3d(3, 4, 0.5));
}

TEST(MarkerLayoutFile, ReadsWhatItWrote) {
  const TemporaryFolder folder;
  MarkerLayout layout;
  layout.markers = {{3, 0.16, SE3(SO3::exp({0.1, 0.2, -2}), Eigen::Vector3d(1, -2, 3))},
                    {5, 0.2, SE3()}};
  layout.beacons_world = {{0.1, 0.2, 0.3}};
  layout.unplaced_sides_m = {{8, 0.17}};
  for (const bool bare : {false, true}) {
    if (bare) layout.beacons_world.clear();
    write_marker_layout(folder / "markers.yaml", layout);
    const MarkerLayout again = read_marker_layout(folder / "markers.yaml");
    ASSERT_EQ(again.markers.size(), 2u);
    EXPECT_EQ(again.markers[1].id, 5);
    EXPECT_LT(
        (again.markers[0].T_world_marker.inverse() * layout.markers[0].T_world_marker).log().norm(),
        1e-8);
    EXPECT_EQ(again.beacons_world, layout.beacons_world);
    EXPECT_EQ(again.unplaced_sides_m, layout.unplaced_sides_m);
  }
}

TEST(MarkerLayoutFile, NamesFileAndLineOfWhatIsWrong) {
  const std::string pose = "position: [1, 2, 0], quaternion: [1, 0, 0, 0]";
  const auto marker = [&](const std::string& rest) {
    return refused(kHead + "markers:\n  - {" + rest + "}\n");
  };
  EXPECT_THAT(refused(kHead + "marker: []\n"), HasSubstr("markers.yaml:2: 'marker': unknown"));
  EXPECT_THAT(marker("id: 1, side_m: 0.2, size: 3, " + pose), HasSubstr("unknown key"));
  EXPECT_THAT(marker("id: 1, " + pose), HasSubstr("side_m: is missing"));
  EXPECT_THAT(marker("id: 1.5, side_m: 0.2, " + pose), HasSubstr("markers.yaml:3: id"));
  EXPECT_THAT(marker("id: 1, side_m: 0, " + pose), HasSubstr("side_m: 0 is not a valid"));
  EXPECT_THAT(marker("id: 1, side_m: 0.1, position: [1, nan, 0], quaternion: [1, 0, 0, 0]"),
              HasSubstr("a position is three numbers"));
  EXPECT_THAT(marker("id: 1, side_m: 0.1, position: [1, 0, 0], quaternion: [1, 1, 0, 0]"),
              HasSubstr("quaternion: has length 1.4142"));
  EXPECT_THAT(marker("id: 1, side_m: 0.1, position: [1, 0, 0]"),
              HasSubstr("quaternion: is missing"));
  EXPECT_THAT(marker("id: 1, side_m: 0.1, quaternion: [1, 0, 0, 0]"),
              HasSubstr("position: is missing"));
  EXPECT_THAT(marker("id: 1, side_m: 1}\n  - {id: 1, side_m: 1, " + pose),
              HasSubstr("markers.yaml:4: id: 1 comes twice"));
  EXPECT_THAT(marker("id: 1, side_m: 1, " + pose + "}\n  - {id: 1, side_m: 1, " + pose),
              HasSubstr("markers.yaml:4: id: 1 comes twice"));
  EXPECT_THAT(refused(kHead + "markers: 3\n"), HasSubstr("markers: is not a list"));
  EXPECT_THAT(refused(kHead + "beacons:\n  - [1, 2]\n"), HasSubstr("markers.yaml:3: a position"));
  EXPECT_THAT(refused(kHead + "markers: []\n"), HasSubstr("neither markers nor beacons"));
  EXPECT_THAT(refused("markers: []\n"), HasSubstr("dictionary: is missing"));
  EXPECT_THAT(refused(""), HasSubstr("expected dictionary"));
}

}  // namespace marker_layout_file_test
}  // namespace placegraph
