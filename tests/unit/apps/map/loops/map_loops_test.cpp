#include "apps/map/loops/map_loops.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/map/map_database.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/message_of.h"
#include "tests/support/scenes/square_map.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace map_loops_test {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class MapLoops : public ::testing::Test {
 protected:
  MapLoops() {
    write_map(wrong, test::square_map(true));
    write_map(open, test::square_map(false));
  }
  MapLoopsArguments arguments(const std::string& map, LoopEdit edit,
                              const std::vector<std::string>& pairs) const {
    return {map, edit, pairs, dir / "mended.db", false, false};
  }
  std::string refusal(const MapLoopsArguments& arguments) const {
    const std::string message =
        test::message_of<ArgumentError>([&] { (void)map_loops(arguments); });
    EXPECT_FALSE(std::filesystem::exists(arguments.out));
    return message;
  }
  static Eigen::Vector3d position(const Map& map, int keyframe) {
    return map.S_map_keyframe(KeyframeId(keyframe)).translation();
  }
  test::TemporaryFolder dir;
  const std::string wrong = dir / "wrong.db", open = dir / "open.db";
};

TEST_F(MapLoops, RefusingTheOnlyLoopGivesTheMapWithoutIt) {
  const std::string before = test::read_file(wrong);
  const MapLoopsResult result = map_loops(arguments(wrong, LoopEdit::kRefuse, {"40:0"}));
  EXPECT_EQ(test::read_file(wrong), before);
  EXPECT_EQ(result.loops, 0U);
  ASSERT_TRUE(result.motion);
  const Map mended = read_map(result.out).map, without = read_map(open).map,
            given = read_map(wrong).map;
  ASSERT_EQ(mended.loops.size(), 1U);
  EXPECT_EQ(mended.loops[0].stage, LoopStage::kManual);
  // Both are minima of one cost, which is found to its tolerance.
  double moved = 0;
  for (int k = 0; k <= 5; ++k) {
    EXPECT_LT((position(mended, k) - position(without, k)).norm(), 1e-3) << k;
    moved = std::max(moved, (position(mended, k) - position(given, k)).norm());
  }
  EXPECT_GT(moved, 0.2);
  EXPECT_NEAR(result.motion->translation, moved, 1e-6);
}

TEST_F(MapLoops, KeepsThePosesIfItIsTold) {
  MapLoopsArguments keep = arguments(open, LoopEdit::kAdd, {"40:0"});
  keep.keep_poses = true;
  const MapLoopsResult kept = map_loops(keep);
  EXPECT_FALSE(kept.motion);
  EXPECT_EQ(kept.loops, 1U);
  const Map before = read_map(open).map, after = read_map(kept.out).map;
  for (int k = 0; k <= 5; ++k) EXPECT_EQ(position(after, k), position(before, k));
  MapLoopsArguments move = arguments(open, LoopEdit::kAdd, {"40:0"});
  move.force = true;
  EXPECT_GT(map_loops(move).motion->translation, 0.2);
  EXPECT_LT(position(read_map(move.out).map, 4).norm(), 0.1);  // the square closes
}

TEST_F(MapLoops, APairIsTwoFramesOfTheMap) {
  for (const char* pair : {"", "40", "40:", ":0", "40:0:0", "40:-1", "4x:0", "40: 0", "40:0.5"})
    EXPECT_EQ(refusal(arguments(open, LoopEdit::kAdd, {"40:0", pair})),
              "'" + std::string(pair) + "': two frames are needed, as in 612:40 (query:match)");
  EXPECT_EQ(refusal(arguments(open, LoopEdit::kRefuse, {"40:0"})),
            open + ": the map has no accepted loop of frames 40 and 0");
  EXPECT_THAT(refusal(arguments(open, LoopEdit::kAdd, {"40:0", "30:10"})),
              StartsWith(open + ": "));  // nothing is written for the first pair
}

TEST_F(MapLoops, OverwritesOnlyByForce) {
  const std::string out = dir.write("mended.db", "mine");
  MapLoopsArguments refuse = arguments(wrong, LoopEdit::kRefuse, {"40:0"});
  EXPECT_THAT(test::message_of<ArgumentError>([&] { (void)map_loops(refuse); }),
              HasSubstr("mended.db: exists already; --force overwrites it"));
  EXPECT_EQ(test::read_file(out), "mine");
  refuse.force = true;
  EXPECT_EQ(map_loops(refuse).loops, 0U);
  EXPECT_TRUE(read_map(out).finished);
  // What was refused by hand can be accepted again.
  MapLoopsArguments accept = arguments(out, LoopEdit::kAccept, {"40:0"});
  accept.out = dir / "again.db";
  EXPECT_THAT(map_loops(accept).edits.front(), HasSubstr("40 and 0"));
}

TEST_F(MapLoops, TellsWhatItDid) {
  MapLoopsArguments edit = arguments(wrong, LoopEdit::kRefuse, {"40:0"});
  const MapLoopsResult result = map_loops(edit);
  const nlohmann::json json = nlohmann::json::parse(to_json(result));
  EXPECT_EQ(json["map"], edit.out);
  EXPECT_EQ(json["loops_accepted"], 0);
  EXPECT_EQ(json["edits"], nlohmann::json(result.edits));
  EXPECT_EQ(json["optimization"]["translation"], result.motion->translation);
  EXPECT_EQ(json["optimization"]["places"], json["optimization"]["places_before"]);
  const std::string text = to_text(result);
  EXPECT_THAT(text, StartsWith("refused the loop of frames 40 and 0\n"));
  EXPECT_THAT(text, EndsWith("mended.db: 0 accepted loops, 5 places (before: 5), 1 components "
                             "(before: 1)\n"));
  EXPECT_EQ(to_text({"a.db", {"did this"}, 3, std::nullopt}), "did this\na.db: 3 accepted loops\n");
  const nlohmann::json bare = nlohmann::json::parse(to_json({"a.db", {}, 3, std::nullopt}));
  EXPECT_FALSE(bare.contains("optimization"));
}

}  // namespace map_loops_test
}  // namespace placegraph::apps
