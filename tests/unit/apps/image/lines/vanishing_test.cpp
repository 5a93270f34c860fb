#include "apps/image/lines/vanishing.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/support/output.h"
#include "tests/support/message_of.h"
#include "tests/support/scenes/manhattan_scene.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace vanishing_test {

using test::message_of;
using testing::HasSubstr;

class VanishingCommand : public testing::Test {
 protected:
  VanishingCommand() {
    arguments.calib = folder.write("K.txt", "520 520 322 237 640 480\n");
    arguments.in = folder / "lines.txt";
  }
  /// With a fifth column that says nothing.
  void write_lines(const std::vector<LineSegment>& segments) {
    std::ostringstream text;
    text.precision(10);
    for (const LineSegment& s : segments)
      text << s.start.transpose() << ' ' << s.end.transpose() << " 7\n";
    folder.write("lines.txt", text.str());
  }
  const Camera camera = test::vanishing_camera();
  test::TemporaryFolder folder;
  VanishingArguments arguments;
};

TEST_F(VanishingCommand, FindsTheWorldAndSaysWhichOfItsAxesEveryPointIs) {
  const SO3 R = SO3::exp({0.1, 0.4, 0.05});
  Random random(1);
  write_lines(test::manhattan_segments(camera, R, 40, 30, 0.3, random));
  const VanishingResult result = vanishing(arguments);
  EXPECT_EQ(result.segments, 150u);
  ASSERT_EQ(result.scene.frames.size(), 1u);
  // 0.3 px at the ends of 120 segments.
  EXPECT_LT((R.inverse() * result.scene.frames[0].R_cam_manhattan).log().norm(), 0.01);
  const auto json = nlohmann::json::parse(to_json(result));
  EXPECT_TRUE(json["manhattan_supported"].get<bool>());
  EXPECT_NEAR(json["R_cam_manhattan"][0][2].get<double>(), R.matrix()(0, 2), 0.01);
  ASSERT_EQ(json["points"].size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& v = json["vanishing_points"][i];
    const Eigen::Vector3d direction(v[0], v[1], v[2]);
    EXPECT_EQ(json["points"][i]["world"], 0);
    EXPECT_GT(std::abs(direction.dot(R.matrix().col(json["points"][i]["axis"].get<int>()))),
              0.9999);
  }
  EXPECT_EQ(json["labels"].size(), 150u);
  EXPECT_THAT(to_text(result),
              HasSubstr("lines.txt: 150 segments, 3 vanishing points, 1 Manhattan frames\n"));
}

TEST_F(VanishingCommand, AnswersThatNoWorldIsSupported) {
  Random random(2);
  std::vector<LineSegment> segments;
  test::add_clutter(camera, 100, random, segments);
  write_lines(segments);
  const VanishingResult result = vanishing(arguments);
  EXPECT_TRUE(result.scene.frames.empty());
  const auto json = nlohmann::json::parse(to_json(result));
  EXPECT_FALSE(json["manhattan_supported"].get<bool>());
  EXPECT_TRUE(json["R_cam_manhattan"].is_null());
  EXPECT_THAT(to_text(result), HasSubstr("\n  no Manhattan frame: too little evidence\n"));
}

TEST_F(VanishingCommand, HasNoAnswerOfTooFewSegments) {
  folder.write("lines.txt", "10 10 60 12\n");
  EXPECT_EQ(message_of<NoResult>([&] { vanishing(arguments); }),
            arguments.in + ": 1 segments, 4 needed");
}

TEST_F(VanishingCommand, NamesTheLineOfABrokenFileAndACameraThatBendsLines) {
  folder.write("lines.txt", "10 10 60 12\n1 2 3\n");
  EXPECT_THAT(message_of([&] { vanishing(arguments); }), HasSubstr("lines.txt:2: "));
  folder.write("lines.txt", "10 10 60 12\n");
  arguments.calib =
      folder.write("fish.yaml",
                   "width: 640\nheight: 480\nfx: 500\nfy: 500\ncx: 320\ncy: 240\n"
                   "distortion:\n  model: equidistant\n  coefficients: [0.1, 0, 0, 0]\n");
  EXPECT_EQ(message_of([&] { vanishing(arguments); }),
            arguments.calib + ": segments need a camera without distortion");
}

TEST(VanishingText, SaysWhatAPointIsToTheWorlds) {
  VanishingResult result;
  result.in = "lines.txt";
  result.segments = 20;
  result.scene.vanishing.points.resize(2);
  result.scene.vanishing.points[0].segments = 12;
  result.scene.vanishing.points[1].segments = 5;
  result.scene.roles.resize(2);
  result.scene.roles[0].frame = 0, result.scene.roles[0].axis = 2;
  result.scene.roles[1].across_frame = 0, result.scene.roles[1].across_axis = 1;
  EXPECT_THAT(to_text(result), HasSubstr("  12 segments, axis 2 of frame 0\n"));
  EXPECT_THAT(to_text(result), HasSubstr("  5 segments, orthogonal to axis 1 of frame 0\n"));
  const auto json = nlohmann::json::parse(to_json(result));
  EXPECT_EQ(json["points"][0]["axis"], 2);
  EXPECT_TRUE(json["points"][0]["across"].is_null());
  EXPECT_EQ(json["points"][1]["across"]["axis"], 1);
}

}  // namespace vanishing_test
}  // namespace placegraph::apps
