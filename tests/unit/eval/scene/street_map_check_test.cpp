#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/plots/street_map_plot.h>
#include <placegraph/eval/scene/street_map_check.h>

#include "../drawing/svg_check.h"

namespace placegraph {
namespace street_map_check_test {

/// A road at y = 1.6 from (0, 0) to (6, 6), a wall at x = 3.1 up to y = -2.
LabelledMesh street() {
  LabelledMesh mesh;
  mesh.classes = {"sky", "Road", "Building"};
  mesh.vertices = {{0, 1.6, 0},   {6, 1.6, 0},   {6, 1.6, 6},  {0, 1.6, 6},
                   {3.1, 1.6, 0}, {3.1, 1.6, 6}, {3.1, -2, 6}, {3.1, -2, 0}};
  mesh.faces = {{{0, 1, 2, 3}, 1}, {{4, 5, 6, 7}, 2}};
  return mesh;
}

StreetMap map_of(const std::vector<std::pair<Eigen::Vector3i, int>>& cells) {
  StreetMap map;
  map.outcome = Outcome::ok();
  map.classes = {"Road", "Building", "Tree"};
  map.cell_m = 0.5;
  for (const auto& [at, label] : cells) {
    StreetCell cell;
    cell.at = at;
    if (label >= 0) cell.label = label;
    cell.weight = 5;
    cell.mean = 0.5F * (at.cast<float>() + Eigen::Vector3f::Constant(0.5F));
    cell.height_m = 1.6F - cell.mean[1];
    map.cells.push_back(cell);
  }
  return map;
}

TEST(StreetMapCheck, CountsCellsOfTheClassThatStandsThere) {
  const StreetMap map = map_of({{{2, 3, 2}, 0},     // road
                                {{6, 0, 2}, 1},     // wall
                                {{6, 0, 4}, 2},     // wall, called tree
                                {{2, 3, 4}, 1},     // road, called building
                                {{2, -3, 2}, 2},    // in the air
                                {{6, 3, 6}, 0},     // both stand here: either is right
                                {{2, 3, 8}, -1}});  // unknown: not judged
  const StreetMapCheck check = check_street_map(map, street(), SE3(), 0.5);
  EXPECT_EQ(check.all.cells, 6);
  EXPECT_EQ(check.all.right, 3);
  EXPECT_EQ(check.all.nothing, 1);
  EXPECT_EQ(check.unjudged, 0);
  EXPECT_EQ(check.confusion[1 * 3 + 2], 1);  // building called tree
  EXPECT_EQ(check.confusion[0 * 3 + 1], 1);  // road called building
}

TEST(StreetMapCheck, TakesTheNearestSurfaceWithinTheTolerance) {
  const StreetMap map = map_of({{{4, 0, 2}, 1}});  // from x = 2 to 2.5, the wall stands at 3.1
  EXPECT_EQ(check_street_map(map, street(), SE3(), 0.5).all.right, 1);
  EXPECT_EQ(check_street_map(map, street(), SE3(), 0.4).all.nothing, 1);
}

TEST(StreetMapCheck, SeesAMapThatIsMoved) {
  const StreetMap map = map_of({{{6, 0, 2}, 1}});
  const SE3 T_truth_map(SO3(), Eigen::Vector3d(2, 0, 0));
  EXPECT_EQ(check_street_map(map, street(), T_truth_map, 0.5).all.nothing, 1);
  const StreetMap moved = map_of({{{2, 0, 2}, 1}});
  EXPECT_EQ(check_street_map(moved, street(), T_truth_map, 0.5).all.right, 1);
}

TEST(StreetMapCheck, DoesNotJudgeWhereTheMapHasNoClass) {
  LabelledMesh mesh = street();
  mesh.classes[1] = "terrain";
  const StreetMapCheck check =
      check_street_map(map_of({{{2, 3, 2}, 0}, {{6, 0, 2}, 1}}), mesh, SE3(), 0.5);
  EXPECT_EQ(check.unjudged, 1);
  EXPECT_EQ(check.all.cells, 1);
  EXPECT_EQ(check.all.right, 1);
}

TEST(StreetMapPlot, DrawsCellsInTheirColours) {
  StreetMapPicture picture;
  picture.path = {Eigen::Vector2d(1, 1), std::nullopt, Eigen::Vector2d(2, 2)};
  const std::string svg =
      street_map_svg(map_of({{{2, 3, 2}, 0}, {{3, 3, 2}, 0}, {{2, 3, 3}, 2}}), picture);
  test::expect_good_svg(svg);
  for (const char* text : {"Road", "path of the camera", "x [m]", "z [m]"})
    EXPECT_THAT(test::texts_of(svg), testing::Contains(text));
  const auto colour = class_colour("Road", 0);
  const std::string fill =
      fmt::format("fill=\"#{:02x}{:02x}{:02x}\"", colour[0], colour[1], colour[2]);
  EXPECT_NE(svg.find("<path " + fill), std::string::npos);
  test::expect_good_svg(street_map_svg(map_of({}), {}));
}

}  // namespace street_map_check_test
}  // namespace placegraph
