#include "apps/image/planes/planes_two_view.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/support/output.h"
#include "tests/support/message_of.h"
#include "tests/support/scenes/planes_world.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace planes_two_view_test {

using test::message_of;
using testing::HasSubstr;

class PlanesTwoViewCommand : public testing::Test {
 protected:
  PlanesTwoViewCommand() {
    arguments.in = folder / "matches.txt";
    arguments.out = folder / "labels.txt";
  }
  /// 40 matches on each plane and 30 on none.
  test::PlanesWorld write_world(int planes) {
    Random random(7);
    const test::PlanesWorld world = test::make_planes_world(
        planes, 40, 30, 0.3, test::pose({0.02, -0.06, 0.03}, {0.9, -0.2, 0.4}), random);
    std::ostringstream matches, calib;
    matches.precision(10);
    calib.precision(10);
    for (std::size_t i = 0; i < world.labels.size(); ++i)
      matches << world.matches.px_ref[i].transpose() << ' ' << world.matches.px_cur[i].transpose()
              << '\n';
    const Camera& k = world.camera;
    calib << k.fx << ' ' << k.fy << ' ' << k.cx << ' ' << k.cy << " 640 480\n";
    folder.write("matches.txt", matches.str());
    folder.write("K.txt", calib.str());
    return world;
  }
  void write_noise() {
    std::string text;
    Random random(9);
    for (int i = 0; i < 60; ++i) {
      for (int k = 0; k < 4; ++k) text += std::to_string(random.uniform(0, 500)) + ' ';
      text += '\n';
    }
    folder.write("matches.txt", text);
    folder.write("K.txt", "500 500 320 240 640 480\n");
  }
  test::TemporaryFolder folder;
  PlanesTwoViewArguments arguments;
};

TEST_F(PlanesTwoViewCommand, LabelsTheMatchesAndFindsTheMotion) {
  const test::PlanesWorld world = write_world(2);
  arguments.calib = folder / "K.txt";
  arguments.motion = folder / "motion.json";
  const PlanesTwoViewResult result = planes_two_view(arguments);
  EXPECT_EQ(result.matches, 110);
  EXPECT_EQ(result.planes.regions.size(), 2u);
  EXPECT_LT(test::misclassification(world.labels, result.planes.labels), 0.05);
  std::string labels;
  for (const int label : result.planes.labels) labels += std::to_string(label) + "\n";
  EXPECT_EQ(test::read_file(arguments.out), labels);
  ASSERT_TRUE(result.motion && result.motion->outcome);
  ASSERT_EQ(result.motion->readings.size(), 1u);
  // As the direction of a translation is known from 80 matches of 0.3 px.
  EXPECT_LT(test::angle_between(result.motion->readings[0].T_cur_ref.translation(),
                                world.T_cur_ref.translation()),
            0.08);
  const auto written = nlohmann::json::parse(test::read_file(arguments.motion));
  EXPECT_EQ(written, nlohmann::json::parse(to_json(result))["motion"]);
  EXPECT_THAT(to_text(result), HasSubstr("  motion: ok, 1 readings\n"));
}

TEST_F(PlanesTwoViewCommand, SeeksNoMotionWithoutACamera) {
  write_world(2);
  const PlanesTwoViewResult result = planes_two_view(arguments);
  EXPECT_EQ(result.planes.regions.size(), 2u);
  EXPECT_FALSE(result.motion);
  EXPECT_FALSE(nlohmann::json::parse(to_json(result)).contains("motion"));
}

TEST_F(PlanesTwoViewCommand, AnswersThatThereIsNoPlane) {
  write_noise();
  arguments.calib = folder / "K.txt";
  const PlanesTwoViewResult alone = planes_two_view(arguments);
  EXPECT_EQ(alone.planes.labels, std::vector<int>(60, 0));
  EXPECT_FALSE(alone.motion);
  arguments.motion = folder / "motion.json";
  arguments.force = true;
  const PlanesTwoViewResult result = planes_two_view(arguments);
  EXPECT_EQ(test::read_file(arguments.motion),
            "{\n  \"outcome\": \"no consensus\",\n  \"readings\": []\n}\n");
  EXPECT_THAT(to_text(result), HasSubstr("60 matches, 0 planes, 60 matches on none, noise "));
  EXPECT_THAT(to_text(result), HasSubstr("  motion: no consensus, 0 readings\n"));
}

TEST_F(PlanesTwoViewCommand, WritesNothingWhereMatchesAreTooFewOrBroken) {
  folder.write("matches.txt", "1 2 3 4\n");
  EXPECT_THAT(message_of<NoResult>([&] { planes_two_view(arguments); }),
              HasSubstr("matches.txt: 1 matches, 8 needed"));
  folder.write("matches.txt", "1 2 3 4\n1 2 3\n");
  EXPECT_THAT(message_of([&] { planes_two_view(arguments); }), HasSubstr("matches.txt:2: "));
  EXPECT_FALSE(std::filesystem::exists(arguments.out));
}

TEST_F(PlanesTwoViewCommand, RefusesAMotionWithoutACamera) {
  write_world(1);
  arguments.motion = folder / "motion.json";
  EXPECT_EQ(message_of<ArgumentError>([&] { planes_two_view(arguments); }),
            "--motion: needs --calib");
}

}  // namespace planes_two_view_test
}  // namespace placegraph::apps
