// `placegraph image two-view-planes`.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/cli_test.h"
#include "tests/support/scenes/planes_world.h"

namespace placegraph {
namespace planes_cli_test {

namespace fs = std::filesystem;
using nlohmann::json;
using test::CommandResult;
using test::read_file;
using test::write_file;
using ::testing::HasSubstr;

class PlanesCli : public test::CliTest {
 protected:
  test::PlanesWorld make_world(int planes) {
    Random random(7);
    const test::PlanesWorld world = test::make_planes_world(
        planes, 40, 30, 0.3, test::pose({0.02, -0.06, 0.03}, {0.9, -0.2, 0.4}), random);
    std::ostringstream out;
    out.precision(10);
    for (std::size_t i = 0; i < world.labels.size(); ++i)
      out << world.matches.px_ref[i].transpose() << ' ' << world.matches.px_cur[i].transpose()
          << '\n';
    write_file(dir / "matches.txt", out.str());
    std::ostringstream yaml;
    yaml.precision(10);
    yaml << "width: 640\nheight: 480\nfx: " << world.camera.fx << "\nfy: " << world.camera.fy
         << "\ncx: " << world.camera.cx << "\ncy: " << world.camera.cy << '\n';
    write_file(dir / "calibration.yaml", yaml.str());
    return world;
  }
};

TEST_F(PlanesCli, LabelsMatchesAndTellsTheMotion) {
  const test::PlanesWorld world = make_world(2);
  const CommandResult result =
      run("image two-view-planes matches.txt --out labels.txt --calib calibration.yaml "
          "--motion motion.json --json");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_LT(test::misclassification(world.labels, test::plane_labels(dir / "labels.txt")), 0.05);
  const json report = json::parse(result.out);
  EXPECT_EQ(report["matches"], 110);
  EXPECT_EQ(report["regions"].size(), 2u);
  const json motion = json::parse(read_file(dir / "motion.json"));
  EXPECT_EQ(motion["outcome"], "ok");
  ASSERT_EQ(motion["readings"].size(), 1u);
  EXPECT_EQ(motion["readings"][0]["planes"].size(), 2u);
  Eigen::Vector3d t;
  for (int i = 0; i < 3; ++i) t[i] = motion["readings"][0]["t_b_a"][i];
  EXPECT_LT(test::angle_between(t, world.T_cur_ref.translation()), 0.08);
}

TEST_F(PlanesCli, TakesTheCameraInEitherFormAndByItsFormerName) {
  const test::PlanesWorld world = make_world(2);
  const Camera& k = world.camera;
  std::ostringstream line;
  line.precision(10);
  line << k.fx << ' ' << k.fy << ' ' << k.cx << ' ' << k.cy << " 640 480\n";
  write_file(dir / "K.txt", line.str());
  const auto motion_by = [&](const std::string& camera) {
    const CommandResult result = run("image two-view-planes matches.txt --out labels.txt --force " +
                                     camera + " --motion motion.json");
    EXPECT_EQ(result.code, 0) << result.err;
    return read_file(dir / "motion.json");
  };
  const std::string motion = motion_by("--calib calibration.yaml");
  EXPECT_EQ(motion_by("--calibration calibration.yaml"), motion);
  EXPECT_EQ(motion_by("--calib K.txt"), motion);
}

TEST_F(PlanesCli, LabelsAllZeroWhereThereIsNoPlane) {
  std::string text;
  Random random(9);
  for (int i = 0; i < 60; ++i) {
    for (int k = 0; k < 4; ++k) text += std::to_string(random.uniform(0, 500)) + ' ';
    text += '\n';
  }
  write_file(dir / "matches.txt", text);
  const CommandResult result = run("image two-view-planes matches.txt --out labels.txt");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(test::plane_labels(dir / "labels.txt"), std::vector<int>(60, 0));
}

TEST_F(PlanesCli, ReadsStrictlyAndNeverOverwritesUnasked) {
  make_world(1);
  expect_usage_error("planes", "CLOUD");
  expect_usage_error("image two-view-planes matches.txt", "--out");
  expect_usage_error("image two-view-planes none.txt --out l.txt", "none.txt");
  expect_usage_error("image two-view-planes matches.txt --out l.txt --motion m.json", "--calib");
  expect_usage_error("image two-view-planes matches.txt --out l.txt --noise 0", "noise_px");
  write_file(dir / "broken.txt", "1 2 3 4\n1 2 3\n");
  expect_usage_error("image two-view-planes broken.txt --out l.txt", "broken.txt:2: ");
  EXPECT_FALSE(fs::exists(dir / "l.txt"));
  write_file(dir / "few.txt", "1 2 3 4\n");
  expect_failure("image two-view-planes few.txt --out l.txt", 1, "8 needed");
  EXPECT_FALSE(fs::exists(dir / "l.txt"));
  write_file(dir / "labels.txt", "kept");
  expect_usage_error("image two-view-planes matches.txt --out labels.txt", "labels.txt");
  EXPECT_EQ(read_file(dir / "labels.txt"), "kept");
  EXPECT_EQ(run("image two-view-planes matches.txt --out labels.txt --force").code, 0);
}

}  // namespace planes_cli_test
}  // namespace placegraph
