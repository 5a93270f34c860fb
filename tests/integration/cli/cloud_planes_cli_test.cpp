// `placegraph planes CLOUD` and `placegraph train planarity`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <sstream>

#include "tests/support/cli_test.h"
#include "tests/support/data.h"
#include "tests/support/pictures.h"
#include "tests/support/scenes/clouds.h"

namespace placegraph {
namespace cloud_planes_cli_test {

namespace fs = std::filesystem;
using nlohmann::json;
using test::CommandResult;
using test::read_file;
using ::testing::HasSubstr;

class CloudPlanesCli : public test::CliTest {
 protected:
  /// The corner as depth.png (millimetres), K.txt, cloud.txt with labels, cloud.bin and cloud.ply.
  test::SeenCloud write_corner() {
    const test::SeenCloud seen = test::look_at(test::see_corner, 1, 1e-3);
    const Camera camera = test::depth_camera();
    cv::Mat depth(camera.height, camera.width, CV_16UC1);
    std::ostringstream text;
    std::string binary, vertices;
    for (std::size_t i = 0; i < seen.labels.size(); ++i) {
      const Eigen::Vector3d& p = seen.cloud.points[i];
      depth.at<std::uint16_t>(static_cast<int>(i) / camera.width,
                              static_cast<int>(i) % camera.width) =
          static_cast<std::uint16_t>(std::lround(1e3 * p.z()));
      text << p.transpose() << ' ' << seen.labels[i] << '\n';
      const float values[4] = {static_cast<float>(p[0]), static_cast<float>(p[1]),
                               static_cast<float>(p[2]), 0.5f};
      binary.append(reinterpret_cast<const char*>(values), sizeof values);
      vertices.append(reinterpret_cast<const char*>(values), 3 * sizeof(float));
    }
    test::write_picture(dir / "depth.png", depth);
    dir.write("K.txt", "120 120 63.5 47.5 128 96\n");
    dir.write("cloud.txt", text.str());
    dir.write("cloud.bin", binary);
    dir.write("cloud.ply", "ply\nformat binary_little_endian 1.0\nelement vertex " +
                               std::to_string(seen.labels.size()) +
                               "\nproperty float x\nproperty float y\nproperty float z\n"
                               "end_header\n" +
                               vertices);
    return seen;
  }
  std::vector<int> point_labels(const std::string& path) {
    std::vector<int> labels;
    std::istringstream in(read_file(path));
    for (int label; in >> label;) labels.push_back(label);
    return labels;
  }
};

TEST_F(CloudPlanesCli, LabelsTheThreePlanesOfADepthImage) {
  const test::SeenCloud seen = write_corner();
  const CommandResult result =
      run("planes depth.png --calib K.txt --depth-scale 0.001 --out labels.png --ids --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const cv::Mat labels = test::read_picture(dir / "labels.png", DecodedPixels::kAsStored);
  ASSERT_EQ(labels.type(), CV_8UC1);
  ASSERT_EQ(labels.size(), cv::Size(128, 96));
  EXPECT_EQ(test::regions_found(seen.labels,
                                std::vector<int>(labels.begin<uchar>(), labels.end<uchar>())),
            3);
  const json report = json::parse(result.out);
  EXPECT_EQ(report["points"], 128 * 96);
  ASSERT_EQ(report["planes"].size(), 3u);
  const json& plane = report["planes"][0];
  EXPECT_EQ(plane["id"], 1);
  EXPECT_EQ(plane["covariance"].size(), 9u);
  EXPECT_GT(plane["probability"], 0.3);
  EXPECT_GT(plane["points"], report["planes"][1]["points"]);
  // The same in steps a metre.
  ASSERT_EQ(run("planes depth.png --calib K.txt --depth-scale 1000 --out again.png --ids").code, 0);
  EXPECT_EQ(read_file(dir / "again.png"), read_file(dir / "labels.png"));
}

TEST_F(CloudPlanesCli, TellsTheRoomThatPlanesMake) {
  write_corner();
  ASSERT_EQ(run("planes depth.png --calib K.txt --out labels.png --cuboids cuboids.json").code, 0);
  const json cuboids = json::parse(read_file(dir / "cuboids.json"));
  ASSERT_EQ(cuboids.size(), 1u);
  EXPECT_EQ(cuboids[0]["kind"], "room");
  EXPECT_EQ(cuboids[0]["faces"].size(), 3u);
  EXPECT_EQ(cuboids[0]["R_sensor_cuboid"].size(), 3u);
  EXPECT_EQ(cuboids[0]["size_m"].size(), 3u);
  const std::string again = "planes depth.png --calib K.txt --out other.png --cuboids ";
  expect_usage_error(again + "cuboids.json", "cuboids.json");
  expect_usage_error(again + "new.json --off-right-angle 90", "max_off_right_deg");
  EXPECT_FALSE(fs::exists(dir / "other.png"));
}

TEST_F(CloudPlanesCli, LabelsPointsOfEveryKindOfFile) {
  const test::SeenCloud seen = write_corner();
  for (const std::string file : {"cloud.txt", "cloud.bin", "cloud.ply"}) {
    const CommandResult result = run("planes " + file + " --out labels.txt --force");
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(test::regions_found(seen.labels, point_labels(dir / "labels.txt")), 3) << file;
  }
  for (const std::string method : {"ransac", "growing"})
    EXPECT_EQ(run("planes cloud.bin --method " + method + " --out " + method).code, 0);
}

TEST_F(CloudPlanesCli, JudgesByTrueLabels) {
  write_corner();
  const CommandResult result =
      run("planes cloud.txt --truth cloud.txt --truth-same 3=2 --truth-none 1 --out l.txt --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const json check = json::parse(result.out)["check"];
  EXPECT_EQ(check["planes"], 1);  // of two faces
  EXPECT_EQ(check["over_segmented"], 1);
  expect_usage_error("planes cloud.txt --truth cloud.txt --truth-same 3 --out m.txt",
                     "--truth-same");
  dir.write("few.txt", "1\n2\n");
  expect_usage_error("planes cloud.txt --truth few.txt --out m.txt", "2 labels for 12288 points");
}

TEST_F(CloudPlanesCli, FindsNoPlaneWhereThereIsNone) {
  Random random(5);
  std::ostringstream text;
  for (int i = 0; i < 500; ++i)
    text << random.normal() << ' ' << random.normal() << ' ' << random.normal() << '\n';
  dir.write("fog.txt", text.str());
  const CommandResult result = run("planes fog.txt --out labels.txt --json");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(json::parse(result.out)["planes"].size(), 0u);
  EXPECT_EQ(point_labels(dir / "labels.txt"), std::vector<int>(500, 0));
}

TEST_F(CloudPlanesCli, StandsBesideTheSubcommandAndReadsStrictly) {
  write_corner();
  expect_usage_error("planes", "CLOUD");
  expect_usage_error("planes cloud.txt", "--out");
  expect_usage_error("planes none.txt --out l.txt", "none.txt");
  expect_usage_error("planes cloud.txt --out l.txt --method best", "--method");
  expect_usage_error("planes cloud.txt --out l.txt --flatness -1", "flatness");
  expect_usage_error("planes depth.png --out l.png", "--calib");
  expect_usage_error("planes depth.png --out l.png --calib K.txt --depth-scale 0", "--depth-scale");
  dir.write("K2.txt", "120 120 63.5 47.5 640 480\n");
  expect_usage_error("planes depth.png --out l.png --calib K2.txt", "depth.png");
  test::write_picture(dir / "empty.png", cv::Mat::zeros(96, 128, CV_16UC1));
  expect_usage_error("planes empty.png --out l.png --calib K.txt", "0 points, 12 needed");
  test::write_picture(dir / "grey.png", cv::Mat::zeros(96, 128, CV_8UC1));
  expect_usage_error("planes grey.png --out l.png --calib K.txt", "16 bits");
  dir.write("nan.txt", "1 2 3\n1 2 nan\n");
  expect_usage_error("planes nan.txt --out l.txt", "nan.txt:2: ");
  dir.write("short.bin", "123");
  expect_usage_error("planes short.bin --out l.txt", "3 bytes");
  dir.write("huge.ply",
            "ply\nformat ascii 1.0\nelement vertex 99999999999\nproperty float x\n"
            "property float y\nproperty float z\nend_header\n1 2 3\n");
  expect_usage_error("planes huge.ply --out l.txt", "truncated");
  dir.write("few.txt", "1 2 3\n2 2 3\n");
  expect_usage_error("planes few.txt --out l.txt", "2 points, 12 needed");
  std::string nothing_measured;
  for (int i = 0; i < 1000; ++i) nothing_measured += "0 0 0\n";
  dir.write("zeros.txt", nothing_measured);
  expect_usage_error("planes zeros.txt --out l.txt", "0 points, 12 needed");
  EXPECT_FALSE(fs::exists(dir / "l.txt"));
  dir.write("kept.txt", "kept");
  expect_usage_error("planes cloud.txt --out kept.txt", "kept.txt");
  EXPECT_EQ(read_file(dir / "kept.txt"), "kept");
}

TEST_F(CloudPlanesCli, TrainsAModelThatFindsPlanes) {
  const test::SeenCloud seen = write_corner();
  const CommandResult trained =
      run("train planarity --out model.txt --clouds 16 --frames 0 --json");
  ASSERT_EQ(trained.code, 0) << trained.err;
  const json report = json::parse(trained.out);
  EXPECT_EQ(report["clouds"], 12);
  EXPECT_EQ(report["left_out"]["clouds"], 4);
  ASSERT_EQ(run("planes cloud.bin --model model.txt --out labels.txt").code, 0);
  EXPECT_GE(test::regions_found(seen.labels, point_labels(dir / "labels.txt")), 2);
  const std::string first = read_file(dir / "model.txt");
  ASSERT_EQ(run("train planarity --out model.txt --clouds 16 --frames 0 --force").code, 0);
  EXPECT_EQ(read_file(dir / "model.txt"), first);
  dir.write("other.txt", "no model\n");
  expect_usage_error("planes cloud.bin --model other.txt --out l.txt", "other.txt:1: ");
}

TEST_F(CloudPlanesCli, FindsThePlanesOfTheCastleAndTheRangeScan) {
  PLACEGRAPH_DATA_OR_SKIP(castle, "scene/castle_rgbd");
  PLACEGRAPH_DATA_OR_SKIP(scan, "scene/planes_synpeb/test_100_xyzlabel.txt");
  dir.write("castle.txt", "700 700 319.5 239.5 640 480\n");
  const auto check = [&](const std::string& arguments) {
    const CommandResult result = run("planes " + arguments + " --out l --force --json");
    EXPECT_EQ(result.code, 0) << result.err;
    return json::parse(result.out)["check"];
  };
  int planes = 0, correct = 0;
  for (const std::string frame : {"0001", "0021", "0039"}) {
    const json found = check("'" + castle + "/depth/" + frame + ".png' --calib castle.txt" +
                             " --depth-scale 32768 --truth '" + castle + "/plane_labels/" + frame +
                             ".png' --truth-same 4=3 --truth-same 14=5 --truth-same 15=7"
                             " --truth-min-points 300");
    planes += found["planes"].get<int>(), correct += found["correct"].get<int>();
  }
  EXPECT_GE(correct, 0.9 * planes);
  const json found =
      check("'" + scan + "' --truth '" + scan + "' --truth-none 3 --truth-min-points 100");
  EXPECT_EQ(found["planes"], 10);
  EXPECT_GE(found["correct"], 9);
}

}  // namespace cloud_planes_cli_test
}  // namespace placegraph
