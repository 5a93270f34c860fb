#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/config/yaml_config.h>
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

TEST(RunOptions, ReadEveryRetiredKeyWithOneLineEach) {
  const auto retired = list_retired_options(RunOptions{});
  EXPECT_GE(retired.size(), 100u);
  std::set<std::string> present;
  for (const OptionEntry& entry : list_options(RunOptions{})) present.insert(entry.path);
  for (const OptionEntry& entry : retired) {
    SCOPED_TRACE(entry.path);
    EXPECT_FALSE(present.contains(entry.path));
    // A file of one key: its path as nested maps.
    std::string text = entry.path, braces;
    for (std::size_t dot; (dot = text.find('.')) != std::string::npos; braces += '}')
      text.replace(dot, 1, ": {");
    std::vector<std::string> notes;
    RunOptions options;
    read_options_text("old.yaml", text + ": " + entry.value + braces, options,
                      [&](LogLevel, const std::string& note) { notes.push_back(note); });
    EXPECT_EQ(dump_options(options), dump_options(RunOptions{}));
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_EQ(notes[0], "old.yaml:1: '" + entry.path + "' is a constant now, " + entry.value +
                            "; the value here is not used");
  }
}

TEST(RunOptions, NamesItsSensors) {
  EXPECT_STREQ(to_string(Sensor::kMono), "mono");
  EXPECT_STREQ(to_string(Sensor::kStereo), "stereo");
  EXPECT_STREQ(to_string(Sensor::kRgbd), "rgbd");
}

}  // namespace options_test
}  // namespace placegraph
