#include "apps/map/explain.h"

#include <gtest/gtest.h>

#include "apps/support/output.h"
#include "tests/support/message_of.h"
#include "tests/support/random_map.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace {

using nlohmann::json;
using test::message_of;
using testing::HasSubstr;

TEST(ExplainCommand, RefusesAFrameThatTheMapDoesNotHave) {
  const test::TemporaryFolder folder;
  Random random(3);
  const StoredMap stored = test::random_map(random);
  write_map(folder / "map.db", stored);
  ExplainArguments arguments;
  arguments.map = folder / "map.db";
  arguments.frame = 1'000'000;
  EXPECT_THAT(message_of<NoAnswer>([&] { explain(arguments); }),
              HasSubstr("map.db: has no frame 1000000"));
}

TEST(ExplainText, SaysWhatIsKnownLineByLine) {
  ExplainResult result;
  result.told = {{"frame", 7},
                 {"stamp_s", 1.5},
                 {"where", {{"posed", false}}},
                 {"known_by",
                  {{"inliers", 3},
                   {"features", 20},
                   {"features_placed", 5},
                   {"constraints", {{"odometry", 1}}},
                   {"loops", json::array()}}},
                 {"sees", {{"unknown", "no model"}}},
                 {"assumed",
                  {{"sensor", "one eye"},
                   {"cues", "points"},
                   {"metric", true},
                   {"ground_below_camera_m", 1.65}}},
                 {"refused", json::array()}};
  EXPECT_EQ(to_text(result),
            "frame      7, 1.500 s\n"
            "where      not posed: tracking was lost or waited here\n"
            "known by   3 landmarks; keyframe with 20 features, 5 placed; constraints "
            "{\"odometry\":1}\n"
            "sees       unknown: no model\n"
            "assumed    one eye, cues points, ground 1.65 m below the camera, unit the metre\n"
            "refused    nothing\n");
  EXPECT_EQ(json::parse(to_json(result)), result.told);
}

}  // namespace
}  // namespace placegraph::apps
