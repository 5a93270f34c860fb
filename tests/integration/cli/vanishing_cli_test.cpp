// `placegraph vanishing`.
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/cli_test.h"
#include "tests/support/scenes/manhattan_scene.h"

namespace placegraph {
namespace vanishing_cli_test {

using nlohmann::json;
using test::CommandResult;
using ::testing::HasSubstr;

class VanishingCli : public test::CliTest {
 protected:
  void SetUp() override {
    dir.write("K.txt", "# fx fy cx cy width height\n520 520 322 237 640 480\n");
  }
  /// With a fifth column that says nothing.
  void write_lines(const std::vector<LineSegment>& segments) {
    std::ostringstream text;
    text.precision(10);
    for (const LineSegment& s : segments)
      text << s.start.transpose() << ' ' << s.end.transpose() << " 7\n";
    dir.write("lines.txt", text.str());
  }
  static Eigen::Matrix3d matrix_of(const json& rows) {
    Eigen::Matrix3d M;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) M(i, j) = rows.at(i).at(j).get<double>();
    return M;
  }
  const Camera camera_ = test::vanishing_camera();
};

TEST_F(VanishingCli, TellsTheWorldAndItsPoints) {
  const SO3 R = SO3::exp({0.1, 0.4, 0.05});
  Random random(1);
  const auto segments = test::manhattan_segments(camera_, R, 40, 30, 0.3, random);
  write_lines(segments);
  const CommandResult result = run("vanishing lines.txt --calib K.txt --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const json report = json::parse(result.out);
  EXPECT_TRUE(report["manhattan_supported"].get<bool>());
  const Eigen::Matrix3d M = matrix_of(report["R_cam_manhattan"]);
  EXPECT_LT((M - R.matrix()).norm(), 0.01);
  EXPECT_GT(matrix_of(report["covariance"]).trace(), 0);
  ASSERT_EQ(report["vanishing_points"].size(), 3u);
  ASSERT_EQ(report["points"].size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const json& v = report["vanishing_points"][i];
    const Eigen::Vector3d direction(v.at(0), v.at(1), v.at(2));
    EXPECT_NEAR(direction.norm(), 1, 1e-9);
    const int axis = report["points"][i]["axis"].get<int>();
    EXPECT_GT(std::abs(direction.dot(R.matrix().col(axis))), 0.9999);
  }
  EXPECT_EQ(report["labels"].size(), segments.size());
  EXPECT_EQ(report["worlds"].size(), 1u);
  EXPECT_EQ(run("vanishing lines.txt --calib K.txt --json --seed 1").out.substr(0, 400),
            result.out.substr(0, 400));
  EXPECT_THAT(run("vanishing lines.txt --calib K.txt").out,
              HasSubstr("3 vanishing points, 1 Manhattan frames"));
}

TEST_F(VanishingCli, SaysNullWhereNoWorldIsSupported) {
  Random random(2);
  std::vector<LineSegment> segments;
  test::add_clutter(camera_, 100, random, segments);
  write_lines(segments);
  const CommandResult result = run("vanishing lines.txt --calib K.txt --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const json report = json::parse(result.out);
  EXPECT_FALSE(report["manhattan_supported"].get<bool>());
  EXPECT_TRUE(report["R_cam_manhattan"].is_null());
  EXPECT_TRUE(report["covariance"].is_null());
  EXPECT_TRUE(report["vanishing_points"].empty());
  EXPECT_THAT(run("vanishing lines.txt --calib K.txt").out, HasSubstr("no Manhattan frame"));
}

TEST_F(VanishingCli, TooFewSegmentsAllowNoAnswer) {
  dir.write("lines.txt", "");
  expect_failure("vanishing lines.txt --calib K.txt", 1, "lines.txt: 0 segments, 4 needed");
  dir.write("lines.txt", "10 10 60 12\n");
  expect_failure("vanishing lines.txt --calib K.txt --json", 1, "lines.txt: 1 segments, 4 needed");
}

TEST_F(VanishingCli, SaysWhatIsWrong) {
  dir.write("lines.txt", "10 10 60 12\n");
  expect_usage_error("vanishing", "LINES");
  expect_usage_error("vanishing lines.txt", "--calib");
  dir.write("fish.yaml",
            "width: 640\nheight: 480\nfx: 500\nfy: 500\ncx: 320\ncy: 240\n"
            "distortion:\n  model: equidistant\n  coefficients: [0.1, 0, 0, 0]\n");
  expect_usage_error("vanishing lines.txt --calib fish.yaml", "without distortion");
  expect_usage_error("vanishing absent.txt --calib K.txt", "absent.txt");
  expect_usage_error("vanishing lines.txt --calib absent.txt", "absent.txt");
  expect_usage_error("vanishing lines.txt --calib K.txt --noise 0", "end_px");
  expect_usage_error("vanishing lines.txt --calib K.txt --max-points 0", "max_points");
  expect_usage_error("vanishing lines.txt --calib K.txt --seed x", "--seed");
  dir.write("short.txt", "10 10 60 12\n1 2 3\n");
  expect_usage_error("vanishing short.txt --calib K.txt", "short.txt:2: a segment has 4 numbers");
  dir.write("word.txt", "10 ten 60 12\n");
  expect_usage_error("vanishing word.txt --calib K.txt", "word.txt:1: v1");
  dir.write("point.txt", "10 10 10 10\n");
  expect_usage_error("vanishing point.txt --calib K.txt", "point.txt:1: the segment has no length");
  dir.write("K2.txt", "520 520 322 237\n");
  expect_usage_error("vanishing lines.txt --calib K2.txt", "K2.txt:1: a camera has 6 numbers");
}

}  // namespace vanishing_cli_test
}  // namespace placegraph
