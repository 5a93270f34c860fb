#include "apps/map/queries/route.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/support/output.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace route_test {

using nlohmann::json;
using test::message_of;
using testing::HasSubstr;

/// A run of four places along z at 0, 1 and 3 m, joined in this order, and a fourth that nothing
/// joins; each was seen in the frame of ten times its number.
class RouteCommand : public testing::Test {
 protected:
  RouteCommand() {
    const double along_m[] = {0, 1, 3, 9};
    std::string graph;
    json document = {{"edges", json::array()}, {"places", json::array()}};
    for (int id = 0; id < 4; ++id) {
      const json pose = {{"position_m", {0, 0, along_m[id]}}, {"quaternion_xyzw", {0, 0, 0, 1}}};
      const json here = {{"position_m", {0, 0, 0}}, {"quaternion_xyzw", {0, 0, 0, 1}}};
      graph += "VERTEX_SE3:QUAT " + std::to_string(id) + " 0 0 " + std::to_string(along_m[id]) +
               " 0 0 0 1\n";
      document["places"].push_back(
          {{"id", id},
           {"component", id == 3 ? 1 : 0},
           {"scale", 1},
           {"labels", json::array()},
           {"anchor_keyframe", id},
           {"T_map_place", pose},
           {"members",
            {{{"scale", 1}, {"T_place_keyframe", here}, {"keyframe", id}, {"frame", 10 * id}}}}});
    }
    for (int from = 0; from < 2; ++from) {
      graph += "EDGE_SE3:QUAT " + std::to_string(from) + " " + std::to_string(from + 1) + " 0 0 " +
               std::to_string(along_m[from + 1] - along_m[from]) +
               " 0 0 0 1 400 0 0 0 0 0 400 0 0 0 0 400 0 0 0 400 0 0 400 0 400\n";
      document["edges"].push_back({{"from", from}, {"to", from + 1}, {"source", "odometry"}});
    }
    folder.write("run/graph.g2o", graph);
    folder.write("run/places.json", document.dump());
    arguments.map = folder / "run";
    arguments.out = folder / "way.json";
    arguments.from = PlaceId(0);
    arguments.to = PlaceId(2);
  }
  test::TemporaryFolder folder;
  RouteArguments arguments;
};

TEST_F(RouteCommand, LeadsOverThePlacesBetween) {
  const RouteResult result = route(arguments);
  ASSERT_EQ(result.route.steps.size(), 3u);
  EXPECT_EQ(result.route.steps[1].place, PlaceId(1));
  EXPECT_NEAR(result.route.length_m(), 3, 1e-9);
  EXPECT_EQ(to_text(result),
            "3 places, 3.00 m\n"
            " place  frame    leg [m]  travelled [m]\n"
            "     0      0      0.000          0.000\n"
            "     1     10      1.000          1.000\n"
            "     2     20      2.000          3.000\n");
}

TEST_F(RouteCommand, CountsInUnitsWhereTheScaleIsUnknown) {
  arguments.plot = folder / "way.svg";
  EXPECT_EQ(json::parse(to_json(route(arguments)))["unit"], "m");
  EXPECT_THAT(test::read_file(arguments.plot),
              testing::AllOf(HasSubstr(": 3.0 m<"), HasSubstr(">z [m]<")));
  folder.write("run/result.json", R"({"metric": false})");
  arguments.force = true;
  const RouteResult result = route(arguments);
  EXPECT_EQ(to_text(result),
            "3 places, 3.00 units (scale unknown)\n"
            " place  frame leg [units] travelled [units]\n"
            "     0      0       0.000             0.000\n"
            "     1     10       1.000             1.000\n"
            "     2     20       2.000             3.000\n");
  EXPECT_EQ(json::parse(to_json(result))["unit"], "arbitrary");
  EXPECT_THAT(test::read_file(arguments.plot),
              testing::AllOf(HasSubstr(": 3.0 units<"), HasSubstr(">z [units]<")));
}

TEST_F(RouteCommand, WritesTheNumbersOfThePlacesIntoThePlot) {
  arguments.plot = folder / "way.svg";
  route(arguments);
  for (const char* number : {">0<", ">1<", ">2<", ">3<"})
    EXPECT_THAT(test::read_file(arguments.plot), HasSubstr(number));
}

TEST_F(RouteCommand, WritesTheViewToExpectAtEveryPlace) {
  route(arguments);
  const json path = json::parse(test::read_file(arguments.out));
  EXPECT_EQ(path["from"], 0);
  EXPECT_EQ(path["to"], 2);
  EXPECT_NEAR(path["length_m"].get<double>(), 3, 1e-9);
  EXPECT_EQ(path["steps"][2]["view"]["frame"], 20);
  // The way goes on where the view looks; at the last place it does not go on.
  EXPECT_NEAR(path["steps"][1]["view_off_travel_deg"].get<double>(), 0, 1e-6);
  EXPECT_FALSE(path["steps"][2].contains("view_off_travel_deg"));
}

TEST_F(RouteCommand, LeadsBackIfAsked) {
  arguments.backtrack = true;
  const RouteResult result = route(arguments);
  EXPECT_EQ(result.route.steps.front().place, PlaceId(2));
  EXPECT_EQ(result.route.steps.back().place, PlaceId(0));
  const json path = json::parse(to_json(result));
  EXPECT_NEAR(path["steps"][0]["view_off_travel_deg"].get<double>(), 180, 1e-6);
}

TEST_F(RouteCommand, WritesNothingWhereThereIsNoWay) {
  arguments.to = PlaceId(3);
  EXPECT_THROW(route(arguments), NoResult);
  EXPECT_FALSE(std::filesystem::exists(arguments.out));
}

TEST_F(RouteCommand, KeepsAFileThatIsThereUnlessItIsForced) {
  folder.write("way.json", "mine");
  EXPECT_THAT(message_of<ArgumentError>([&] { route(arguments); }),
              HasSubstr("way.json: exists already; --force overwrites it"));
  EXPECT_EQ(test::read_file(arguments.out), "mine");
}

}  // namespace route_test
}  // namespace placegraph::apps
