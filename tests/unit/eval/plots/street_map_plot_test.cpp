#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/plots/street_map_plot.h>

#include <array>
#include <cmath>
#include <map>

#include "../drawing/svg_check.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace street_map_plot_test {

using testing::Contains;
using testing::Not;

TEST(StreetMapSvg, EveryClassHasTheAreaOfItsCells) {
  Random random = test::seeded_random(18);
  StreetMap map;
  map.classes = {"Road", "Building", "Tree"};
  map.cell_m = 0.5;
  std::map<int, int> count;
  for (int x = 0; x < 30; ++x)
    for (int z = 0; z < 20; ++z) {
      const bool corner = (x == 0 || x == 29) && (z == 0 || z == 19);
      if (!corner && random.index(4) == 0) continue;  // the corners set the size of the view
      StreetCell cell;
      cell.at = {x, 0, z};
      cell.weight = 1;
      if (corner || random.index(5) > 0) ++count[*(cell.label = random.index(2))];
      map.cells.push_back(cell);
    }
  const std::string svg = street_map_svg(map, {"a map", {}});
  test::expect_good_svg(svg);
  const double cell_px = 1300 / (30 * 1.04);  // 15 m x 10 m with margins in 1300 x 1000 px
  for (int label = 0; label < 2; ++label) {
    const auto rgb = class_colour(map.classes[static_cast<std::size_t>(label)], label);
    char colour[8];
    std::snprintf(colour, sizeof(colour), "#%02x%02x%02x", rgb[0], rgb[1], rgb[2]);
    double area_px = 0;
    for (const std::string& tag : test::tags_of(svg, "path")) {
      if (test::attribute(tag, "fill") != colour) continue;
      const std::vector<double> at = test::numbers_in(test::attribute(tag, "d"));
      for (std::size_t i = 0; i + 7 < at.size(); i += 8)  // rectangles, corner by corner
        area_px += std::abs((at[i + 2] - at[i]) * (at[i + 5] - at[i + 3]));
    }
    // A side of 42 px is written to a tenth.
    EXPECT_NEAR(area_px / (cell_px * cell_px), count[label], 5e-3 * count[label]);
  }
}

TEST(StreetMapSvg, NamesTheClassesThatAreThere) {
  StreetMap map;
  map.classes = {"Road", "Building"};
  StreetCell cell;
  cell.weight = 1;
  cell.label = 1;
  map.cells = {cell};
  const auto texts = test::texts_of(street_map_svg(map, {"", {Eigen::Vector2d(1, 2), {}}}));
  EXPECT_THAT(texts, Contains("Building"));
  EXPECT_THAT(texts, Contains("path of the camera"));
  EXPECT_THAT(texts, Not(Contains("Road")));
}

TEST(StreetMapSvg, AnEmptyMapIsAPictureToo) {
  const std::string svg = street_map_svg({}, {"nothing", {}});
  test::expect_good_svg(svg);
  EXPECT_THAT(test::texts_of(svg), Not(Contains("path of the camera")));
}

}  // namespace street_map_plot_test
}  // namespace placegraph
