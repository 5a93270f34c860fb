#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/odometry/odometry.h>
#include <placegraph/pipeline/tracking/cue_list.h>

namespace placegraph {
namespace cue_list_test {

TEST(Cues, AreThoseNamed) {
  const Cues lines = parse_cues("lines");
  EXPECT_TRUE(lines.lines);
  EXPECT_FALSE(lines.points || lines.plane);
  const Cues all = parse_cues("plane,lines,points");
  EXPECT_TRUE(all.lines && all.points && all.plane);
  EXPECT_TRUE(parse_cues("lines, manhattan").manhattan);
  EXPECT_FALSE(all.without_features());
  EXPECT_TRUE(parse_cues("plane").without_features());
  EXPECT_TRUE(parse_cues("direct").direct);
}

TEST(Cues, UnknownRepeatedOrUselessOnesAreRefusedByName) {
  for (const char* names :
       {"", "points,wheels", "points,points", "points,,lines", "points,", "manhattan"})
    EXPECT_THROW((void)parse_cues(names), ArgumentError) << names;
  try {
    (void)parse_cues("points,wheels");
  } catch (const ArgumentError& error) {
    EXPECT_NE(std::string(error.what()).find("wheels"), std::string::npos);
  }
  OdometryOptions options;
  options.cues = "pionts";
  EXPECT_THROW(options.check(), ArgumentError);
}

}  // namespace cue_list_test
}  // namespace placegraph
