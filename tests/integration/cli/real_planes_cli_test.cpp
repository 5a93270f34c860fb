// `placegraph track plane` and `placegraph image two-view-planes` on research data.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "tests/support/cli_test.h"
#include "tests/support/data.h"
#include "tests/support/plane_track_lines.h"
#include "tests/support/scenes/planes_world.h"

namespace placegraph {
namespace real_planes_cli_test {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using test::CommandResult;
using test::plane_track_lines;
using test::PlaneTrackLine;
using test::read_file;

class RealPlanesCli : public test::CliTest {};

/// Where the world's plane z = 0 is seen, from KITTI's calib.txt and poses.txt.
struct Poses {
  Eigen::Matrix<double, 3, 4> P;
  std::vector<Eigen::Matrix<double, 3, 4>> T_world_cam;
  explicit Poses(const std::string& folder) {
    std::istringstream calibration(read_file(folder + "/calib.txt"));
    std::string name;
    calibration >> name;
    for (int i = 0; i < 12; ++i) calibration >> P(i / 4, i % 4);
    std::istringstream in(read_file(folder + "/poses.txt"));
    Eigen::Matrix<double, 3, 4> T;
    while (in >> T(0, 0)) {
      for (int i = 1; i < 12; ++i) in >> T(i / 4, i % 4);
      T_world_cam.push_back(T);
    }
  }
  Vector2d px(std::size_t frame, const Vector2d& on_plane) const {
    const auto& T = T_world_cam.at(frame);
    const Eigen::Vector3d p_cam =
        T.leftCols<3>().transpose() * (Eigen::Vector3d(on_plane.x(), on_plane.y(), 0) - T.col(3));
    return (P.leftCols<3>() * p_cam).hnormalized();
  }
};

TEST_F(RealPlanesCli, FollowsTheBoardOfASequence) {
  PLACEGRAPH_DATA_OR_SKIP(folder, "sequences/cube_planar200");
  const Poses poses(folder);
  // Ten by seven squares of 4 cm.
  const std::vector<Vector2d> board_m = {
      {-0.04, -0.04}, {0.36, -0.04}, {0.36, 0.24}, {-0.04, 0.24}};
  std::string given;
  for (const Vector2d& corner : board_m) {
    const Vector2d px = poses.px(0, corner);
    given += (given.empty() ? "" : ",") + std::to_string(px.x()) + "," + std::to_string(px.y());
  }
  const CommandResult result =
      run("track plane '" + folder + "' --template " + given + " --out t.txt");
  ASSERT_EQ(result.code, 0) << result.err;
  const std::vector<PlaneTrackLine> lines = plane_track_lines(dir / "t.txt");
  ASSERT_EQ(lines.size(), poses.T_world_cam.size());
  double squares = 0;
  int tracked = 0;
  for (const PlaneTrackLine& line : lines) {
    if (line.state != "tracked") continue;
    ++tracked;
    for (std::size_t c = 0; c < 4; ++c)
      squares += (line.corners[c] - poses.px(line.frame, board_m[c])).squaredNorm() / 4;
  }
  const double rmse_px = std::sqrt(squares / std::max(1, tracked));
  std::printf("%d of %zu frames tracked, corners %.2f px RMSE\n", tracked, lines.size(), rmse_px);
  EXPECT_GE(tracked, 198);
  // The truth is good to 0.3 px in each of the two images, and corners leave the view.
  EXPECT_LT(rmse_px, 1.2);
}

TEST_F(RealPlanesCli, AgreesWithPeopleOnPairs) {
  PLACEGRAPH_DATA_OR_SKIP(folder, "scene/adelaide_planes");
  std::vector<double> wrong;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".txt") continue;
    std::vector<int> truth;
    std::istringstream in(read_file(entry.path().string()));
    for (std::string line; std::getline(in, line);) {
      std::istringstream fields(line);
      double px = 0;
      int label = 0;
      fields >> px >> px >> px >> px >> label;
      truth.push_back(label);
    }
    const CommandResult result =
        run("image two-view-planes '" + entry.path().string() + "' --out labels.txt --force");
    ASSERT_EQ(result.code, 0) << result.err;
    wrong.push_back(test::misclassification(truth, test::plane_labels(dir / "labels.txt")));
    std::printf("%s: %.2f %%\n", entry.path().stem().c_str(), 100 * wrong.back());
  }
  ASSERT_FALSE(wrong.empty());
  std::sort(wrong.begin(), wrong.end());
  const double median = 0.5 * (wrong[(wrong.size() - 1) / 2] + wrong[wrong.size() / 2]);
  std::printf("median %.2f %%\n", 100 * median);
  EXPECT_LE(median, 0.10);
}

}  // namespace real_planes_cli_test
}  // namespace placegraph
