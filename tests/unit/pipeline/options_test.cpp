#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/run.h>

#include <set>

namespace placegraph {
namespace options_test {

template <class Options>
class PipelineOptions : public testing::Test {};
using All = testing::Types<GroundPlaneScaleOptions, KeyframeOptions, OdometryOptions, LoopOptions,
                           PlaceOptions, SlamOptions, RunOptions>;
TYPED_TEST_SUITE(PipelineOptions, All);

TYPED_TEST(PipelineOptions, HaveDefaultsInsideTheirRangesAndOnePathEach) {
  const TypeParam defaults;
  EXPECT_NO_THROW(defaults.check());
  std::set<std::string> paths;
  int numbers = 0;
  for (const OptionEntry& entry : list_options(defaults)) {
    EXPECT_TRUE(paths.insert(entry.path).second) << entry.path << " is there twice";
    EXPECT_FALSE(entry.doc.empty()) << entry.path;
    if (entry.type != "int" && entry.type != "double") continue;
    ++numbers;
    const double value = std::stod(entry.value);
    EXPECT_GE(value, entry.range.min) << entry.path;
    EXPECT_LE(value, entry.range.max) << entry.path;
    EXPECT_TRUE(std::isfinite(entry.range.min)) << entry.path << " has no lower end";
    EXPECT_TRUE(std::isfinite(entry.range.max)) << entry.path << " has no upper end";
  }
  EXPECT_GT(numbers, 0);
}

std::string refusal(const RunOptions& options) {
  try {
    options.check();
  } catch (const ArgumentError& error) {
    return error.what();
  }
  return {};
}

TEST(RunOptions, NameTheFieldThatIsWrong) {
  RunOptions options;
  options.threads = 0;
  EXPECT_NE(refusal(options).find("threads"), std::string::npos);
  options = {};
  options.slam.odometry.window.max_keyframes = -1;
  EXPECT_NE(refusal(options).find("odometry.window.max_keyframes"), std::string::npos);
  options = {};
  options.slam.loops.verifier.pose.threshold_px = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal(options).find("loops.verifier.pose.threshold_px"), std::string::npos);
  // Relations between fields of nested groups too.
  options = {};
  options.slam.odometry.points.tracker.window_px = 20;
  EXPECT_NE(refusal(options).find("window_px"), std::string::npos);
  options = {};
  options.slam.odometry.ground.plane.near_heights = 50;
  EXPECT_NE(refusal(options).find("near_heights"), std::string::npos);
}

TEST(RunOptions, NamesItsSensors) {
  EXPECT_STREQ(to_string(Sensor::kMono), "mono");
  EXPECT_STREQ(to_string(Sensor::kStereo), "stereo");
  EXPECT_STREQ(to_string(Sensor::kRgbd), "rgbd");
}

}  // namespace options_test
}  // namespace placegraph
