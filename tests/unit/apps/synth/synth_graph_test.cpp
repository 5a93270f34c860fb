#include "apps/synth/synth_graph.h"

#include <placegraph/io/graphs/pose_graph_file.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include "tests/support/edge_of.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace synth_graph_test {

using test::edge_of;
using test::message_of;
using testing::HasSubstr;

class SynthGraphCommand : public testing::Test {
 protected:
  SynthGraphCommand() {
    arguments.world = "manhattan-walk";
    arguments.poses = 100;
    arguments.out = folder / "a.g2o";
  }
  PoseGraph written() const { return read_pose_graph(arguments.out); }
  /// From here on the graph that was written is made harder.
  void take_what_was_written() {
    arguments.world = arguments.out;
    arguments.poses.reset();
    arguments.out = folder / "b.g2o";
  }
  static std::vector<std::pair<NodeId, NodeId>> edges(const PoseGraph& graph) {
    std::vector<std::pair<NodeId, NodeId>> edges;
    for (std::size_t i = 0; i < graph.constraints.size(); ++i)
      edges.emplace_back(edge_of(graph, i).from, edge_of(graph, i).to);
    return edges;
  }
  test::TemporaryFolder folder;
  SynthGraphArguments arguments;
};

TEST_F(SynthGraphCommand, MakesEveryWorldWithAsManyPosesAsAsked) {
  arguments.force = true;
  for (const auto& [world, kind] :
       {std::pair("manhattan-walk", PoseKind::kSE2), std::pair("grid-world", PoseKind::kSE3),
        std::pair("long-loop", PoseKind::kSE2)}) {
    SCOPED_TRACE(world);
    arguments.world = world;
    if (arguments.world == "long-loop") arguments.closures = 5;  // a tenth of it is driven again
    const SynthGraphResult result = synth_graph(arguments);
    EXPECT_EQ(result.poses, 100u);
    EXPECT_GT(result.constraints, 99u);
    EXPECT_EQ(written().kind(), kind);
    EXPECT_EQ(written().nodes.size(), 100u);
    EXPECT_EQ(written().constraints.size(), result.constraints);
  }
}

TEST_F(SynthGraphCommand, HandsTheOptionsOfALoopOn) {
  arguments.world = "long-loop";
  arguments.spatial = true;
  arguments.laps = 1.5;
  arguments.closures = 25;  // a third of it is driven again
  EXPECT_EQ(synth_graph(arguments).constraints, 99u + 25u);
  EXPECT_EQ(written().kind(), PoseKind::kSE3);
}

TEST_F(SynthGraphCommand, MakesTheSameGraphOfTheSameSeedAlone) {
  synth_graph(arguments);
  const std::string first = test::read_file(arguments.out);
  arguments.force = true;
  synth_graph(arguments);
  EXPECT_EQ(test::read_file(arguments.out), first);
  arguments.seed = 2;
  synth_graph(arguments);
  EXPECT_NE(test::read_file(arguments.out), first);
}

TEST_F(SynthGraphCommand, AddsFalseLoopsBehindTheOthersAndShuffles) {
  synth_graph(arguments);
  const auto before = edges(written());
  take_what_was_written();
  arguments.false_loops = 5;
  EXPECT_EQ(synth_graph(arguments).constraints, before.size() + 5);
  auto with = edges(written());
  EXPECT_TRUE(std::equal(before.begin(), before.end(), with.begin()));
  arguments.world = arguments.out;
  arguments.out = folder / "c.g2o";
  arguments.false_loops = 0;
  arguments.shuffle = true;
  synth_graph(arguments);
  auto shuffled = edges(written());
  EXPECT_NE(shuffled, with);
  std::sort(with.begin(), with.end());
  std::sort(shuffled.begin(), shuffled.end());
  EXPECT_EQ(shuffled, with);
}

TEST_F(SynthGraphCommand, DisturbsTheRotationsOfAFile) {
  arguments.loop_share = 0;
  synth_graph(arguments);
  const PoseGraph before = written();
  take_what_was_written();
  arguments.loop_share.reset();
  arguments.rotation_noise_rad = 0.1;
  synth_graph(arguments);
  const PoseGraph after = written();
  ASSERT_EQ(after.constraints.size(), 99u);
  double squares = 0;
  for (std::size_t i = 0; i < 99; ++i) {
    const SE2 a = std::get<SE2>(edge_of(before, i).T_from_to);
    const SE2 b = std::get<SE2>(edge_of(after, i).T_from_to);
    squares += std::pow((a.inverse() * b).log()[2], 2);
  }
  // The deviation of 99 normal values is known to 7 %: four times that.
  EXPECT_NEAR(std::sqrt(squares / 99), 0.1, 0.028);
}

TEST_F(SynthGraphCommand, NamesWhatDoesNotBelongTogetherAndWritesNothing) {
  const auto refusal = [&] { return message_of<ArgumentError>([&] { synth_graph(arguments); }); };
  arguments.laps = 2;
  EXPECT_EQ(refusal(), "--laps is no option of manhattan-walk");
  arguments.laps.reset();
  arguments.world = "castle";
  EXPECT_EQ(refusal(),
            "castle: neither manhattan-walk, grid-world nor long-loop, nor an existing file");
  arguments.world = folder.write("in.g2o", "VERTEX_SE2 0 0 0 0\n");
  EXPECT_EQ(refusal(), "--poses and --translation-noise are no options of a file");
  arguments.poses.reset();
  EXPECT_THAT(refusal(), HasSubstr("in.g2o: a graph file needs one of "));
  arguments.shuffle = true;
  arguments.world = folder.write("broken.g2o", "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 0 x 0\n");
  EXPECT_THAT(message_of([&] { synth_graph(arguments); }), HasSubstr("broken.g2o:2: "));
  EXPECT_FALSE(std::filesystem::exists(arguments.out));
  arguments.out = arguments.world;
  EXPECT_THAT(refusal(), HasSubstr("broken.g2o: exists already; --force overwrites it"));
}

TEST(SynthGraphText, SaysWhatWasWritten) {
  EXPECT_EQ(to_text({.world = "grid-world", .out = "a.g2o", .poses = 20, .constraints = 27}),
            "grid-world: 20 poses, 27 constraints, written to a.g2o\n");
}

}  // namespace synth_graph_test
}  // namespace placegraph::apps
