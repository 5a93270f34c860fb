#include "apps/graph/bundle.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/graphs/bal.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace bundle_test {

using test::message_of;
using testing::HasSubstr;

/// Three cameras that see all of twelve points, without noise; the points are `off_m` from where
/// they are seen.
Bundle three_views(double off_m) {
  Bundle bundle;
  for (int i = 0; i < 3; ++i)
    bundle.cameras.push_back(
        {SE3(SO3::exp({0, 0.1 * i, 0}), Eigen::Vector3d(-0.8 * i, 0.1 * i, 0)), 500, 0, 0});
  for (int k = 0; k < 12; ++k)
    bundle.points.emplace_back(k % 4 - 1.5, k / 4 - 1.0, 6 + 0.3 * ((5 * k) % 7));
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 12; ++k) {
      const Eigen::Vector3d p = bundle.cameras[i].T_world_cam.inverse() * bundle.points[k];
      bundle.observations.push_back({i, k, 500 * p.head<2>() / p.z()});
    }
  for (int k = 0; k < 12; ++k) bundle.points[k].x() += k % 2 == 0 ? off_m : -off_m;
  return bundle;
}

class BundleCommand : public testing::Test {
 protected:
  BundleCommand() {
    write_bal(folder / "in.txt", three_views(0.1));
    arguments.in = folder / "in.txt";
    arguments.out = folder / "out.txt";
  }
  test::TemporaryFolder folder;
  BundleArguments arguments;
};

TEST_F(BundleCommand, FindsTheViewsWithoutNoiseAndWritesThem) {
  const BundleResult result = bundle(arguments);
  EXPECT_EQ(result.cameras, 3u);
  EXPECT_EQ(result.points, 12u);
  EXPECT_EQ(result.observations, 36u);
  EXPECT_GT(result.report.cost_initial, 100);  // 0.1 m at 6 m are 8 px
  EXPECT_LT(result.report.rms_px, 1e-3);
  const Bundle written = read_bal(arguments.out);
  ASSERT_EQ(written.points.size(), 12u);
  for (std::size_t k = 0; k < 12; ++k)
    EXPECT_LT((written.points[k] - result.report.bundle.points[k]).norm(), 1e-12);
}

TEST_F(BundleCommand, KeepsCamerasAndPointsWithoutObservationsAsTheyWere) {
  Bundle start = three_views(0.1);
  const BundleCamera unused{SE3(SO3::exp({0.3, -2, 1}), Eigen::Vector3d(1e3, -2, 0.3)), 123.5, -0.1,
                            2};
  start.cameras.insert(start.cameras.begin() + 1, unused);
  start.cameras.push_back(unused);
  for (BundleObservation& seen : start.observations) {
    if (seen.camera > 0) ++seen.camera;
    ++seen.point;
  }
  const Eigen::Vector3d alone(1e-9, 0.1, -7e5);
  start.points.insert(start.points.begin(), alone);
  write_bal(arguments.in, start);
  const BundleResult result = bundle(arguments);
  EXPECT_LT(result.report.rms_px, 1e-3);
  EXPECT_EQ(result.unused_cameras, 2u);
  EXPECT_EQ(result.unused_points, 1u);
  EXPECT_THAT(to_text(result),
              HasSubstr("\n  kept as they are, without observations: 2 cameras, 1 points\n"));
  const Bundle written = read_bal(arguments.out);
  EXPECT_EQ(written.points[0], alone);
  for (const std::size_t i : {1, 4}) {
    const BundleCamera& camera = written.cameras[i];
    EXPECT_LT((camera.T_world_cam.inverse() * unused.T_world_cam).log().norm(), 1e-12);
    EXPECT_EQ(camera.focal_px, unused.focal_px);
    EXPECT_EQ(camera.k1, unused.k1);
    EXPECT_EQ(camera.k2, unused.k2);
  }
}

TEST_F(BundleCommand, WritesNothingWhereNoFileIsNamed) {
  arguments.out.clear();
  bundle(arguments);
  EXPECT_FALSE(std::filesystem::exists(folder / "out.txt"));
}

TEST_F(BundleCommand, RefusesAKernelItDoesNotKnow) {
  arguments.kernel = "soft";
  EXPECT_THAT(message_of<ArgumentError>([&] { bundle(arguments); }),
              HasSubstr("--kernel: 'soft' is none of none, "));
  EXPECT_FALSE(std::filesystem::exists(arguments.out));
}

TEST_F(BundleCommand, ChoosesTheKernelByItsName) {
  arguments.kernel = "huber";
  arguments.options.kernel.width = 2;
  const Bundle start = read_bal(arguments.in);
  double cost = 0;  // |e|^2 / 2 within 2 px, beyond it 2 |e| - 2
  for (const BundleObservation& seen : start.observations) {
    const Eigen::Vector3d p =
        start.cameras[seen.camera].T_world_cam.inverse() * start.points[seen.point];
    const double error_px = (500 * p.head<2>() / p.z() - seen.px).norm();
    cost += error_px < 2 ? error_px * error_px / 2 : 2 * error_px - 2;
  }
  EXPECT_NEAR(bundle(arguments).report.cost_initial, cost, 1e-9 * cost);
}

TEST_F(BundleCommand, KeepsAFileThatIsThereUnlessItIsForced) {
  folder.write("out.txt", "mine");
  EXPECT_THAT(message_of<ArgumentError>([&] { bundle(arguments); }),
              HasSubstr("out.txt: exists already; --force overwrites it"));
  EXPECT_EQ(test::read_file(arguments.out), "mine");
  arguments.force = true;
  bundle(arguments);
  EXPECT_EQ(read_bal(arguments.out).cameras.size(), 3u);
}

TEST_F(BundleCommand, NamesTheLineOfABrokenFileAndWritesNothing) {
  folder.write("in.txt", "1 1 1\n0 0 1.5 x\n");
  EXPECT_THAT(message_of([&] { bundle(arguments); }), HasSubstr("in.txt:2"));
  EXPECT_FALSE(std::filesystem::exists(arguments.out));
}

TEST(BundleText, SaysWhatWasFound) {
  BundleResult result;
  result.in = "in.txt";
  result.cameras = 2, result.points = 3, result.observations = 6;
  result.report.cost_initial = 12.5, result.report.cost_final = 0.25, result.report.rms_px = 0.5;
  result.report.iterations = 7;
  result.cpu_ms = 1.25, result.wall_ms = 2;
  const std::string lines =
      "in.txt: 2 cameras, 3 points, 6 observations\n"
      "  half the sum of squares 12.500000 -> 0.250000, 0.5000 px rms\n"
      "  7 iterations, 1.2 ms CPU, 2.0 ms wall";
  EXPECT_EQ(to_text(result), lines + "\n");
  result.out = "out.txt";
  EXPECT_EQ(to_text(result), lines + "; written to out.txt\n");
  const auto json = nlohmann::json::parse(to_json(result));
  EXPECT_EQ(json["observations"], 6);
  EXPECT_EQ(json["cost_initial"], 12.5);
  EXPECT_EQ(json["cost"], 0.25);
}

}  // namespace bundle_test
}  // namespace placegraph::apps
