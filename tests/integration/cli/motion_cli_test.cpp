// `placegraph image motion`.
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/cli_test.h"
#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace motion_cli_test {

using nlohmann::json;
using test::CommandResult;
using ::testing::HasSubstr;

/// A car that turns a little: x right, y down, z ahead, R = R_y(yaw), t along half the turn.
class MotionCli : public test::CliTest {
 protected:
  void SetUp() override {
    Random random = test::seeded_random(61);
    scene_ = test::make_scene(camera_, {SE3(), truth_}, 120, random);
    std::ostringstream camera, matches, seen, pairs;
    camera.precision(10);
    camera << camera_.fx << ' ' << camera_.fy << ' ' << camera_.cx << ' ' << camera_.cy
           << " 640 480\n";
    dir.write("K.txt", camera.str());
    for (std::ostringstream* text : {&matches, &seen, &pairs}) text->precision(10);
    for (std::size_t i = 0; i < scene_.points_ref.size(); ++i) {
      const Eigen::Vector3d& p = scene_.points_ref[i];
      const Eigen::Vector3d q = truth_.inverse() * p;
      matches << scene_.px[0][i].transpose() << ' ' << scene_.px[1][i].transpose() << " 0.7\n";
      seen << p.transpose() << ' ' << scene_.px[1][i].transpose() << '\n';
      pairs << p.transpose() << ' ' << q.transpose() << '\n';
    }
    dir.write("matches.txt", matches.str());
    dir.write("seen.txt", seen.str());
    dir.write("pairs.txt", pairs.str());
  }
  json estimate(const std::string& arguments) {
    const CommandResult result = run("image motion " + arguments + " --json");
    EXPECT_EQ(result.code, 0) << result.err;
    return json::parse(result.out);
  }
  /// Whether it is the true motion; a translation up to scale has length one.
  void expect_truth(const json& report) {
    EXPECT_EQ(report["outcome"], "ok");
    const Eigen::Vector3d t = report["metric"].get<bool>()
                                  ? truth_.translation()
                                  : Eigen::Vector3d(truth_.translation().normalized());
    const Eigen::Matrix3d R = truth_.rotation().matrix();
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(report["t_ref_cur"][i], t[i], 1e-4);
      EXPECT_NEAR(report["T_ref_cur"][i][3], t[i], 1e-4);
      for (int j = 0; j < 3; ++j) {
        EXPECT_NEAR(report["R_ref_cur"][i][j], R(i, j), 1e-4);
        EXPECT_EQ(report["T_ref_cur"][i][j], report["R_ref_cur"][i][j]);
      }
    }
    EXPECT_GE(report["inliers"].get<int>(), 118);
    EXPECT_EQ(report["inlier_matches"].size(), report["inliers"]);
  }
  const Camera camera_ = test::pinhole(640, 480, 500);
  const SE3 truth_ =
      test::pose({0, 0.1, 0}, 1.5 * Eigen::Vector3d(std::sin(0.05), 0, std::cos(0.05)));
  test::PointScene scene_;
};

TEST_F(MotionCli, TellsTheMotionByEveryModelThatFits) {
  for (const char* model :
       {"auto", "essential", "gravity --gravity 0,1,0", "gravity --gravity 0,1,0,0,2,0"}) {
    SCOPED_TRACE(model);
    const json report = estimate(std::string("matches.txt --calib K.txt --method ") + model);
    expect_truth(report);
    EXPECT_EQ(report["covariance"].size(), 6u);
  }
  const json circle = estimate("matches.txt --calib K.txt --method circular");
  expect_truth(circle);
  EXPECT_NEAR(circle["yaw_rad"], 0.1, 1e-5);
  EXPECT_TRUE(circle["covariance"].is_null());
  EXPECT_EQ(estimate("matches.txt --calib K.txt")["model"], "essential");
}

TEST_F(MotionCli, TellsMetresByPointsOfKnownPlace) {
  for (const char* form : {"seen.txt --calib K.txt --method 3d2d", "pairs.txt --method 3d3d"}) {
    SCOPED_TRACE(form);
    const json report = estimate(form);
    EXPECT_TRUE(report["metric"].get<bool>());
    expect_truth(report);
  }
  EXPECT_THAT(run("image motion pairs.txt --method 3d3d --out m.json").out, HasSubstr("t_ref_cur"));
  EXPECT_EQ(json::parse(test::read_file(dir / "m.json"))["model"], "3d3d");
}

TEST_F(MotionCli, ReportsARotationWithoutATranslation) {
  std::ostringstream text;
  text.precision(10);
  const SE3 pure_rotation = test::pose({0, 0.05, 0}, {0, 0, 0});
  for (const Eigen::Vector3d& p : scene_.points_ref)
    if (const auto px = camera_.project(pure_rotation.inverse() * p))
      text << camera_.project(p)->transpose() << ' ' << px->transpose() << '\n';
  dir.write("turn.txt", text.str());
  const json report = estimate("turn.txt --calib K.txt");
  EXPECT_EQ(report["model"], "rotation");
  EXPECT_TRUE(report["T_ref_cur"].is_null());
  EXPECT_TRUE(report["t_ref_cur"].is_null());
  EXPECT_NEAR(report["R_ref_cur"][0][2], std::sin(0.05), 1e-5);
  EXPECT_EQ(report["covariance"].size(), 3u);
}

TEST_F(MotionCli, SaysWhatIsWrong) {
  expect_usage_error("image motion matches.txt", "--calib is required");
  expect_usage_error("image motion none.txt --calib K.txt", "none.txt");
  expect_usage_error("image motion matches.txt --calib K.txt --method gravity",
                     "--gravity is required");
  expect_usage_error("image motion matches.txt --calib K.txt --method gravity --gravity 0,1",
                     "--gravity: x,y,z");
  expect_usage_error("image motion matches.txt --calib K.txt --method gravity --gravity 0,0,0",
                     "length");
  expect_usage_error("image motion matches.txt --calib K.txt --gravity 0,1,0", "takes none");
  expect_usage_error("image motion matches.txt --calib K.txt --method cubic", "cubic");
  expect_usage_error("image motion matches.txt --calib K.txt --threshold -1", "threshold_px");
  expect_usage_error("image motion matches.txt --method 3d3d",
                     "matches.txt:1: 5 columns, at least 6");
  expect_usage_error("image motion pairs.txt --method 3d3d --point-noise 0", "--point-noise");
  dir.write("few.txt", "1 2 3 4\n5 6 7 8\n");
  expect_failure("image motion few.txt --calib K.txt", 1, "few.txt: 2 distinct matches, 8 needed");
  std::string repeated;
  for (int i = 0; i < 50; ++i) repeated += i % 2 ? "1 2 3 4\n" : "5 6 7 8\n";
  dir.write("repeated.txt", repeated);
  expect_failure("image motion repeated.txt --calib K.txt", 1, "2 distinct matches");
  // To those who read JSON the evidence is told all the same.
  const CommandResult result = run("image motion few.txt --calib K.txt --json");
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(json::parse(result.out)["outcome"], "too few data");
  EXPECT_TRUE(json::parse(result.out)["T_ref_cur"].is_null());
}

}  // namespace motion_cli_test
}  // namespace placegraph
