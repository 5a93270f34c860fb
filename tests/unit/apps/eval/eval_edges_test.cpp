#include "apps/eval/eval_edges.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/eval/eval_noise.h"
#include "apps/support/output.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace eval_edges_test {

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
  EXPECT_NEAR(found.by_stated.mean, 4.0 / 6, 1e-9);
  write_places(2, "odometry");  // 0.05 m off
  found = eval_edges(arguments).by_source.at(ConstraintSource::kOdometry);
  EXPECT_NEAR(found.by_stated.mean, 1.0 / 6, 1e-9);
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
              HasSubstr("places.json: place 1 was seen in frame 3, and " + arguments.truth +
                        " has 3 poses"));
  write_places(-1, "odometry");
  EXPECT_THAT(message_of([&] { eval_edges(arguments); }),
              HasSubstr("places.json: place 1 was seen in frame -1"));
}

TEST_F(EvalEdgesCommand, NeedsATruthForEachFrameOfTheRun) {
  write_places(1, "odometry");
  folder.write("run/result.json", R"({"frames": 3, "metric": true})");
  EXPECT_EQ(eval_edges(arguments).by_source.size(), 1u);
  folder.write("run/result.json", R"({"frames": 4, "metric": true})");
  EXPECT_THAT(message_of<ArgumentError>([&] { eval_edges(arguments); }),
              HasSubstr("poses.txt has 3 poses, and "));
  folder.write("run/result.json", R"({"frames": "four"})");
  EXPECT_THAT(message_of([&] { eval_edges(arguments); }),
              HasSubstr("result.json: was not written by `placegraph run`"));
}

TEST_F(EvalEdgesCommand, AGraphWithoutEdgesHasNoResult) {
  write_places(1, "odometry");
  folder.write("run/places.json", R"({"places": [], "edges": []})");
  folder.write("run/graph.g2o", "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nFIX 0\n");
  EXPECT_THAT(message_of<NoResult>([&] { eval_edges(arguments); }),
              HasSubstr("places.json: has no edges between places"));
}

TEST_F(EvalEdgesCommand, ErrorsBeyondAllNumbersHaveNoResult) {
  write_places(1, "odometry");
  folder.write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 1e200\n");
  EXPECT_THAT(message_of<NoResult>([&] { eval_edges(arguments); }),
              HasSubstr("poses.txt: the errors of the odometry edges are too large"));
}

TEST_F(EvalEdgesCommand, NamesTheFileThatIsNoRuns) {
  folder.write("run/places.json", "{}");
  EXPECT_THAT(message_of([&] { eval_edges(arguments); }),
              HasSubstr("places.json: was not written by `placegraph run`"));
}

TEST_F(EvalEdgesCommand, AddsWhiteNoiseOfTheTruth) {
  write_places(1, "odometry");
  arguments.truth_noise = "0.05,0";
  const EdgeConsistency found = eval_edges(arguments).by_source.at(ConstraintSource::kOdometry);
  EXPECT_NEAR(found.by_stated.mean, 4.0 / 6, 1e-9);
  EXPECT_NEAR(found.with_truth.mean, 4.0 / 3 / 6, 1e-6);  // 0.05^2 of the edge, twice of the truth
  EXPECT_NEAR(found.truth_share, 1, 1e-9);
}

TEST_F(EvalEdgesCommand, RefusesNoiseThatIsNone) {
  write_places(1, "odometry");
  for (const std::string text : {"", "some", "0.1", "0.1,", ",1", "0.1;1", "0.1,1,2", "-0.1,1",
                                 "0.1,nan", "inf,1", "1e999,1", "1001,1", "1,181"}) {
    arguments.truth_noise = text;
    EXPECT_THAT(message_of<ArgumentError>([&] { eval_edges(arguments); }),
                HasSubstr("--truth-noise: '" + text + "' is none of none, estimate"))
        << text;
  }
}

TEST_F(EvalEdgesCommand, SaysThatATruthIsTooShortForAnEstimate) {
  write_places(1, "odometry");
  arguments.truth_noise = "estimate";
  EXPECT_THAT(message_of<NoResult>([&] { eval_edges(arguments); }),
              HasSubstr("--truth-noise estimate: the truth has no 20 measured poses in a row"));
  EXPECT_THAT(message_of<NoResult>([&] { eval_noise(arguments.truth); }),
              HasSubstr("poses.txt: the truth has no 20"));
}

TEST_F(EvalEdgesCommand, FitsTheMountOnRequest) {
  write_places(1, "odometry");
  EXPECT_FALSE(eval_edges(arguments).mount.has_value());
  arguments.fit_mount = true;
  const EvalEdgesResult result = eval_edges(arguments);
  ASSERT_TRUE(result.mount.has_value());
  EXPECT_LT(result.mount->parameters, 6);
  EXPECT_THAT(to_text(result), HasSubstr("Camera in the frame of the truth: turned by "));
  EXPECT_EQ(json::parse(to_json(result))["mount"]["rotation_deg"].size(), 3u);
}

EdgeConsistency loops() {
  EdgeConsistency result;
  result.edges = 12, result.unknown = 1, result.interpolated = 3;
  result.degrees_of_freedom = 72;
  result.by_stated = {1.25, 0.5, 0.25};
  result.with_truth = {1.0, 0.5, 0.25};
  result.truth_share = 0.2;
  result.axes = {{"rotation about y", 0.004, 0.002, 0.001, 1.5}};
  return result;
}

TEST(EvalEdgesText, HasARowForEverySourceAndEndsWithAVerdict) {
  EvalEdgesResult result;
  result.by_source[ConstraintSource::kLoop] = loops();
  EXPECT_EQ(
      to_text(result),
      "source      edges  unknown  interpolated  mean NEES  median  beyond 99 %  with truth's "
      "noise  truth's share\n"
      "loop           12        1             3      1.250   0.500       25.0 %               "
      "1.000           20 %\n"
      "\n"
      "The covariances of the loops hold: NEES 1.25, with the noise of the truth 1.00 (0.5 to "
      "2).\n");
  result.by_source[ConstraintSource::kOdometry] = {};
  EXPECT_TRUE(to_text(result).ends_with(
      "The covariances of the odometry are not tested: no edge has a truth.\n"));
  EXPECT_THAT(to_text(result, true), HasSubstr("loop        rotation about y      0.004000   "));
}

TEST(EvalEdgesText, HasAllFiguresInJson) {
  EvalEdgesResult result;
  result.by_source[ConstraintSource::kLoop] = loops();
  const json report = json::parse(to_json(result))["loop"];
  EXPECT_EQ(report["share_beyond_99"], 0.25);
  EXPECT_EQ(report["unknown"], 1);
  EXPECT_EQ(report["interpolated"], 3);
  EXPECT_EQ(report["verdict"], "hold");
  EXPECT_EQ(report["with_truth"]["mean_nees"], 1);
  EXPECT_LT(report["with_truth"]["interval_95"][0], 1);
  EXPECT_EQ(report["axes"][0]["name"], "rotation about y");
  EXPECT_EQ(report["axes"][0]["normalized"], 1.5);
}

/// A drive of 120 frames with rounded poses, of which frames 40 to 60 are interpolated.
std::string drive_file() {
  std::string lines;
  unsigned state = 1;
  const auto noise = [&] {
    state = state * 1664525u + 1013904223u;
    return (state >> 8) / 8388608.0 - 1;
  };
  for (int i = 0; i < 120; ++i) {
    const double yaw = i > 40 && i < 60 ? 0 : 1e-3 * noise();
    const double x = i > 40 && i < 60 ? 0 : 2e-3 * noise();
    const double c = std::cos(yaw), s = std::sin(yaw);
    lines += fmt::format("{:.7g} 0 {:.7g} {:.7g} 0 1 0 0 {:.7g} 0 {:.7g} {:.7g}\n", c, s, x, -s, c,
                         0.9 * i);
  }
  return lines;
}

TEST(EvalNoise, ReportsWhatTheTruthSaysOfItself) {
  const test::TemporaryFolder folder;
  folder.write("poses.txt", drive_file());
  const EvalNoiseResult result = eval_noise(folder.path());
  EXPECT_EQ(result.frames, 120);
  const json report = json::parse(to_json(result));
  EXPECT_NEAR(report["position_m"][0], 2e-3 / std::sqrt(3), 4e-4);
  EXPECT_NEAR(report["rotation_deg"][1], 1e-3 / std::sqrt(3) * 57.3, 0.012);
  EXPECT_LT(report["position_m"][1], 1e-5);
  ASSERT_EQ(report["interpolated"].size(), 1u);
  EXPECT_GE(report["interpolated"][0][0], 40);
  EXPECT_LE(report["interpolated"][0][1], 60);
  EXPECT_FALSE(report["direction"].empty());
  const TruthNoise white = truth_noise_of("0.01,0.1", read_true_poses(folder.path()));
  EXPECT_EQ(white.sigma[0], 0.01);
  EXPECT_NEAR(white.sigma[5], 0.1 / 57.29578, 1e-8);
  EXPECT_TRUE(white.is_interpolated(50));
  EXPECT_FALSE(truth_noise_of("none", read_true_poses(folder.path())).is_interpolated(50));
  EXPECT_THAT(to_text(result), HasSubstr("interpolated        frames 4"));
  EXPECT_THAT(to_text(result), HasSubstr("direction of motion lateral "));
}

}  // namespace eval_edges_test
}  // namespace placegraph::apps
