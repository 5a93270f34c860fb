#include "apps/image/planes/planes_cloud.h"

#include <placegraph/io/files/image_file.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/message_of.h"
#include "tests/support/scenes/clouds.h"
#include "tests/unit/io/datasets/tiny_images.h"

namespace placegraph::apps {
namespace planes_cloud_test {

using test::message_of;
using testing::HasSubstr;

/// The corner of a room, three planes: depth.png in millimetres, and cloud.txt with true labels.
class PlanesCloudCommand : public testing::Test {
 protected:
  PlanesCloudCommand() {
    Image depth(camera.height, camera.width, CV_16UC1);
    std::ostringstream text, labels;
    for (std::size_t i = 0; i < seen.labels.size(); ++i) {
      const Eigen::Vector3d& p = seen.cloud.points[i];
      depth.at<std::uint16_t>(static_cast<int>(i) / camera.width,
                              static_cast<int>(i) % camera.width) =
          static_cast<std::uint16_t>(std::lround(1e3 * p.z()));
      text << p.transpose() << '\n';
      labels << seen.labels[i] << '\n';
    }
    test::write_image(folder, "depth.png", depth);
    folder.write("cloud.txt", text.str());
    folder.write("truth.txt", labels.str());
    folder.write("K.txt", "120 120 63.5 47.5 128 96\n");
    arguments.in = folder / "cloud.txt";
    arguments.out = folder / "labels.txt";
  }
  void take_depth() {
    arguments.in = folder / "depth.png";
    arguments.calib = folder / "K.txt";
    arguments.out = folder / "labels.png";
  }
  const Camera camera = test::depth_camera();
  const test::SeenCloud seen = test::look_at(test::see_corner, 1, 1e-3);
  test::TemporaryFolder folder;
  PlanesCloudArguments arguments;
};

TEST_F(PlanesCloudCommand, DrawsThePlanesWithALegendUnlessNumbersAreAsked) {
  take_depth();
  const PlanesCloudResult result = planes_cloud(arguments);
  const Image drawn = read_image_as_stored(arguments.out);
  ASSERT_EQ(drawn.type(), CV_8UC3);
  EXPECT_GT(drawn.rows, 96);  // the legend is below
  EXPECT_GE(drawn.cols, 128);
  std::map<int, cv::Vec3b> colours;
  for (int v = 0; v < 96; ++v)
    for (int u = 0; u < 128; ++u) {
      const auto [colour, added] =
          colours.emplace(result.found.labels[128 * v + u], drawn.at<cv::Vec3b>(v, u));
      EXPECT_EQ(colour->second, drawn.at<cv::Vec3b>(v, u));
    }
  EXPECT_GE(colours.size(), 3u);
  for (const auto& [a, colour_a] : colours)
    for (const auto& [b, colour_b] : colours) EXPECT_TRUE(a == b || colour_a != colour_b);
}

TEST_F(PlanesCloudCommand, LabelsThePixelsOfADepthImageByTheirPlane) {
  take_depth();
  arguments.ids = true;
  const PlanesCloudResult result = planes_cloud(arguments);
  EXPECT_EQ(result.points, 128 * 96);
  ASSERT_EQ(result.found.planes.size(), 3u);
  EXPECT_EQ(test::regions_found(seen.labels, result.found.labels), 3);
  // The floor is 0.8 m below: known to a millimetre or so from a thousand points of as much noise.
  double nearest = 1;
  for (const CloudPlane& plane : result.found.planes)
    nearest = std::min(nearest, std::abs(plane.plane.distance_m - 0.8));
  EXPECT_LT(nearest, 0.01);
  const Image labels = read_image_as_stored(arguments.out);
  ASSERT_EQ(labels.size(), cv::Size(128, 96));
  std::ptrdiff_t on_planes = 0;
  for (int v = 0; v < 96; ++v)
    for (int u = 0; u < 128; ++u) {
      EXPECT_EQ(labels.at<std::uint8_t>(v, u), result.found.labels[128 * v + u]);
      on_planes += labels.at<std::uint8_t>(v, u) > 0;
    }
  EXPECT_EQ(result.on_planes, on_planes);
  EXPECT_THAT(to_text(result), HasSubstr("depth.png: 12288 points, 3 planes, "));
}

TEST_F(PlanesCloudCommand, TakesDepthInStepsAMetreAsWell) {
  take_depth();
  const PlanesCloudResult metres = planes_cloud(arguments);
  arguments.depth_scale = 1000;
  arguments.force = true;
  const PlanesCloudResult steps = planes_cloud(arguments);
  EXPECT_EQ(steps.found.labels, metres.found.labels);
  ASSERT_EQ(steps.found.planes.size(), 3u);
  // Labels are the same at any scale, distances are not.
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(steps.found.planes[k].plane.distance_m, metres.found.planes[k].plane.distance_m,
                1e-9);
}

TEST_F(PlanesCloudCommand, FindsTheRoomThatPlanesMake) {
  take_depth();
  arguments.cuboids = folder / "cuboids.json";
  const PlanesCloudResult result = planes_cloud(arguments);
  ASSERT_TRUE(result.cuboids);
  ASSERT_EQ(result.cuboids->size(), 1u);
  EXPECT_EQ(result.cuboids->front().kind, CuboidKind::kRoom);
  const auto written = nlohmann::json::parse(test::read_file(arguments.cuboids));
  ASSERT_EQ(written.size(), 1u);
  EXPECT_EQ(written[0]["kind"], "room");
  EXPECT_EQ(written[0]["faces"].size(), 3u);  // numbered from 1, as the labels are
  for (const auto& [side, plane] : written[0]["faces"].items()) EXPECT_GE(plane, 1) << side;
  EXPECT_NEAR(written[0]["size_m"][0].get<double>(), 2 * result.cuboids->front().half[0], 1e-9);
}

TEST_F(PlanesCloudCommand, JudgesByTrueLabelsOfWhichSomeCountAsOthersOrNot) {
  arguments.truth = folder / "truth.txt";
  const PlanesCloudResult all = planes_cloud(arguments);
  ASSERT_TRUE(all.check);
  EXPECT_EQ(all.check->truth, 3);
  EXPECT_EQ(all.check->correct, 3);
  EXPECT_THAT(to_text(all),
              HasSubstr("  of 3 true planes: 3 found, 0 in pieces, 0 missed; 0 false\n"));
  arguments.same = {"3=2"};
  arguments.none = {1};
  arguments.force = true;
  const PlanesCloudResult some = planes_cloud(arguments);
  EXPECT_EQ(some.check->truth, 1);  // of two faces
  EXPECT_EQ(some.check->over_segmented, 1);
}

TEST_F(PlanesCloudCommand, NamesWhatItCannotUseAndWritesNothing) {
  arguments.same = {"3"};
  arguments.truth = folder / "truth.txt";
  EXPECT_EQ(message_of<ArgumentError>([&] { planes_cloud(arguments); }),
            "--truth-same: 3 is not of the form 14=5");
  arguments.truth = folder.write("few.txt", "1\n2\n");
  EXPECT_THAT(message_of([&] { planes_cloud(arguments); }),
              HasSubstr("few.txt: 2 labels for 12288 points"));
  arguments.in = folder.write("nan.txt", "1 2 3\n1 2 nan\n");
  EXPECT_THAT(message_of([&] { planes_cloud(arguments); }), HasSubstr("nan.txt:2: "));
  arguments.in = folder / "depth.png";
  EXPECT_EQ(message_of<ArgumentError>([&] { planes_cloud(arguments); }),
            "--calib: a depth image needs its camera");
  arguments.method = "best";
  EXPECT_EQ(message_of<ArgumentError>([&] { planes_cloud(arguments); }),
            "--method: 'best' is none of cuts, ransac, growing");
  EXPECT_FALSE(std::filesystem::exists(arguments.out));
}

}  // namespace planes_cloud_test
}  // namespace placegraph::apps
