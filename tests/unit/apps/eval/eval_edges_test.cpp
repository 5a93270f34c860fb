#include "apps/eval/eval_edges.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace {

using nlohmann::json;
using test::message_of;
using testing::HasSubstr;

/// A run of two places, seen in the frames 0 and `frame`, with an edge of 1.1 m that claims 0.05 m.
/// The true camera stands at z = 0, 1 and 1.05 m.
class EvalEdgesCommand : public testing::Test {
 protected:
  EvalEdgesCommand() {
    folder.write("poses.txt",
                 "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 1\n1 0 0 0 0 1 0 0 0 0 1 1.05\n");
    folder.write("run/graph.g2o",
                 "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_SE3:QUAT 1 0 0 1.1 0 0 0 1\nFIX 0\n"
                 "EDGE_SE3:QUAT 0 1 0 0 1.1 0 0 0 1 "
                 "400 0 0 0 0 0 400 0 0 0 0 400 0 0 0 400 0 0 400 0 400\n");
    arguments.truth = folder / "poses.txt";
    arguments.run = folder / "run";
  }
  void write_places(int frame, const std::string& source) {
    const json pose = {{"position_m", {0, 0, 0}}, {"quaternion_xyzw", {0, 0, 0, 1}}};
    json document = {{"edges", {{{"from", 0}, {"to", 1}, {"source", source}}}}};
    for (int id = 0; id < 2; ++id)
      document["places"].push_back({{"id", id},
                                    {"component", 0},
                                    {"scale", 1},
                                    {"labels", json::array()},
                                    {"anchor_keyframe", 4 * id},
                                    {"T_map_place", pose},
                                    {"members",
                                     {{{"scale", 1},
                                       {"T_place_keyframe", pose},
                                       {"keyframe", 4 * id},
                                       {"frame", id * frame}}}}});
    folder.write("run/places.json", document.dump());
  }
  test::TemporaryFolder folder;
  EvalEdgesArguments arguments;
};

TEST_F(EvalEdgesCommand, GivesErrorsInClaimedDeviations) {
  write_places(1, "odometry");  // 0.1 m off
  EdgeConsistency found = eval_edges(arguments).by_source.at(ConstraintSource::kOdometry);
  EXPECT_EQ(found.edges, 1);
  EXPECT_NEAR(found.mean_nees, 4.0 / 6, 1e-9);
  write_places(2, "odometry");  // 0.05 m off
  found = eval_edges(arguments).by_source.at(ConstraintSource::kOdometry);
  EXPECT_NEAR(found.mean_nees, 1.0 / 6, 1e-9);
}

TEST_F(EvalEdgesCommand, TakesThePosesOfASequencesFolder) {
  write_places(1, "loop");
  arguments.truth = folder.path();
  const EvalEdgesResult result = eval_edges(arguments);
  EXPECT_EQ(result.by_source.size(), 1u);
  EXPECT_EQ(result.by_source.at(ConstraintSource::kLoop).edges, 1);
}

TEST_F(EvalEdgesCommand, NamesTheFrameThatTheTruthLacks) {
  write_places(3, "odometry");
  EXPECT_THAT(message_of<ArgumentError>([&] { eval_edges(arguments); }),
              HasSubstr("place 1 was seen in frame 3, and the truth has 3"));
}

TEST_F(EvalEdgesCommand, NamesTheFileThatIsNoRuns) {
  folder.write("run/places.json", "{}");
  EXPECT_THAT(message_of([&] { eval_edges(arguments); }),
              HasSubstr("places.json: was not written by `placegraph run`"));
}

TEST(EvalEdgesText, HasARowForEverySource) {
  EvalEdgesResult result;
  EdgeConsistency& loops = result.by_source[ConstraintSource::kLoop];
  loops.edges = 12, loops.unknown = 1;
  loops.mean_nees = 1.25, loops.median_nees = 0.5, loops.share_beyond_99 = 0.25;
  EXPECT_EQ(to_text(result),
            "source      edges  unknown  mean NEES  median  beyond 99 %\n"
            "loop           12        1      1.250   0.500       25.0 %\n");
  const json report = json::parse(to_json(result));
  EXPECT_EQ(report["loop"]["share_beyond_99"], 0.25);
  EXPECT_EQ(report["loop"]["unknown"], 1);
}

}  // namespace
}  // namespace placegraph::apps
