#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/cli_test.h"

namespace placegraph {
namespace route_cli_test {

using test::read_file;
using test::write_file;
using ::testing::HasSubstr;

/// A run over four places along x; the last was recognized beside the second.
class RouteCli : public test::CliTest {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(dir / "run");
    const double x[] = {0, 2, 4, 2}, z[] = {0, 0, 0, 1};
    nlohmann::json places = nlohmann::json::array();
    std::string g2o;
    for (int i = 0; i < 4; ++i) {
      const nlohmann::json identity = {{"position_m", {0, 0, 0}},
                                       {"quaternion_xyzw", {0, 0, 0, 1}}};
      nlohmann::json pose = identity;
      pose["position_m"] = {x[i], 0, z[i]};
      places.push_back({{"id", i},
                        {"anchor_keyframe", 3 * i},
                        {"component", 0},
                        {"scale", 1},
                        {"labels", nlohmann::json::array()},
                        {"T_map_place", pose},
                        {"members",
                         {{{"keyframe", 3 * i},
                           {"frame", 10 * i},
                           {"scale", 1},
                           {"T_place_keyframe", identity}}}}});
      g2o += "VERTEX_SE3:QUAT " + std::to_string(i) + " " + std::to_string(x[i]) + " 0 " +
             std::to_string(z[i]) + " 0 0 0 1\n";
    }
    nlohmann::json edges = nlohmann::json::array();
    for (const auto& [from, to] :
         {std::pair(0, 1), std::pair(1, 2), std::pair(2, 3), std::pair(3, 1)}) {
      edges.push_back({{"from", from}, {"to", to}, {"source", from == 3 ? "loop" : "odometry"}});
      g2o += "EDGE_SE3:QUAT " + std::to_string(from) + " " + std::to_string(to) +
             " 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n";
    }
    write_file(dir / "run/graph.g2o", g2o);
    write_file(
        dir / "run/places.json",
        nlohmann::json{{"places", places}, {"edges", edges}, {"loops", nlohmann::json::array()}}
            .dump(1));
  }
};

TEST_F(RouteCli, GivesTheShortestWayItsViewsAndTheWayBack) {
  auto result = run("map route run --from 0 --to 3 --out way.json --plot way.png");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("3 places, 3.00 m"));
  auto path = nlohmann::json::parse(read_file(dir / "way.json"));
  EXPECT_EQ(path.at("steps").size(), 3u);
  EXPECT_EQ(path.at("steps")[1].at("place"), 1);
  EXPECT_EQ(path.at("steps")[1].at("view").at("frame"), 10);
  EXPECT_NEAR(path.at("steps")[0].at("view_off_travel_deg").get<double>(), 90, 1e-9);
  EXPECT_NEAR(path.at("steps")[1].at("view_off_travel_deg").get<double>(), 0, 1e-9);
  EXPECT_TRUE(std::filesystem::exists(dir / "way.png"));
  result = run("map route run --from 0 --to 3 --backtrack --out way.json --force");
  ASSERT_EQ(result.code, 0) << result.err;
  path = nlohmann::json::parse(read_file(dir / "way.json"));
  EXPECT_EQ(path.at("from"), 3);
  EXPECT_EQ(path.at("to"), 0);
  EXPECT_EQ(path.at("steps")[1].at("T_previous_place").at("position_m")[2], -1);
}

TEST_F(RouteCli, NamesWhatIsWrongWithItsInput) {
  expect_usage_error("map route run --from 0 --to 7", "no place 7");
  expect_usage_error("map route run --from 0", "--to");
  expect_usage_error("map route none --from 0 --to 1", "none");
  expect_usage_error("map route run --from 0 --to 1 --plot way.txt", "way.txt");
  write_file(dir / "way.json", "kept");
  expect_usage_error("map route run --from 0 --to 1 --out way.json", "way.json");
  EXPECT_EQ(read_file(dir / "way.json"), "kept");
  write_file(dir / "run/places.json", R"({"places": [], "edges": []})");
  expect_usage_error("map route run --from 0 --to 1", "not those of graph.g2o");
}

}  // namespace route_cli_test
}  // namespace placegraph
