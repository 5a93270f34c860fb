#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/cli_test.h"

namespace placegraph {
namespace eval_edges_cli_test {

using test::write_file;

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
