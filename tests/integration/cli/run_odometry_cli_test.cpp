// `placegraph run --odometry`: the motion that wheels tell beside the pictures.
#include <placegraph/graph/core/angle.h>

#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "tests/support/cli_test.h"

namespace placegraph {
namespace run_odometry_cli_test {

namespace fs = std::filesystem;
using nlohmann::json;
using test::CommandResult;
using test::read_file;
using test::write_file;
using ::testing::HasSubstr;

constexpr int kFrames = 24;  // a metre and a tenth of a second between two

/// A rendered drive, made once for all tests.
class RunOdometryCli : public test::CliTest {
 protected:
  static void SetUpTestSuite() {
    sequence = new test::TemporaryFolder;
    const CommandResult result = test::run_placegraph(
        "synth sequence town-loop --frames 24 --stereo --size 448x280 --difficulty clean --out "
        "drive",
        sequence->path());
    ASSERT_EQ(result.code, 0) << result.err;
    // It tells the height of the camera, which gives one eye its unit already.
    fs::remove(drive() + "/world.yaml");
  }
  static void TearDownTestSuite() { delete sequence; }
  static std::string drive() { return *sequence / "drive"; }
  static std::vector<Eigen::Isometry3d> truth() {
    std::istringstream in(read_file(drive() + "/poses.txt"));
    std::vector<Eigen::Isometry3d> poses(kFrames, Eigen::Isometry3d::Identity());
    for (Eigen::Isometry3d& pose : poses)
      for (int i = 0; i < 12; ++i) in >> pose.matrix()(i / 4, i % 4);
    return poses;
  }
  CommandResult run_with(const std::string& arguments) {
    return run("run '" + drive() + "' --threads 1 --force --json --out out " + arguments);
  }
  double ate_m(const std::string& estimate) {
    const CommandResult result =
        run("eval '" + drive() + "' " + estimate + " --align origin --json");
    EXPECT_EQ(result.code, 0) << result.err;
    return result.code == 0 ? json::parse(result.out).at("ate_rmse_m").get<double>() : NAN;
  }

 private:
  static test::TemporaryFolder* sequence;
};
test::TemporaryFolder* RunOdometryCli::sequence = nullptr;

/// Stamped poses of wheels that go 1 % too far, turn 0.1 deg too much a frame, and slip in
/// [slip_begin, slip_end), where they go three times as far as the vehicle.
std::string wheels(const std::vector<Eigen::Isometry3d>& truth, int slip_begin, int slip_end,
                   double begin_s = 0, double unit_s = 1) {
  std::ostringstream out;
  out.precision(12);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (int i = 0; i < kFrames; ++i) {
    if (i > 0) {
      Eigen::Isometry3d step = truth[i - 1].inverse() * truth[i];
      step.translation() *= i >= slip_begin && i < slip_end ? 3 : 1.01;
      pose = pose * step * Eigen::AngleAxisd(deg_to_rad(0.1), Eigen::Vector3d::UnitY());
    }
    const Eigen::Quaterniond q(pose.rotation());
    out << (begin_s + 0.1 * i) / unit_s << ' ' << pose.translation().transpose() << ' '
        << q.coeffs().transpose() << '\n';
  }
  return out.str();
}

TEST_F(RunOdometryCli, SlipAndDriftOfTheWheelsAreOutvotedByAStereoPair) {
  write_file(dir / "wheels.tum", wheels(truth(), 10, 13));
  ASSERT_GT(ate_m("wheels.tum"), 3);  // six metres too far from the middle on
  const CommandResult alone = run_with("--sensor stereo");
  ASSERT_EQ(alone.code, 0) << alone.err;
  const double seen_m = ate_m("out/trajectory_optimized.tum");
  const CommandResult result = run_with("--sensor stereo --odometry wheels.tum");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(json::parse(result.out).at("posed"), kFrames);
  EXPECT_LT(ate_m("out/trajectory_optimized.tum"), seen_m + 0.005 * (kFrames - 1));
}

TEST_F(RunOdometryCli, GivesAMonocularCameraItsScaleAlthoughTheWheelsSlip) {
  write_file(dir / "wheels.tum", wheels(truth(), 10, 12));
  const CommandResult alone = run_with("--sensor mono");
  ASSERT_EQ(alone.code, 0) << alone.err;
  EXPECT_EQ(json::parse(alone.out).at("metric"), false);
  const CommandResult result = run_with("--sensor mono --odometry wheels.tum");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(json::parse(result.out).at("metric"), true);
  // The wheels say 1 %, what is seen of so few metres is good to a few more; slip were 17 %.
  EXPECT_LT(ate_m("out/trajectory_optimized.tum"), 0.03 * (kFrames - 1));
}

TEST_F(RunOdometryCli, OfAnotherClockIsRefusedAndOfAShortTimeIsReported) {
  const auto refusal = [&](double begin_s, double unit_s, const std::string& message) {
    write_file(dir / "wheels.tum", wheels(truth(), 0, 0, begin_s, unit_s));
    expect_usage_error("run '" + drive() + "' --odometry wheels.tum --out new/out", message);
  };
  refusal(0, 1e-3, "seems to have its times in milliseconds");
  refusal(1000, 1, "wheels.tum: has no time in common with the images: it is from 1000.000 to");
  refusal(1000, 1e-3, "seems to have its times in milliseconds");
  write_file(dir / "wheels.tum", wheels(truth(), 0, 0, 1.9));
  const CommandResult late = run_with("--sensor stereo --odometry wheels.tum");
  EXPECT_EQ(late.code, 0);
  EXPECT_THAT(late.err, HasSubstr("covers the motion between 4 of 23 pairs of frames"));
}

TEST_F(RunOdometryCli, ABrokenFileGivesOneLineAndNothingIsWritten) {
  const std::string first = "0 0 0 0 0 0 0 1\n", second = "0.1 0 0 1 0 0 0 1\n";
  struct Fault {
    std::string text, message;
  };
  for (const Fault& fault :
       {Fault{first + second + "0.2 0 0 2 0 0 0\n", "bad.txt:3: 8 fields needed"},
        Fault{first + second + "0.2 0 0 2 0 0", "bad.txt:3: 8 fields needed"},
        Fault{first + "0.1 0 nan 1 0 0 0 1\n", "bad.txt:2: pose: 'nan' is not finite"},
        Fault{first + "0.1 0 0 inf 0 0 0 1\n", "bad.txt:2: pose: 'inf' is not finite"},
        Fault{first + "0.1 0 0 1e308 0 0 0 1\n0.2 0 0 -1e308 0 0 0 1\n",
              "bad.txt:2: the step is longer"},
        Fault{first + "1e308 0 0 1 0 0 0 1\n", "bad.txt:2: time"},
        Fault{first + "0.1 0 0 one 0 0 0 1\n", "bad.txt:2: pose: 'one' is not a number"},
        Fault{first + second + "# still\n0.01 0 0 2 0 0 0 1\n", "bad.txt:4: times must increase"},
        Fault{first + second + "0.05 0 0 2 0 0 0 1\n", "bad.txt:3: times must increase"},
        Fault{first + "0.1 0 0 1 0 0 0 0\n", "bad.txt:2: quaternion is not of unit length"},
        Fault{first, "bad.txt: there is no step of motion"},
        Fault{"", "bad.txt: there is no step of motion"},
        Fault{"1 0 0 0 0 1 0 0 0 0 1 0\n", "bad.txt: 1 poses without times"},
        Fault{std::string("\x7f\x45\x4c\x46\0\1\2\xff", 8), "bad.txt:1: "}}) {
    write_file(dir / "bad.txt", fault.text);
    expect_usage_error("run '" + drive() + "' --odometry bad.txt --out new/out", fault.message);
    EXPECT_FALSE(fs::exists(dir / "new")) << fault.message;
  }
  expect_usage_error("run '" + drive() + "' --odometry absent.txt --out new/out", "absent.txt: ");
  expect_usage_error("run '" + drive() + "' --odometry . --out new/out", ".: is a folder");
  EXPECT_FALSE(fs::exists(dir / "new"));
  // What an earlier run left stays as it is.
  fs::create_directory(dir / "old");
  write_file(dir / "old/result.json", "mine");
  expect_usage_error("run '" + drive() + "' --odometry bad.txt --out old", "not empty");
  expect_usage_error("run '" + drive() + "' --odometry bad.txt --out old --force", "bad.txt:1: ");
  EXPECT_EQ(read_file(dir / "old/result.json"), "mine");
}

}  // namespace run_odometry_cli_test
}  // namespace placegraph
