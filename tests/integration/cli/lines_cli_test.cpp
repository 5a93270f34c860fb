// `placegraph lines`.
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "tests/support/cli_test.h"
#include "tests/support/pictures.h"
#include "tests/support/scenes/tiles.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace lines_cli_test {

using test::CommandResult;
using test::read_file;
using ::testing::HasSubstr;

std::vector<std::vector<double>> rows(const std::string& text) {
  std::vector<std::vector<double>> result;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    result.emplace_back();
    for (double value; fields >> value;) result.back().push_back(value);
  }
  return result;
}

class LinesCli : public test::CliTest {
 protected:
  void SetUp() override {
    Random random = test::seeded_random(11);
    const test::TiledWall wall(5, 4, 60, random);
    Eigen::Matrix3d H;
    H << 0.85, -0.3, 70, 0.3, 0.85, -10, 0, 0, 1;
    test::write_picture(dir / "a.png", wall.seen(300, 240, Eigen::Matrix3d::Identity()));
    test::write_picture(dir / "b.png", wall.seen(320, 260, H));
    dir.write("a.txt", text_of(wall.edges(Eigen::Matrix3d::Identity())));
    dir.write("b.txt", text_of(wall.edges(H)));
  }
  static std::string text_of(const std::vector<LineSegment>& segments) {
    std::ostringstream text;
    for (const LineSegment& s : segments)
      text << s.start.transpose() << ' ' << s.end.transpose() << '\n';
    return text.str();
  }
};

TEST_F(LinesCli, MatchesGivenSegmentsWhereverTheirOptionStands) {
  for (const char* form :
       {"a.png b.png --segments a.txt b.txt", "--segments a.txt b.txt a.png b.png"}) {
    const CommandResult result = run(std::string("image match-lines --force -o m.txt ") + form);
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("80 and 80 segments"));
    const auto matches = rows(read_file(dir / "m.txt"));
    EXPECT_GT(matches.size(), 50u);
    for (const auto& match : matches) {
      ASSERT_EQ(match.size(), 2u);
      EXPECT_EQ(match[0], match[1]);
    }
  }
}

TEST_F(LinesCli, MatchesWhatItDetectsAndWritesIt) {
  const CommandResult result =
      run("image match-lines a.png b.png --out m.txt --write-segments sa.txt sb.txt");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto a = rows(read_file(dir / "sa.txt")), b = rows(read_file(dir / "sb.txt"));
  const auto matches = rows(read_file(dir / "m.txt"));
  EXPECT_GT(matches.size(), 40u);
  for (const auto& match : matches) {
    EXPECT_LT(match.at(0), static_cast<double>(a.size()));
    EXPECT_LT(match.at(1), static_cast<double>(b.size()));
  }
  ASSERT_EQ(run("image lines a.png -o d.txt").code, 0);
  EXPECT_EQ(read_file(dir / "d.txt"), read_file(dir / "sa.txt"));
}

TEST_F(LinesCli, SaysWhatIsWrong) {
  expect_usage_error("image lines", "IMAGE is required");
  expect_usage_error("image match-lines a.png -o m.txt", "IMAGES");
  expect_usage_error("image match-lines a.png absent.png -o m.txt", "absent.png: image is missing");
  expect_usage_error("image match-lines -o m.txt", "IMAGES is required");
  expect_usage_error("image match-lines --segments a.txt b.txt -o m.txt",
                     "--segments: needs the two images as well");
  dir.write("bad.txt", "1 2 3\n");
  expect_usage_error("image match-lines a.png b.png --segments a.txt bad.txt -o m.txt",
                     "bad.txt:1:");
  expect_usage_error("image match-lines a.png b.png -o a.txt", "--force");
  expect_usage_error(
      "image match-lines a.png b.png --segments a.txt b.txt --write-segments c.txt d.txt -o m.txt",
      "--write-segments");
}

TEST_F(LinesCli, BlankImagesAllowNoAnswer) {
  test::write_picture(dir / "blank.png", Image(100, 100, CV_8UC1, cv::Scalar(90)));
  expect_failure("image lines blank.png -o d.txt", 1, "no straight edges");
  expect_failure("image match-lines blank.png a.png -o m.txt", 1, "point matches agree");
}

class LinesAloneCli : public test::CliTest {};

TEST_F(LinesAloneCli, AreEnoughForOneCameraOfKnownHeightInACorridor) {
  ASSERT_EQ(run("synth sequence corridor-loop --frames 50 --out w").code, 0);
  ASSERT_EQ(run("run w --sensor mono --cues lines --no-loops --out o").code, 0);
  const CommandResult judged = run("eval w o/trajectory_optimized.kitti --align sim3 --json");
  ASSERT_EQ(judged.code, 0) << judged.err;
  const auto figures = nlohmann::json::parse(judged.out);
  EXPECT_GE(figures.at("posed").get<int>(), 48);
  // Five metres: the course to a tenth of a degree; the unit by a floor known to 1.5 % at first.
  EXPECT_LT(figures.at("ate_rmse_m").get<double>(), 0.02);
  EXPECT_NEAR(figures.at("scale").get<double>(), 1, 0.04);
}

TEST_F(LinesAloneCli, SayThatNothingCouldBePosedWhereTheyAreTooFew) {
  ASSERT_EQ(run("synth sequence corridor-loop --frames 3 --size 320x240 --out w").code, 0);
  const CommandResult result = run("run w --sensor mono --cues lines --no-loops --out o");
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("no frame could be posed"));
}

}  // namespace lines_cli_test
}  // namespace placegraph
