#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/io/graphs/place_graph_export.h>

namespace placegraph {
namespace place_graph_export_test {

using testing::HasSubstr;
using testing::Not;

PlaceGraph three_places() {
  PlaceGraph graph;
  for (int i = 0; i < 3; ++i) {
    Place place;
    place.id = PlaceId(i);
    place.T_map_place = SE3(SO3(), {1.0 * i, 0, 2.0 * i});
    place.members.resize(static_cast<std::size_t>(i) + 1);
    graph.places.push_back(place);
  }
  graph.places[1].labels = {"a \"hall\" <wide>", "west & east"};
  RelativePoseConstraint loop;
  loop.from = NodeId(2);
  loop.to = NodeId(0);
  loop.source = ConstraintSource::kLoop;
  graph.constraints = {loop, loop};
  return graph;
}

const std::vector<PlaceTransition> kTransitions{
    {PlaceId(0), PlaceId(1), 3}, {PlaceId(1), PlaceId(0), 1}, {PlaceId(1), PlaceId(2), 1}};

TEST(PlaceGraphExport, WritesGraphmlWithEveryPlaceTransitionAndLoopOnce) {
  const std::string text = to_graphml(three_places(), kTransitions);
  EXPECT_THAT(text, HasSubstr("<key id=\"views\" for=\"node\" attr.name=\"views\""));
  EXPECT_THAT(text, HasSubstr("<node id=\"2\"><data key=\"x\">2</data>"));
  EXPECT_THAT(text, HasSubstr("a &quot;hall&quot; &lt;wide&gt;,west &amp; east"));
  EXPECT_THAT(text, HasSubstr("<edge source=\"0\" target=\"1\" directed=\"true\"><data "
                              "key=\"kind\">transition</data><data key=\"count\">3</data>"));
  const std::string loop = "<edge source=\"0\" target=\"2\" directed=\"false\">";
  EXPECT_NE(text.find(loop), std::string::npos);
  EXPECT_EQ(text.find(loop), text.rfind(loop));
}

TEST(PlaceGraphExport, WritesDotWithBothWaysAsOneEdge) {
  const std::string text = to_dot(three_places(), kTransitions);
  EXPECT_THAT(text, HasSubstr("digraph places {"));
  EXPECT_THAT(text, HasSubstr("label=\"1: a \\\"hall\\\" <wide>,west & east\""));
  EXPECT_THAT(text, HasSubstr(" 0 -> 1 [dir=both label=\"3, 1\"];"));
  EXPECT_THAT(text, Not(HasSubstr(" 1 -> 0 ")));
  EXPECT_THAT(text, HasSubstr(" 1 -> 2 [label=\"1\"];"));
  EXPECT_THAT(text, HasSubstr(" 0 -> 2 [dir=none style=dashed];"));
}

TEST(PlaceGraphExport, WritesAnEmptyGraph) {
  EXPECT_THAT(to_graphml({}, {}), HasSubstr("</graphml>"));
  EXPECT_THAT(to_dot({}, {}), HasSubstr("}"));
}

}  // namespace place_graph_export_test
}  // namespace placegraph
