#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/cli_test.h"

namespace placegraph {
namespace eval_edges_cli_test {

using test::write_file;
using ::testing::HasSubstr;

/// A run of two places one metre apart, whose edge is 0.1 m too long and claims 0.05 m.
class EvalEdges : public test::CliTest {
 protected:
  void SetUp() override {
    write_file(dir / "poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 1\n");
    std::filesystem::create_directory(dir / "run");
    write_file(dir / "run/graph.g2o",
               "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_SE3:QUAT 1 0 0 1.1 0 0 0 1\nFIX 0\n"
               "EDGE_SE3:QUAT 0 1 0 0 1.1 0 0 0 1 "
               "400 0 0 0 0 0 400 0 0 0 0 400 0 0 0 400 0 0 400 0 400\n");
    write_places(1);
  }
  void write_places(int frame) {
    const std::string pose = R"({"position_m": [0, 0, 0], "quaternion_xyzw": [0, 0, 0, 1]})";
    const auto place = [&](int id, int keyframe, int seen_in) {
      return R"({"id": )" + std::to_string(id) + R"(, "component": 0, "scale": 1, "labels": [])" +
             R"(, "anchor_keyframe": )" + std::to_string(keyframe) + R"(, "T_map_place": )" + pose +
             R"(, "members": [{"scale": 1, "T_place_keyframe": )" + pose + R"(, "keyframe": )" +
             std::to_string(keyframe) + R"(, "frame": )" + std::to_string(seen_in) + "}]}";
    };
    write_file(dir / "run/places.json",
               R"({"edges": [{"from": 0, "to": 1, "source": "odometry"}], "places": [)" +
                   place(0, 0, 0) + ", " + place(1, 4, frame) + "]}");
  }
};

TEST_F(EvalEdges, GivesErrorsInClaimedDeviationsBySource) {
  const auto result = run("eval edges poses.txt run --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json.at("odometry").at("edges"), 1);
  EXPECT_NEAR(json.at("odometry").at("mean_nees").get<double>(), 4.0 / 6, 1e-9);
  EXPECT_EQ(json.at("odometry").at("share_beyond_99"), 0);
  EXPECT_EQ(json.at("odometry").at("verdict"), "too few edges");
  EXPECT_THAT(run("eval edges . run").out, HasSubstr("odometry        1"));
}

TEST_F(EvalEdges, TakesTheNoiseOfTheTruth) {
  const auto result = run("eval edges poses.txt run --truth-noise 0.05,0 --axes --fit-mount");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("translation along z"));
  EXPECT_THAT(result.out, HasSubstr("are not testable: the truth's own noise makes "));
  expect_usage_error("eval edges poses.txt run --truth-noise 5cm",
                     "--truth-noise: '5cm' is none of");
  expect_usage_error("eval edges poses.txt run --truth-noise -1,0", "--truth-noise");
  const auto refused = run("eval edges poses.txt run --truth-noise estimate");
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("the truth has no 20 measured poses in a row"));
}

TEST_F(EvalEdges, NoiseOfATruthThatIsTooShortIsNotEstimated) {
  const auto refused = run("eval noise poses.txt");
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("poses.txt: the truth has no 20 measured poses in a row"));
  expect_usage_error("eval noise none.txt", "none.txt");
  write_file(dir / "poses.txt", "1 0 0 0 0 1 0 0 0 0 1\n");
  expect_usage_error("eval noise poses.txt", "poses.txt:1");
}

TEST_F(EvalEdges, NamesWhatIsWrongWithItsInput) {
  write_places(2);
  expect_usage_error("eval edges poses.txt run", "frame 2, and poses.txt has 2 poses");
  write_file(dir / "run/places.json", "{}");
  expect_usage_error("eval edges poses.txt run",
                     "places.json: was not written by `placegraph run`");
  write_file(dir / "run/places.json", "{");
  expect_usage_error("eval edges poses.txt run", "places.json: is not valid JSON, at byte");
  std::filesystem::remove(dir / "run/places.json");
  expect_usage_error("eval edges poses.txt run", "places.json: cannot be opened");
  std::filesystem::remove(dir / "run/graph.g2o");
  expect_usage_error("eval edges poses.txt run", "graph.g2o");
  expect_usage_error("eval edges poses.txt none", "none");
}

}  // namespace eval_edges_cli_test
}  // namespace placegraph
