#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/scene/labelled_mesh_file.h>
#include <placegraph/io/scene/street_map_file.h>

#include <nlohmann/json.hpp>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace street_map_file_test {

using nlohmann::json;
using testing::HasSubstr;

StreetCell cell_at(int x, int y, int z, int label, float height_m = 0) {
  StreetCell cell;
  cell.at = {x, y, z};
  cell.mean = 0.5F * (cell.at.cast<float>() + Eigen::Vector3f::Constant(0.4F));
  if (label >= 0) cell.label = label;
  cell.confidence = 0.75F;
  cell.height_m = height_m;
  cell.weight = 6;
  cell.observations = 3;
  return cell;
}

/// A road of 4 by 3 cells with one of a tree in its second row, one cell that is unknown.
StreetMap road_with_a_tree(const SO3& R_plan_map = SO3()) {
  StreetMap map;
  map.outcome = Outcome::ok();
  map.classes = {"Road", "Tree"};
  map.R_plan_map = R_plan_map;
  map.cell_m = 0.5;
  for (int x = 0; x < 4; ++x)
    for (int z = 0; z < 3; ++z) map.cells.push_back(cell_at(x, 3, z, x == 1 && z == 1 ? 1 : 0));
  map.cells.push_back(cell_at(9, 3, 0, -1));
  return map;
}

class StreetMapFile : public testing::Test {
 protected:
  std::string refusal_of(const std::string& bytes) {
    const std::string path = folder.write("map.ply", bytes);
    return test::message_of([&] { (void)read_street_map(path); });
  }
  test::TemporaryFolder folder;
};

TEST_F(StreetMapFile, ReadsTheCellsItWrote) {
  const StreetMap map = road_with_a_tree(SO3::exp({0.1, 0.7, -0.2}));
  const StreetMap read = read_street_map(folder.write("map.ply", to_ply(map)));
  ASSERT_EQ(read.cells.size(), 12U);  // without the unknown one
  EXPECT_EQ(read.classes, map.classes);
  EXPECT_EQ(read.cell_m, 0.5);
  for (std::size_t i = 0; i < read.cells.size(); ++i) {
    EXPECT_EQ(read.cells[i].at, map.cells[i].at);
    EXPECT_EQ(read.cells[i].label, map.cells[i].label);
    EXPECT_EQ(read.cells[i].confidence, 0.75F);
    EXPECT_EQ(read.cells[i].observations, 3);
    EXPECT_NEAR((read.cells[i].mean - map.cells[i].mean).norm(), 0, 1e-5);
  }
}

TEST_F(StreetMapFile, RefusesWhatIsCutOffOrAnother) {
  const std::string good = to_ply(road_with_a_tree());
  EXPECT_THAT(refusal_of(good.substr(0, good.size() - 1)), HasSubstr("12 cells"));
  EXPECT_THAT(refusal_of(good + "x"), HasSubstr("12 cells"));
  EXPECT_THAT(refusal_of(good.substr(0, 60)), HasSubstr("no PLY header"));
  EXPECT_THAT(refusal_of(""), HasSubstr("no PLY header"));
  EXPECT_THAT(refusal_of("ply\nformat ascii 1.0\nend_header\n"), HasSubstr("not a street map"));
  std::string wrong = good;
  wrong[wrong.find("end_header\n") + 11 + 15] = 9;  // label of the first cell
  EXPECT_THAT(refusal_of(wrong), HasSubstr("cell 0 has an impossible value"));
  EXPECT_THAT(test::message_of([&] { (void)read_street_map(folder / "none.ply"); }),
              HasSubstr("cannot be read"));
}

TEST_F(StreetMapFile, CountsClassesAndWhatPlacesSee) {
  const json document =
      json::parse(to_json(road_with_a_tree(), {{PlaceId(3), {0.25F, 0.75F}}, {PlaceId(4), {}}}));
  EXPECT_EQ(document["classes"][0]["cells"], 11);
  EXPECT_EQ(document["classes"][1]["area_m2"], 0.25);
  EXPECT_EQ(document["unknown_cells"], 1);
  ASSERT_EQ(document["places"].size(), 1U);
  EXPECT_EQ(document["places"][0]["place"], 3);
  EXPECT_EQ(document["places"][0]["shares"]["Tree"], 0.75);
}

TEST_F(StreetMapFile, OutlinesClassesOnTheEarth) {
  // East, north, up: the plan's x is east, its z north.
  Eigen::Matrix3d R;
  R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  const GeodeticPosition origin{49, 8.4, 115};
  const json document = json::parse(to_geojson(road_with_a_tree(SO3::from_matrix(R)), origin, 0.1));
  ASSERT_EQ(document["features"].size(), 2U);
  const json& road = document["features"][0];
  EXPECT_EQ(road["properties"]["class"], "Road");
  EXPECT_NEAR(road["properties"]["area_m2"].get<double>(), 11 * 0.25, 1e-9);
  const json& polygons = road["geometry"]["coordinates"];
  ASSERT_EQ(polygons.size(), 1U);
  ASSERT_EQ(polygons[0].size(), 2U);  // round it, and the hole of the tree
  EXPECT_EQ(polygons[0][0].size(), 5U);
  EXPECT_EQ(polygons[0][1].size(), 5U);
  EXPECT_EQ(polygons[0][0].front(), polygons[0][0].back());
  // Counter-clockwise from (0, 0): 2 m east, 1.5 m north.
  double east = 0, north = 0;
  for (const json& p : polygons[0][0]) {
    east = std::max(east, (p[0].get<double>() - 8.4) * 111320 * std::cos(deg_to_rad(49)));
    north = std::max(north, (p[1].get<double>() - 49) * 111200);
  }
  EXPECT_NEAR(east, 2, 0.02);
  EXPECT_NEAR(north, 1.5, 0.02);
  double area = 0;
  for (std::size_t i = 0; i + 1 < polygons[0][0].size(); ++i) {
    const json &a = polygons[0][0][i], &b = polygons[0][0][i + 1];
    area += (a[0].get<double>() - 8.4) * (b[1].get<double>() - 49) -
            (b[0].get<double>() - 8.4) * (a[1].get<double>() - 49);
  }
  EXPECT_GT(area, 0);
  EXPECT_TRUE(json::parse(to_geojson(road_with_a_tree(), origin, 100))["features"].empty());
  EXPECT_THROW((void)to_geojson(road_with_a_tree(), {91, 0, 0}), ArgumentError);
}

TEST_F(StreetMapFile, KeepsPatchesApartThatTouchInACorner) {
  StreetMap map = road_with_a_tree();
  map.cells = {cell_at(0, 0, 0, 0), cell_at(1, 0, 1, 0)};
  const json road = json::parse(to_geojson(map, {49, 8.4, 115}, 0.1))["features"][0];
  EXPECT_EQ(road["geometry"]["coordinates"].size(), 2U);
}

class LabelledMeshFile : public StreetMapFile {
 protected:
  std::string refusal_of(const std::string& text) {
    const std::string path = folder.write("scene.ply", text);
    return test::message_of([&] { (void)read_labelled_mesh(path); });
  }
  LabelledMesh quad() const {
    return {{"Road", "Tree"}, {{0, 0, 0}, {1.25, 0, 0}, {1, 0, 2}, {0, 0, 2}}, {{{0, 1, 2, 3}, 1}}};
  }
};

TEST_F(LabelledMeshFile, ReadsTheSceneItWrote) {
  const LabelledMesh read = read_labelled_mesh(folder.write("scene.ply", to_ply(quad())));
  EXPECT_EQ(read.classes, quad().classes);
  ASSERT_EQ(read.vertices.size(), 4U);
  EXPECT_EQ(read.vertices[1], Eigen::Vector3d(1.25, 0, 0));
  ASSERT_EQ(read.faces.size(), 1U);
  EXPECT_EQ(read.faces[0].corners, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(read.faces[0].label, 1);
}

TEST_F(LabelledMeshFile, NamesTheLineItCannotRead) {
  const std::string good = to_ply(quad());
  EXPECT_THAT(refusal_of("solid\n"), HasSubstr("scene.ply:1: a PLY file begins"));
  EXPECT_THAT(refusal_of(good.substr(0, good.rfind("4 0 1"))), HasSubstr("ends before its last"));
  EXPECT_THAT(refusal_of(good.substr(0, 40)), HasSubstr("no end_header"));
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THAT(refusal_of(changed("4 0 1 2 3 1", "4 0 1 2 9 1")), HasSubstr("is not a vertex"));
  EXPECT_THAT(refusal_of(changed("4 0 1 2 3 1", "4 0 1 2 3 2")), HasSubstr("is not a class"));
  EXPECT_THAT(refusal_of(changed("4 0 1 2 3 1", "5 0 1 2 3 1")), HasSubstr("do not fit"));
  EXPECT_THAT(refusal_of(changed("1.250", "inf")), HasSubstr("x"));
}

}  // namespace street_map_file_test
}  // namespace placegraph
