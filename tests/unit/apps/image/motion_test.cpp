#include "apps/image/motion.h"

#include <placegraph/graph/core/error.h>

#include <cmath>
#include <sstream>

#include "tests/support/message_of.h"
#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace motion_test {

using test::message_of;
using testing::HasSubstr;
using testing::StartsWith;

/// A car that turns a little: x right, y down, z ahead, 1.5 m along half its turn of 0.1 rad.
class MotionCommand : public testing::Test {
 protected:
  MotionCommand() {
    Random random = test::seeded_random(61);
    scene = test::make_scene(test::pinhole(640, 480, 500), {SE3(), T_ref_cur}, 120, random);
    std::ostringstream calib, matches, seen, pairs;
    for (std::ostringstream* text : {&calib, &matches, &seen, &pairs}) text->precision(10);
    const Camera& k = scene.camera;
    calib << k.fx << ' ' << k.fy << ' ' << k.cx << ' ' << k.cy << " 640 480\n";
    for (std::size_t i = 0; i < scene.points_ref.size(); ++i) {
      const Eigen::Vector3d& p = scene.points_ref[i];
      const Eigen::Vector3d q = T_ref_cur.inverse() * p;
      matches << scene.px[0][i].transpose() << ' ' << scene.px[1][i].transpose() << '\n';
      seen << p.transpose() << ' ' << scene.px[1][i].transpose() << '\n';
      pairs << p.transpose() << ' ' << q.transpose() << '\n';
    }
    folder.write("matches.txt", matches.str());
    folder.write("seen.txt", seen.str());
    folder.write("pairs.txt", pairs.str());
    arguments.in = folder / "matches.txt";
    arguments.calib = folder.write("K.txt", calib.str());
  }
  void expect_true_motion(const MotionResult& result) {
    const MotionEstimate& estimate = result.estimate;
    ASSERT_TRUE(estimate.outcome) << estimate.outcome.reason;
    EXPECT_FALSE(result.no_result);
    const Eigen::Vector3d t = estimate.metric
                                  ? T_ref_cur.translation()
                                  : Eigen::Vector3d(T_ref_cur.translation().normalized());
    EXPECT_LT((estimate.T_ref_cur->translation() - t).norm(), 1e-4);
    EXPECT_LT(test::angle_rad(*estimate.T_ref_cur, T_ref_cur), 1e-4);
    EXPECT_EQ(estimate.matches, 120);
    EXPECT_GE(estimate.inliers.size(), 118u);
  }
  const SE3 T_ref_cur =
      test::pose({0, 0.1, 0}, 1.5 * Eigen::Vector3d(std::sin(0.05), 0, std::cos(0.05)));
  test::PointScene scene;
  test::TemporaryFolder folder;
  MotionArguments arguments;
};

TEST_F(MotionCommand, FindsTheMotionOfACarByEveryModelThatFits) {
  for (const char* model : {"auto", "essential", "gravity", "circular"}) {
    SCOPED_TRACE(model);
    arguments.model = model;
    arguments.options.gravity = arguments.model == "gravity" ? "0,1,0,0,2,0" : "";
    const MotionResult result = motion(arguments);
    expect_true_motion(result);
    EXPECT_FALSE(result.estimate.metric);
    EXPECT_EQ(result.estimate.knows_covariance, arguments.model != "circular");
    EXPECT_EQ(result.estimate.model, arguments.model == "auto" ? "essential" : model);
  }
}

TEST_F(MotionCommand, TakesEachVerticalInTheCameraThatItIsOf) {
  // The second camera is rolled by 0.3 rad.
  const SE3 roll = test::pose({0, 0, 0.3}, Eigen::Vector3d::Zero());
  std::ostringstream matches;
  matches.precision(10);
  for (const Eigen::Vector3d& p : scene.points_ref)
    if (const auto px = scene.camera.project((T_ref_cur * roll).inverse() * p))
      matches << scene.camera.project(p)->transpose() << ' ' << px->transpose() << '\n';
  arguments.in = folder.write("rolled.txt", matches.str());
  arguments.model = "gravity";
  arguments.options.gravity =
      "0,1,0," + std::to_string(std::sin(0.3)) + "," + std::to_string(std::cos(0.3)) + ",0";
  const MotionResult result = motion(arguments);
  ASSERT_TRUE(result.estimate.outcome) << result.estimate.outcome.reason;
  EXPECT_LT(test::angle_rad(*result.estimate.T_ref_cur, T_ref_cur * roll), 1e-4);
}

TEST_F(MotionCommand, HandsTheFewestInliersOnToEveryModel) {
  arguments.options.min_inliers = 121;  // of 120 matches
  for (const char* model : {"auto", "essential", "circular", "3d2d", "3d3d"}) {
    arguments.model = model;
    arguments.in = folder / (arguments.model == "3d2d"   ? "seen.txt"
                             : arguments.model == "3d3d" ? "pairs.txt"
                                                         : "matches.txt");
    EXPECT_TRUE(motion(arguments).no_result) << model;
  }
}

TEST_F(MotionCommand, LevelsTheCameraOfACarByGravity) {
  // The same car, its camera tilted by a quarter turn about its axis: x down, y left.
  const SE3 tilt = test::pose({0, 0, -M_PI / 2}, Eigen::Vector3d::Zero());
  std::ostringstream matches;
  matches.precision(10);
  for (const Eigen::Vector3d& p : scene.points_ref) {
    const auto a = scene.camera.project(tilt * p);
    const auto b = scene.camera.project(tilt * (T_ref_cur.inverse() * p));
    if (a && b) matches << a->transpose() << ' ' << b->transpose() << '\n';
  }
  arguments.in = folder.write("tilted.txt", matches.str());
  arguments.model = "circular";
  arguments.options.gravity = "1,0,0";  // tilt * (0, 1, 0)
  const MotionResult result = motion(arguments);
  ASSERT_TRUE(result.estimate.outcome) << result.estimate.outcome.reason;
  EXPECT_NEAR(result.estimate.evidence["yaw_rad"].get<double>(), 0.1, 1e-4);
  arguments.options.gravity.clear();
  const MotionResult level = motion(arguments);
  EXPECT_TRUE(!level.estimate.outcome || level.estimate.inliers.size() < 60);
}

TEST_F(MotionCommand, TellsMetresByPointsOfKnownPlace) {
  for (const auto& [model, file] :
       {std::pair("3d2d", "seen.txt"), std::pair("3d3d", "pairs.txt")}) {
    SCOPED_TRACE(model);
    arguments.model = model;
    arguments.in = folder / file;
    const MotionResult result = motion(arguments);
    expect_true_motion(result);
    EXPECT_TRUE(result.estimate.metric);
    EXPECT_THAT(to_text(result), HasSubstr(" m, sigma "));
  }
  arguments.calib.clear();  // the last needs none
  EXPECT_TRUE(motion(arguments).estimate.outcome);
}

TEST_F(MotionCommand, ReportsARotationWithoutATranslation) {
  const SE3 rotation = test::pose({0, 0.05, 0}, {0, 0, 0});
  std::ostringstream matches;
  matches.precision(10);
  for (const Eigen::Vector3d& p : scene.points_ref)
    if (const auto px = scene.camera.project(rotation.inverse() * p))
      matches << scene.camera.project(p)->transpose() << ' ' << px->transpose() << '\n';
  arguments.in = folder.write("turn.txt", matches.str());
  const MotionResult result = motion(arguments);
  EXPECT_EQ(result.estimate.model, "rotation");
  EXPECT_FALSE(result.estimate.T_ref_cur);
  ASSERT_TRUE(result.estimate.R_ref_cur);
  EXPECT_LT((result.estimate.R_ref_cur->log() - Eigen::Vector3d(0, 0.05, 0)).norm(), 1e-5);
  const auto json = nlohmann::json::parse(to_json(result));
  EXPECT_TRUE(json["t_ref_cur"].is_null());
  EXPECT_EQ(json["covariance"].size(), 3u);
}

TEST_F(MotionCommand, WritesWhatItKnowsAlsoWhereMatchesAreTooFew) {
  std::string repeated;
  for (int i = 0; i < 50; ++i) repeated += i % 2 ? "1 2 3 4\n" : "5 6 7 8\n";
  arguments.in = folder.write("repeated.txt", repeated);
  arguments.out = folder / "m.json";
  const MotionResult result = motion(arguments);
  EXPECT_EQ(result.no_result, arguments.in + ": 2 distinct matches, 8 needed");
  EXPECT_EQ(result.estimate.matches, 50);
  EXPECT_EQ(test::read_file(arguments.out), to_json(result));
  const auto json = nlohmann::json::parse(to_json(result));
  EXPECT_EQ(json["outcome"], "too few data");
  EXPECT_EQ(json["model"], "auto");
  EXPECT_TRUE(json["T_ref_cur"].is_null());
}

TEST_F(MotionCommand, NamesTheLineOfABrokenFile) {
  arguments.in = folder.write("broken.txt", "1 2 3 4\n1 2 3\n");
  EXPECT_THAT(message_of([&] { motion(arguments); }), StartsWith(arguments.in + ":2: "));
}

TEST_F(MotionCommand, RefusesWhatDoesNotBelongTogether) {
  const auto refusal = [&] { return message_of<ArgumentError>([&] { motion(arguments); }); };
  arguments.model = "cubic";
  EXPECT_THAT(refusal(), StartsWith("--method: 'cubic' is none of auto, "));
  arguments.model = "gravity";
  EXPECT_EQ(refusal(), "--gravity is required for --method gravity");
  arguments.options.gravity = "0,1";
  EXPECT_THAT(refusal(), StartsWith("--gravity: x,y,z or x,y,z,x,y,z expected"));
  arguments.options.gravity = "0,0,0";
  EXPECT_EQ(refusal(), "--gravity: a direction needs a length");
  arguments.model = "auto";
  EXPECT_EQ(refusal(), "--gravity: --method auto takes none");
  arguments.options.gravity.clear();
  arguments.calib.clear();
  EXPECT_EQ(refusal(), "--calib is required for --method auto");
}

}  // namespace motion_test
}  // namespace placegraph::apps
