#include <placegraph/pipeline/report/street_map_part.h>

#include <gtest/gtest.h>
#include <placegraph/graph/image/png_codec.h>
#include <placegraph/io/scene/street_map_file.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include <placegraph/pipeline/report/tables/column.h>
#include "tests/support/temporary_folder.h"

namespace placegraph::report {
namespace street_map_part_test {

using nlohmann::json;

/// A road of 20 x 1 cells of half a metre, 1.5 m below the origin, with a building at its end.
StreetMap street() {
  StreetMap map;
  map.outcome = Outcome::ok();
  map.classes = {"Road", "Building"};
  map.cell_m = 0.5;
  for (int x = 0; x < 20; ++x) {
    StreetCell cell;
    const bool building = x == 19;
    cell.height_m = building ? 2 : 0;
    cell.mean = {0.5f * static_cast<float>(x) + 0.25f, 1.5f - cell.height_m, 0.25f};
    cell.at = (cell.mean / 0.5f).array().floor().cast<int>();
    cell.weight = 10;
    cell.observations = 3;
    cell.label = building ? 1 : 0;
    cell.confidence = 0.9f;
    map.cells.push_back(cell);
  }
  return map;
}

TEST(ReportStreetMap, IsAnImageOnTheGround) {
  const json described = describe_street_map(street());
  EXPECT_EQ(described["width"], 2 * kStreetTile);
  EXPECT_EQ(described["height"], kStreetTile);
  EXPECT_EQ(described["columns"], 2);
  EXPECT_EQ(described["rows"], 1);
  EXPECT_EQ(described["low_m"], (std::array<double, 2>{0, 0}));
  // The ground is where the road is, below the building too.
  std::vector<float> ground;
  for (const float z : {0.0f, 8.0f})
    for (const float x : {0.0f, 8.0f, 16.0f}) ground.insert(ground.end(), {x, 1.5f, z});
  EXPECT_EQ(described["ground"], column(ground, 3));
  ASSERT_EQ(described["classes"].size(), 2u);
  EXPECT_EQ(described["classes"][0]["name"], "Road");
  EXPECT_NEAR(described["classes"][0]["area_m2"].get<double>(), 19 * 0.25, 1e-9);
  EXPECT_EQ(described["image"].get<std::string>().rfind("data:image/png;base64,", 0), 0u);
}

TEST(ReportStreetMap, IsNothingWhereNothingIsKnown) {
  StreetMap empty = street();
  empty.cells.clear();
  EXPECT_EQ(describe_street_map(empty), nullptr);
}

TEST(ReportStreetMap, IsNotReadInTheAxesOfTheEarth) {
  const test::TemporaryFolder folder;
  EXPECT_FALSE(street_map_in(folder / ""));
  std::ofstream(folder / "semantic_map.ply", std::ios::binary) << to_ply(street());
  EXPECT_TRUE(street_map_in(folder / ""));
  std::ofstream(folder / "semantic_map.geojson") << "{}";
  EXPECT_FALSE(street_map_in(folder / ""));
}

}  // namespace street_map_part_test
}  // namespace placegraph::report
