// `placegraph track plane`.
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/cli_test.h"
#include "tests/support/pictures.h"
#include "tests/support/plane_track_lines.h"
#include "tests/support/scenes/board.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace track_plane_cli_test {

namespace fs = std::filesystem;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using nlohmann::json;
using test::CommandResult;
using test::plane_track_lines;
using test::PlaneTrackLine;
using test::read_file;
using test::write_file;

class TrackPlaneCli : public test::CliTest {
 protected:
  static constexpr int kGone = 4, kBack = 6, kEnd = 8;
  static Matrix3d view(int frame) {
    return test::view_of({160, 115}, 0.02 * frame, 1, {2.5 * frame, -frame}, {3e-5 * frame, 0});
  }
  /// Eight images, the board missing in two.
  void make_sequence() {
    fs::create_directory(dir / "images");
    for (int frame = 0; frame < kEnd; ++frame) {
      const bool there = frame < kGone || frame >= kBack;
      const auto H = there ? std::optional<Matrix3d>(view(frame)) : std::nullopt;
      ASSERT_TRUE(test::write_picture(dir / ("images/0" + std::to_string(frame) + ".png"),
                                      test::disturbed(board.picture(H), 2, random)));
    }
  }
  Random random = test::seeded_random(131);
  test::Board board{random};
  const std::string corners = "--template 110,70,210,70,210,160,110,160 ";
};

TEST_F(TrackPlaneCli, WritesALineAFrameAndSaysWhereItIsLost) {
  make_sequence();
  const CommandResult result = run("track plane images " + corners + "--out t.txt --draw seen");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, ::testing::HasSubstr("8 frames, 6 tracked, 2 lost"));
  const std::vector<PlaneTrackLine> lines = plane_track_lines(dir / "t.txt");
  ASSERT_EQ(lines.size(), 8u);
  for (const PlaneTrackLine& line : lines) {
    const int frame = static_cast<int>(line.frame);
    if (frame >= kGone && frame < kBack) {
      EXPECT_EQ(line.state, "lost");
      EXPECT_TRUE(std::isnan(line.corners[0].x()) && std::isnan(line.similarity));
      continue;
    }
    EXPECT_EQ(line.state, "tracked");
    EXPECT_LT(board.error_px(line.corners, view(frame)), 1);
    EXPECT_GT(line.similarity, 0.9);
  }
  for (int frame = 0; frame < kEnd; ++frame)
    EXPECT_FALSE(test::read_picture(dir / ("seen/00000" + std::to_string(frame) + ".png")).empty());
}

TEST_F(TrackPlaneCli, TellsEverythingAsJson) {
  make_sequence();
  ASSERT_TRUE(test::write_picture(dir / "template.png", board.picture(Matrix3d::Identity())));
  write_file(dir / "camera.yaml", "width: 320\nheight: 240\nfx: 300\nfy: 300\ncx: 160\ncy: 120\n");
  const CommandResult result =
      run("track plane images " + corners +
          "--template-image template.png --calib camera.yaml --normal 0,0,1 --trajectory t.kitti "
          "--similarity ssd_gain_bias --optimizer gauss_newton --motion-model homography "
          "--out t.txt --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const json report = json::parse(result.out);
  EXPECT_EQ(report["tracked"], 6);
  EXPECT_EQ(report["lost"], 2);
  const json& seen = report["tracks"][2];
  EXPECT_EQ(seen["state"], "tracked");
  EXPECT_EQ(seen["covariance_px2"].size(), 64u);
  EXPECT_EQ(seen["motion"]["R_cur_ref"].size(), 9u);
  EXPECT_EQ(report["tracks"][4]["state"], "lost");
  EXPECT_FALSE(report["tracks"][4]["reason"].get<std::string>().empty());
  const std::string poses = read_file(dir / "t.kitti");
  EXPECT_EQ(std::count(poses.begin(), poses.end(), '\n'), 8);
  EXPECT_THAT(poses, ::testing::HasSubstr("nan"));
}

TEST_F(TrackPlaneCli, RefusesWithOneLineAndLeavesNothingBehind) {
  make_sequence();
  const std::string whole = "track plane images " + corners + "--out t.txt ";
  expect_usage_error("track plane images --out t.txt", "--template");
  expect_usage_error("track plane images " + corners, "--out");
  expect_usage_error("track plane none " + corners + "--out t.txt", "none");
  expect_usage_error("track plane images --template 1,2,3 --out t.txt", "not 8 numbers");
  expect_usage_error("track plane images --template 1,2,3,4,5,6,7,x --out t.txt", "not 8 numbers");
  expect_usage_error("track plane images --template 1,2,3,4,5,6,7,nan --out t.txt", "--template");
  expect_usage_error("track plane images --template 10,70,400,70,210,160,110,160 --out t.txt",
                     "outside the image");
  expect_usage_error("track plane images --template 110,70,210,160,210,70,110,160 --out t.txt",
                     "convex");
  expect_usage_error(whole + "--motion-model cube", "--motion-model");
  expect_usage_error(whole + "--similarity x", "--similarity");
  expect_usage_error(whole + "--optimizer x", "--optimizer");
  expect_usage_error(whole + "--motion-model se3plane", "--calib");
  expect_usage_error(whole + "--normal 0,0,1", "--calib");
  expect_usage_error(whole + "--trajectory p.txt", "--calib");
  expect_usage_error(whole + "--calib", "has no calibration");
  write_file(dir / "bad.yaml", "width: 320\nheight: 240\nfocal: 3\n");
  expect_usage_error(whole + "--calib bad.yaml", "bad.yaml:3: ");
  write_file(dir / "wide.yaml", "width: 640\nheight: 240\nfx: 300\nfy: 300\ncx: 160\ncy: 120\n");
  expect_usage_error(whole + "--calib wide.yaml", "640x240");
  expect_usage_error(whole + "--calib wide.yaml --normal 0,0,0", "--normal");
  write_file(dir / "broken.png", "no image");
  expect_usage_error(whole + "--template-image broken.png", "broken.png");
  expect_usage_error("track plane images " + corners + "--out none/t.txt", "none");
  EXPECT_FALSE(fs::exists(dir / "t.txt"));
  write_file(dir / "t.txt", "kept");
  expect_usage_error(whole, "--force");
  EXPECT_EQ(read_file(dir / "t.txt"), "kept");
}

TEST_F(TrackPlaneCli, SaysThatABlankOrAbsentTemplateAllowsNoAnswer) {
  fs::create_directory(dir / "blank");
  ASSERT_TRUE(test::write_picture(dir / "blank/0.png", Image(240, 320, CV_8UC1, cv::Scalar(90))));
  expect_failure("track plane blank " + corners + "--out t.txt", 1, "too little texture");
  ASSERT_TRUE(test::write_picture(dir / "template.png", board.picture(Matrix3d::Identity())));
  expect_failure("track plane blank " + corners + "--template-image template.png --out t.txt", 1,
                 "none of 1 frames");
  EXPECT_FALSE(fs::exists(dir / "t.txt"));
}

}  // namespace track_plane_cli_test
}  // namespace placegraph
