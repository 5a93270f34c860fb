#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/elements.h>
#include <placegraph/pipeline/tracking/cue_list.h>

#include "tests/support/message_of.h"

namespace placegraph {
namespace elements_test {

TEST(Elements, AreNamedJoinedByCommas) {
  const Elements elements = parse_elements("motion, spatial,semantics");
  EXPECT_TRUE(elements.motion && elements.spatial && elements.semantics);
  EXPECT_FALSE(elements.geometry || elements.context);
}

TEST(Elements, RefuseUnknownOnesRepeatsAndListsWithoutMotion) {
  EXPECT_NE(test::message_of<ArgumentError>([] {
              parse_elements("motion,colour");
            }).find("'colour' is none of motion"),
            std::string::npos);
  EXPECT_NE(test::message_of<ArgumentError>([] { parse_elements("motion,motion"); }).find("twice"),
            std::string::npos);
  EXPECT_NE(
      test::message_of<ArgumentError>([] { parse_elements("spatial"); }).find("motion is needed"),
      std::string::npos);
  EXPECT_THROW(parse_elements(""), ArgumentError);
}

TEST(Elements, SwitchOptionsOnAndOff) {
  RunOptions options;
  set_elements(parse_elements("motion"), options);
  EXPECT_FALSE(options.slam.loops.enabled || options.slam.context.enabled ||
               options.slam.semantics.enabled || options.scene.geometry);
  EXPECT_EQ(options.slam.odometry.cues, "points");
  set_elements(parse_elements("motion,spatial,geometry,context,semantics"), options);
  EXPECT_TRUE(options.slam.loops.enabled && options.slam.context.enabled &&
              options.slam.semantics.enabled && options.scene.geometry);
  EXPECT_TRUE(parse_cues(options.slam.odometry.cues).manhattan);
  EXPECT_NO_THROW(options.check());
}

TEST(Elements, NeedAModelOfSurfacesForContextAndSemantics) {
  Calibration calibration;
  calibration.camera.width = 64, calibration.camera.height = 48;
  calibration.camera.fx = calibration.camera.fy = 50;
  calibration.camera.cx = 31.5, calibration.camera.cy = 23.5;
  for (const char* names : {"motion,context", "motion,semantics"}) {
    RunOptions options;
    set_elements(parse_elements(names), options);
    EXPECT_NE(test::message_of<ArgumentError>([&] {
                Slam(options.slam, calibration);
              }).find("SlamInputs::surfaces"),
              std::string::npos);
  }
}

}  // namespace elements_test
}  // namespace placegraph
