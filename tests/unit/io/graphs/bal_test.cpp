#include <placegraph/io/graphs/bal.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace bal_test {

using test::message_of;
using test::TemporaryFolder;
using testing::HasSubstr;

const std::string kProblem =
    "2 1 2\n"
    "0 0 -3.5e+00 20\n"
    "1 0   10 -1.25\n"
    "\n"
    "0.1 -0.2 0.3\n1 2 -3\n500\n-0.1\n0.02\n"
    "0\n0\n0\n0.5\n0\n-1\n400\n0\n0\n"
    "0.25\n-0.5\n-6\n";

TEST(Bal, ReadsCamerasPointsAndObservations) {
  const TemporaryFolder folder;
  const Bundle bundle = read_bal(folder.write("a.txt", kProblem));
  ASSERT_EQ(bundle.cameras.size(), 2u);
  ASSERT_EQ(bundle.points.size(), 1u);
  ASSERT_EQ(bundle.observations.size(), 2u);
  EXPECT_EQ(bundle.observations[1].camera, 1);
  EXPECT_EQ(bundle.observations[1].point, 0);
  EXPECT_EQ(bundle.observations[0].px, Eigen::Vector2d(-3.5, -20));  // v counts downwards
  EXPECT_EQ(bundle.cameras[0].focal_px, 500);
  EXPECT_EQ(bundle.cameras[0].k1, -0.1);
  EXPECT_EQ(bundle.cameras[0].k2, 0.02);
  EXPECT_EQ(bundle.points[0], Eigen::Vector3d(0.25, -0.5, -6));
}

TEST(Bal, RotatesTheCamerasSoThatTheProjectionOfTheFormatBecomesOurs) {
  const TemporaryFolder folder;
  const Bundle bundle = read_bal(folder.write("a.txt", kProblem));
  const Eigen::Vector3d& p_world = bundle.points[0];
  // As the format has it: P = R X + t, p = -P / P.z, pixel = f (1 + k1 |p|^2 + k2 |p|^4) p.
  const Eigen::Vector3d w(0.1, -0.2, 0.3), t(1, 2, -3);
  const Eigen::Vector3d P = Eigen::AngleAxisd(w.norm(), w.normalized()) * p_world + t;
  const Eigen::Vector2d p = -P.head<2>() / P.z();
  const double s = p.squaredNorm();
  const Eigen::Vector2d theirs = 500 * (1 - 0.1 * s + 0.02 * s * s) * p;
  const Eigen::Vector3d p_cam = bundle.cameras[0].T_world_cam.inverse() * p_world;
  EXPECT_GT(p_cam.z(), 0);
  const Eigen::Vector2d q = p_cam.head<2>() / p_cam.z();
  const Eigen::Vector2d ours = 500 * (1 - 0.1 * s + 0.02 * s * s) * q;
  EXPECT_LT((ours - Eigen::Vector2d(theirs.x(), -theirs.y())).norm(), 1e-10);
}

TEST(Bal, WritesWhatItReads) {
  const TemporaryFolder folder;
  const Bundle bundle = read_bal(folder.write("a.txt", kProblem));
  write_bal(folder / "b.txt", bundle);
  const Bundle again = read_bal(folder / "b.txt");
  ASSERT_EQ(again.cameras.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT(
        (again.cameras[i].T_world_cam.matrix() - bundle.cameras[i].T_world_cam.matrix()).norm(),
        1e-14);
    EXPECT_EQ(again.cameras[i].focal_px, bundle.cameras[i].focal_px);
    EXPECT_EQ(again.observations[i].px, bundle.observations[i].px);
  }
  EXPECT_EQ(again.points[0], bundle.points[0]);
}

TEST(Bal, WritesTheNumbersOfACameraThatStays) {
  const TemporaryFolder folder;
  // Rotations beyond a half turn and without a unique vector, signed zeros, tiny numbers.
  Bundle bundle = read_bal(folder.write("a.txt",
                                        "3 1 1\n0 0 1 2\n"
                                        "0 0 4 1000000 1e-9 2 500 0 0\n3 2 1 5 6 7 800 1e-8 1e-13\n"
                                        "-0.0 0.02 9 -0.0 0.1 0.3 400 0.1 -0.0\n0 0 -4\n"));
  bundle.cameras[1].focal_px = 900;
  write_bal(folder / "b.txt", bundle);
  const Bundle again = read_bal(folder / "b.txt");
  for (const std::size_t i : {0U, 2U})
    for (std::size_t k = 0; k < 9; ++k) {
      const double written = (*again.cameras[i].of_file)[k], read = (*bundle.cameras[i].of_file)[k];
      EXPECT_EQ(written, read);
      EXPECT_EQ(std::signbit(written), std::signbit(read));
    }
  EXPECT_EQ(again.cameras[1].focal_px, 900);
  EXPECT_LT((again.cameras[1].T_world_cam.matrix() - bundle.cameras[1].T_world_cam.matrix()).norm(),
            1e-13);
}

TEST(Bal, NamesTheLineOfWhatIsWrong) {
  const TemporaryFolder folder;
  const auto complaint = [&](const std::string& text) {
    const std::string path = folder.write("a.txt", text);
    return message_of([&] { read_bal(path); });
  };
  EXPECT_THAT(complaint(""), HasSubstr("ends where a number of cameras is expected"));
  EXPECT_THAT(complaint("2 1\n"), HasSubstr("ends where a number of observations is expected"));
  EXPECT_THAT(complaint("2 -1 2\n"), HasSubstr("a.txt:1: number of points: -1 is out of range"));
  EXPECT_THAT(complaint("2 1 2\n0 0 1 2\n2 0 1 2\n"),
              HasSubstr("a.txt:3: camera index: 2 is not in [0, 2)"));
  EXPECT_THAT(complaint("2 1 2\n0 1 1 2\n"), HasSubstr("a.txt:2: point index: 1 is not in [0, 1)"));
  EXPECT_THAT(complaint("2 1 2\n0 0 1 nan\n"), HasSubstr("a.txt:2: pixel"));
  EXPECT_THAT(complaint("2 1 2\n0 0.5 1 1\n"), HasSubstr("a.txt:2: point index"));
  EXPECT_THAT(complaint("10000000 10000000 10000000\n0 0 1 2\n"),
              HasSubstr("ends where a camera index is expected"));
  EXPECT_THAT(complaint(kProblem + "7\n"), HasSubstr("a.txt:22: more numbers"));
  std::string flat = kProblem;
  flat.replace(flat.find("500"), 3, "0.0");
  EXPECT_THAT(complaint(flat), HasSubstr("the focal length 0 is not positive"));
  EXPECT_THAT(message_of([&] { read_bal(folder / "absent.txt"); }), HasSubstr("absent.txt"));
}

TEST(Bal, RefusesToWriteWhatIsNoBundle) {
  const TemporaryFolder folder;
  Bundle bundle;
  bundle.observations.push_back({0, 0, {1, 2}});
  EXPECT_THAT(message_of<ArgumentError>([&] { write_bal(folder / "a.txt", bundle); }),
              HasSubstr("there is no camera 0"));
  bundle.cameras.push_back({});
  EXPECT_THAT(message_of<ArgumentError>([&] { write_bal(folder / "a.txt", bundle); }),
              HasSubstr("there is no point 0"));
  bundle.points.emplace_back(0, std::nan(""), 0);
  EXPECT_THAT(message_of<ArgumentError>([&] { write_bal(folder / "a.txt", bundle); }),
              HasSubstr("point 0 is not finite"));
  bundle.cameras[0].focal_px = -1;
  EXPECT_THAT(message_of<ArgumentError>([&] { write_bal(folder / "a.txt", bundle); }),
              HasSubstr("focal length"));
}

}  // namespace bal_test
}  // namespace placegraph
