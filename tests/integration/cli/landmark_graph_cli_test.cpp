// `placegraph optimize` and `convert` of graphs with priors and point landmarks.
#include <placegraph/graph/geometry/lie.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/cli_test.h"
#include "tests/support/data.h"

namespace placegraph {
namespace landmark_graph_cli_test {

using nlohmann::json;
using test::CommandResult;
using testing::HasSubstr;

class LandmarkGraphs : public test::CliTest {
 protected:
  json optimize(const std::string& path, const std::string& options = "") {
    const CommandResult result =
        run("optimize " + path + " -o out.g2o --force --quiet --json " + options);
    EXPECT_EQ(result.code, 0) << result.err;
    printed = result.err;
    return result.code == 0 ? json::parse(result.out) : json();
  }
  /// The numbers behind a tag and an id of the written graph.
  std::vector<double> written(const std::string& tag, int id) {
    std::istringstream lines(test::read_file(dir / "out.g2o"));
    for (std::string line; std::getline(lines, line);) {
      std::istringstream fields(line);
      std::string name;
      int number = -1;
      if (!(fields >> name >> number) || name != tag || number != id) continue;
      std::vector<double> values;
      for (double v; fields >> v;) values.push_back(v);
      return values;
    }
    ADD_FAILURE() << "no " << tag << " " << id;
    return {};
  }
  std::string printed;
};

std::string numbers_of(const SE3& T) {
  std::ostringstream out;
  out.precision(17);
  const auto& q = T.rotation().quaternion();
  out << T.translation().x() << " " << T.translation().y() << " " << T.translation().z() << " "
      << q.x() << " " << q.y() << " " << q.z() << " " << q.w();
  return out.str();
}

std::string numbers_of(const Eigen::Vector3d& p) {
  std::ostringstream out;
  out.precision(17);
  out << p.x() << " " << p.y() << " " << p.z();
  return out.str();
}

SE3 pose(double x, double y, double z, double angle) {
  return {SO3::exp({0.1 * angle, 0.2, angle}), Eigen::Vector3d(x, y, z)};
}

const std::string kSix = " 25 0 0 0 0 0 25 0 0 0 0 25 0 0 0 100 0 0 100 0 100\n";

/// Three poses that are measured by a sensor beside them, which sees two points too: without noise.
struct RigOfThree {
  SE3 T_node_sensor = pose(0.3, -0.1, 0.2, 0.7);
  std::vector<SE3> nodes = {pose(0, 0, 0, 0), pose(1, 0.2, 0.1, 0.4), pose(2, 0.9, 0.2, 0.9)};
  std::vector<Eigen::Vector3d> points = {{3, 1, 0.5}, {2, 3, -0.5}};

  std::string text(bool priors, bool points_have_lines) const {
    std::ostringstream out;
    out << "PARAMS_SE3OFFSET 5 " << numbers_of(T_node_sensor) << "\n";
    for (std::size_t i = 0; i < nodes.size(); ++i)  // from a wrong start
      out << "VERTEX_SE3:QUAT " << i << " "
          << numbers_of(i == 0 && !priors ? nodes[0] : nodes[i] * pose(0.1, -0.1, 0.05, 0.1))
          << "\n";
    for (std::size_t i = 0; points_have_lines && i < points.size(); ++i)
      out << "VERTEX_TRACKXYZ " << 10 + i << " "
          << numbers_of(Eigen::Vector3d(points[i] + Eigen::Vector3d(0.2, 0.1, 0))) << "\n";
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
      out << "EDGE_SE3:QUAT " << i << " " << i + 1 << " "
          << numbers_of(nodes[i].inverse() * nodes[i + 1]) << kSix;
    for (std::size_t i = 0; priors && i < nodes.size(); ++i)
      out << "EDGE_SE3_PRIOR " << i << " 5 " << numbers_of(nodes[i] * T_node_sensor) << kSix;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t k = 0; k < points.size(); ++k)
        out << "EDGE_SE3_TRACKXYZ " << i << " " << 10 + k << " 5 "
            << numbers_of(Eigen::Vector3d((nodes[i] * T_node_sensor).inverse() * points[k]))
            << " 100 0 0 50 0 25\n";
    return out.str();
  }
};

TEST_F(LandmarkGraphs, HaveTheCostsThatOthersFind) {
  PLACEGRAPH_CASE_OR_SKIP("graph_landmarks_in_the_plane");
  json report = optimize(test::cases_dir() + "/graph_landmarks_in_the_plane/landmarks.g2o");
  EXPECT_NEAR(report["chi2_log"].get<double>(), 23.308610, 1e-5);
  EXPECT_NEAR(written("VERTEX_SE2", 19)[0], -0.1441, 1e-4);
  EXPECT_NEAR(written("VERTEX_XY", 100)[1], 1.9824, 1e-4);
  PLACEGRAPH_CASE_OR_SKIP("graph_pose_priors_in_space");
  report = optimize(test::cases_dir() + "/graph_pose_priors_in_space/priors.g2o");
  EXPECT_NEAR(report["chi2_log"].get<double>(), 8.751641, 1e-5);
  EXPECT_NEAR(written("VERTEX_SE3:QUAT", 19)[0], 0.46108, 1e-5);
}

TEST_F(LandmarkGraphs, FollowSensorsThatSitBesideTheNodes) {
  const RigOfThree rig;
  for (const bool priors : {false, true})
    for (const bool points_have_lines : {false, true}) {
      dir.write("rig.g2o", rig.text(priors, points_have_lines));
      const json report = optimize("rig.g2o");
      EXPECT_EQ(report["priors"], priors ? 3 : 0);
      EXPECT_EQ(report["landmarks"], 2);
      EXPECT_EQ(report["sights"], 6);
      EXPECT_LT(report["chi2_log"].get<double>(), 1e-9);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(written("VERTEX_SE3:QUAT", 2)[axis], rig.nodes[2].translation()[axis], 1e-5);
        EXPECT_NEAR(written("VERTEX_TRACKXYZ", 11)[axis], rig.points[1][axis], 1e-5);
      }
      // What is written says the same.
      ASSERT_EQ(run("graph convert out.g2o again.g2o --force").code, 0);
      EXPECT_LT(optimize("again.g2o")["chi2_log_initial"].get<double>(), 1e-9);
    }
}

TEST_F(LandmarkGraphs, TakeMeasuredPosesAndPositionsInThePlane) {
  const std::string edges =
      "EDGE_SE2 0 1 1 0 0 100 0 0 100 0 100\nEDGE_SE2 1 2 1 0 0 100 0 0 100 0 100\n";
  // Positions along the diagonal: a gain for native optimization, no vertex is held.
  dir.write("positions.g2o", edges +
                                 "EDGE_PRIOR_SE2_XY 0 5 5 4 0 4\n"
                                 "EDGE_PRIOR_SE2_XY 2 6.4142135624 6.4142135624 4 0 4\n");
  json report = optimize("positions.g2o");
  EXPECT_LT(report["chi2_log"].get<double>(), 1e-9);
  EXPECT_EQ(report["free_directions"], 0);
  EXPECT_NEAR(written("VERTEX_SE2", 1)[0], 5.7071067812, 1e-6);
  EXPECT_NEAR(written("VERTEX_SE2", 1)[2], 0.7853981634, 1e-6);
  EXPECT_EQ(written("EDGE_PRIOR_SE2_XY", 0).size(), 5u);
  // One position leaves the heading free.
  dir.write("one.g2o", edges + "EDGE_PRIOR_SE2_XY 0 5 5 4 0 4\n");
  EXPECT_EQ(optimize("one.g2o")["free_directions"], 1);
  dir.write("pose.g2o", edges + "EDGE_PRIOR_SE2 1 3 4 1.5707963268 4 0 0 4 0 4\n");
  report = optimize("pose.g2o");
  EXPECT_LT(report["chi2_log"].get<double>(), 1e-9);
  EXPECT_NEAR(written("VERTEX_SE2", 2)[1], 5, 1e-6);
}

/// A square of four poses in the plane, whose corners see a point in the middle and one each beside
/// it, a little wrong; `rotation_rad` and `shift` bring the poses of the file out of the frame of
/// priors.
std::string square_with_points(const std::string& more, double rotation_rad = 0, double shift = 0) {
  std::ostringstream out;
  out.precision(17);
  const SE2 T(shift, -shift, rotation_rad);
  const double corners[4][2] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  const auto corner = [&](int i) { return SE2(corners[i][0], corners[i][1], 1.57 * i); };
  for (int i = 0; i < 4; ++i) {
    const SE2 at = T * corner(i);
    out << "VERTEX_SE2 " << i << " " << at.translation().x() << " " << at.translation().y() << " "
        << at.rotation().angle() << "\n";
    out << "EDGE_SE2 " << i << " " << (i + 1) % 4 << " 4.05 0.02 1.5707963 100 0 0 100 0 400\n";
    out << "EDGE_SE2_XY " << i << " 10 2.0" << i << " 1.98 25 0 25\n";
    out << "EDGE_SE2_XY " << i << " " << 11 + i << " 3 -1 25 0 25\n";
  }
  return out.str() + more;
}

TEST_F(LandmarkGraphs, HaveOneMinimumForBothEnginesWhereverTheyStart) {
  const std::string priors =
      "EDGE_PRIOR_SE2 0 0.1 0 0 25 0 0 25 0 400\nEDGE_PRIOR_SE2 2 4 4.1 3.1 25 0 0 25 0 400\n";
  dir.write("near.g2o", square_with_points(priors));
  const json native = optimize("near.g2o"), ceres = optimize("near.g2o", "--engine ceres");
  const double cost = native["chi2_log"].get<double>();
  EXPECT_GT(cost, 0.1);
  EXPECT_NEAR(ceres["chi2_log"].get<double>(), cost, 1e-6 * cost);
  EXPECT_EQ(ceres["engine"], "ceres");
  const std::vector<double> corner = written("VERTEX_SE2", 2);
  dir.write("far.g2o", square_with_points(priors, 2.8, 1000));
  EXPECT_NEAR(optimize("far.g2o")["chi2_log"].get<double>(), cost, 1e-6 * cost);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(written("VERTEX_SE2", 2)[i], corner[i], 1e-4);
}

TEST_F(LandmarkGraphs, TellDirectionsThatNothingHolds) {
  // A bearing alone, as a matrix of rank one: along the ray the point is anywhere.
  dir.write("ray.g2o", square_with_points("EDGE_SE2_XY 1 20 3 4 16 -12 9\n"));
  json report = optimize("ray.g2o");
  EXPECT_EQ(report["free_directions"], 1);
  EXPECT_EQ(report["free_vertices"], json({20}));
  EXPECT_THAT(printed, HasSubstr("1 directions free, at 1 vertices (20)"));
  // A second one from elsewhere places it.
  dir.write("rays.g2o", square_with_points("EDGE_SE2_XY 1 20 3 4 16 -12 9\n"
                                           "EDGE_SE2_XY 2 20 3 4 16 -12 9\n"));
  EXPECT_EQ(optimize("rays.g2o")["free_directions"], 0);
  EXPECT_THAT(printed, testing::Not(HasSubstr("directions free")));
  // One measured position leaves the heading of all.
  dir.write("position.g2o", square_with_points("EDGE_PRIOR_SE2_XY 3 7 7 4 0 4\n"));
  report = optimize("position.g2o", "--engine ceres");
  EXPECT_EQ(report["free_directions"], 1);
  EXPECT_EQ(report["free_vertices"].size(), 9u);
  // A measured pose without a heading too, in space about three axes.
  dir.write("rig.g2o", RigOfThree().text(false, true) +
                           "EDGE_SE3_PRIOR 1 5 1 2 3 0 0 0 1 9 0 0 0 0 0 9 0 0 0 0 9 0 0 0 0 0 0 "
                           "0 0 0\n");
  EXPECT_EQ(optimize("rig.g2o")["free_directions"], 3);
}

TEST_F(LandmarkGraphs, TakeInformationThatIsSemiDefiniteWithinItsPrintedDigits) {
  // Rank one, printed with six digits: the smaller eigenvalue is below zero.
  dir.write("ray.g2o", square_with_points("EDGE_SE2_XY 1 20 3 4 100.003 57.7368 33.3340\n"));
  EXPECT_EQ(optimize("ray.g2o")["free_directions"], 1);
  dir.write("prior.g2o",
            square_with_points("EDGE_PRIOR_SE2 1 3 4 0 100.003 57.7368 0 33.3340 0 4\n"));
  EXPECT_EQ(optimize("prior.g2o")["free_directions"], 1);
}

TEST_F(LandmarkGraphs, OfSensorsBesideTheirVerticesHaveTheCostOfTheLogarithm) {
  dir.write("rig.g2o", RigOfThree().text(true, false));
  expect_usage_error("optimize rig.g2o -o no.g2o --cost g2o",
                     "priors of a sensor that stands beside its vertex");
  EXPECT_TRUE(optimize("rig.g2o")["chi2_g2o"].is_null());
  dir.write("plain.g2o", RigOfThree().text(false, true));
  EXPECT_LT(optimize("plain.g2o", "--cost g2o")["chi2_g2o"].get<double>(), 1e-9);
}

TEST_F(LandmarkGraphs, SayWhichPartsNothingTiesToTheWorld) {
  const std::string apart =
      "VERTEX_SE2 30 9 9 0\nVERTEX_SE2 31 8 9 0\n"
      "EDGE_SE2 30 31 1 0 0 1 0 0 1 0 1\n";
  dir.write("parts.g2o", square_with_points(apart + "EDGE_PRIOR_SE2 0 0 0 0 1 0 0 1 0 1\n"));
  const json report = optimize("parts.g2o");
  EXPECT_EQ(report["components"], 2);
  EXPECT_EQ(report["held_vertices"], json::array({30}));
  EXPECT_THAT(printed, HasSubstr("falls into 2 components"));
  dir.write("parts.g2o", square_with_points(apart + "FIX 31\n"));
  EXPECT_EQ(optimize("parts.g2o")["held_vertices"], json::array({0}));
  dir.write("whole.g2o", square_with_points("VERTEX_XY 40 1 1\n"));  // that nobody sees
  EXPECT_EQ(optimize("whole.g2o")["components"], 1);
  EXPECT_EQ(printed, "");
}

TEST_F(LandmarkGraphs, SayWhatIsWrongAndWhere) {
  const std::string two =
      "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n";
  const auto refuses = [&](const std::string& line, const std::string& message) {
    dir.write("bad.g2o", two + line + "\n");
    expect_usage_error("optimize bad.g2o -o no.g2o", message);
  };
  refuses("EDGE_PRIOR_SE2 7 0 0 0 1 0 0 1 0 1", "bad.g2o:4: there is no vertex 7");
  refuses("EDGE_PRIOR_SE2_XY 7 0 0 1 0 1", "bad.g2o:4: there is no vertex 7");
  refuses("EDGE_PRIOR_SE2_XY 1 0 0 1 2 1", "bad.g2o:4: the information is indefinite");
  refuses("EDGE_PRIOR_SE2 1 0 0 nan 1 0 0 1 0 1", "bad.g2o:4: theta: 'nan' is not finite");
  refuses("EDGE_PRIOR_SE2 1 0 0 0 1 2 0 1 0 1", "bad.g2o:4: the information is indefinite");
  refuses("EDGE_PRIOR_SE2 1 0 0 0 0 0 0 0 0 0", "bad.g2o:4: the information is all zero");
  refuses("EDGE_PRIOR_SE2 1 1e60 0 0 1 0 0 1 0 1", "bad.g2o:4: a position beyond");
  refuses("EDGE_SE2_XY 0 9 1 1 1e200 0 1", "bad.g2o:4: the information is above");
  refuses("VERTEX_XY 1 3 4", "bad.g2o:4: vertex 1 is there twice");
  refuses("EDGE_SE2_XY 0 1 3 4 1 0 1", "bad.g2o:4: vertex 1 is a pose, not a point");
  refuses("EDGE_SE2_XY 0 9 nan 4 1 0 1", "bad.g2o:4: ");
  refuses("EDGE_SE2_XY 0 9 4 1 0 1", "bad.g2o:4: EDGE_SE2_XY: expected 7 numbers, found 6");
  refuses("VERTEX_TRACKXYZ 9 3 4 5", "bad.g2o:4: is spatial, but the poses are not in SE3");
  refuses("EDGE_BEARING_SE2_XY 0 9 1 1", "bad.g2o:4: 'EDGE_BEARING_SE2_XY': unknown tag");
  const RigOfThree rig;
  dir.write("rig.g2o", rig.text(true, true) + "EDGE_SE3_TRACKXYZ 0 10 6 1 1 1 1 0 0 1 0 1\n");
  expect_usage_error("optimize rig.g2o -o no.g2o", "there is no line PARAMS_SE3OFFSET 6");
}

TEST_F(LandmarkGraphs, AreRefusedWhereOnlyPosesAreTaken) {
  dir.write("rig.g2o", RigOfThree().text(true, true));
  for (const char* option :
       {"--robust auto", "--incremental", "--initialization chordal", "--certify"})
    expect_usage_error(std::string("optimize rig.g2o -o no.g2o ") + option,
                       "rig.g2o: has priors or point landmarks");
  expect_usage_error("synth graph rig.g2o -o no.g2o --shuffle", "priors or point landmarks");
  const CommandResult poses = run("graph convert rig.g2o poses.kitti");
  EXPECT_EQ(poses.code, 0) << poses.err;
  EXPECT_THAT(poses.out, HasSubstr("2 landmarks left out"));
}

}  // namespace landmark_graph_cli_test
}  // namespace placegraph
