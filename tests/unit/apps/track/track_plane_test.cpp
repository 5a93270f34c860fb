#include "apps/track/track_plane.h"

#include <placegraph/io/trajectories/trajectory_file.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/support/output.h"
#include "tests/support/message_of.h"
#include "tests/support/scenes/board.h"
#include "tests/support/seed.h"
#include "tests/unit/io/datasets/tiny_images.h"

namespace placegraph::apps {
namespace track_plane_test {

using Eigen::Matrix3d;
using test::message_of;
using testing::HasSubstr;
using testing::StartsWith;

/// A board before a background in six images, missing in the fourth.
class TrackPlaneCommand : public testing::Test {
 protected:
  static constexpr int kGone = 3, kEnd = 6;
  static Matrix3d view(int frame) {
    return test::view_of({160, 115}, 0.02 * frame, 1, {2.5 * frame, -frame}, {3e-5 * frame, 0});
  }
  TrackPlaneCommand() {
    for (int frame = 0; frame < kEnd; ++frame) {
      const auto H = frame == kGone ? std::nullopt : std::optional<Matrix3d>(view(frame));
      test::write_image(folder, "images/0" + std::to_string(frame) + ".png",
                        test::disturbed(board.picture(H), 2, random));
    }
    arguments.in = folder / "images";
    arguments.corners = "110,70,210,70,210,160,110,160";
    arguments.out = folder / "t.txt";
  }
  Random random = test::seeded_random(131);
  test::Board board{random};
  test::TemporaryFolder folder;
  TrackPlaneArguments arguments;
};

TEST_F(TrackPlaneCommand, FollowsTheBoardAndSaysWhereItIsLost) {
  arguments.draw = folder / "seen";
  const TrackPlaneResult result = track_plane(arguments);
  ASSERT_EQ(result.tracks.size(), 6u);
  EXPECT_EQ(result.tracked(), 5u);
  for (int frame = 0; frame < kEnd; ++frame) {
    const PlaneTrack& track = result.tracks[static_cast<std::size_t>(frame)];
    EXPECT_EQ(static_cast<bool>(track.outcome), frame != kGone) << frame;
    if (frame != kGone) {
      EXPECT_LT(board.error_px(track.corners_px, view(frame)), 1) << frame;
    }
    EXPECT_TRUE(std::filesystem::exists(folder / ("seen/00000" + std::to_string(frame) + ".png")));
  }
  EXPECT_THAT(test::read_file(arguments.out), StartsWith("0 tracked 110.0"));
  EXPECT_THAT(test::read_file(arguments.out),
              HasSubstr("\n3 lost nan nan nan nan nan nan nan nan nan\n"));
  const std::string text = to_text(result);
  EXPECT_THAT(text, HasSubstr("images: 6 frames, 5 tracked, 1 lost\n  lost at frame 3: "));
  EXPECT_THAT(text, HasSubstr("\n  found again at frame 4 by "));
  const auto json = nlohmann::json::parse(to_json(result));
  EXPECT_EQ(json["lost"], 1);
  EXPECT_EQ(json["tracks"][3]["state"], "lost");
}

TEST_F(TrackPlaneCommand, WritesPosesOfACameraWhoseCalibrationIsKnown) {
  arguments.calib = folder.write("K.txt", "300 300 160 120 320 240\n");
  arguments.normal = "0,0,2";
  arguments.trajectory = folder / "t.kitti";
  const TrackPlaneResult result = track_plane(arguments);
  ASSERT_TRUE(result.tracks[0].T_cur_ref);
  EXPECT_LT(result.tracks[0].T_cur_ref->translation().norm(), 0.01);
  EXPECT_LT((result.tracks[0].normal_ref - Eigen::Vector3d::UnitZ()).norm(), 0.05);
  const Trajectory poses = read_trajectory(arguments.trajectory);
  ASSERT_EQ(poses.size(), 6u);
  EXPECT_FALSE(poses.poses[kGone].T_world_body);
  // T_ref_cur, the inverse of what is tracked.
  ASSERT_TRUE(poses.poses[5].T_world_body && result.tracks[5].T_cur_ref);
  EXPECT_LT((poses.poses[5].T_world_body->translation() -
             result.tracks[5].T_cur_ref->inverse().translation())
                .norm(),
            1e-9);
}

TEST_F(TrackPlaneCommand, CutsTheTemplateFromAnotherImage) {
  arguments.image = test::write_image(folder, "template.png", board.picture(view(5)));
  const Matrix3d H = view(5);
  arguments.corners.clear();
  for (const Eigen::Vector2d& corner : board.corners) {
    const Eigen::Vector2d px = *map_pixel(H, corner);
    arguments.corners += (arguments.corners.empty() ? "" : ",") + std::to_string(px.x()) + "," +
                         std::to_string(px.y());
  }
  const TrackPlaneResult result = track_plane(arguments);
  ASSERT_TRUE(result.tracks[5].outcome);
  EXPECT_LT(board.error_px(result.tracks[5].corners_px, H), 1);
}

TEST_F(TrackPlaneCommand, WritesNothingWhereTheTemplateIsBlankOrInNoImage) {
  test::write_image(folder, "blank/0.png", Image(240, 320, CV_8UC1, cv::Scalar(90)));
  arguments.in = folder / "blank";
  EXPECT_THAT(message_of<NoResult>([&] { track_plane(arguments); }), HasSubstr("--template: "));
  arguments.image = folder / "images/00.png";
  EXPECT_THAT(message_of<NoResult>([&] { track_plane(arguments); }),
              HasSubstr("blank: the template was found in none of 1 frames: "));
  EXPECT_FALSE(std::filesystem::exists(arguments.out));
}

TEST_F(TrackPlaneCommand, NamesWhatItCannotUse) {
  const auto refusal = [&] { return message_of<ArgumentError>([&] { track_plane(arguments); }); };
  arguments.corners = "1,2,3";
  EXPECT_EQ(refusal(), "--template: '1,2,3' is not 8 numbers with commas between them");
  arguments.corners = "10,70,400,70,210,160,110,160";
  EXPECT_EQ(refusal(), "--template: (400, 70) is outside the image of 320x240");
  arguments.corners = "110,70,210,70,210,160,110,160";
  arguments.trajectory = folder / "t.tum";
  EXPECT_EQ(refusal(), "--trajectory: needs --calib");
  arguments.calib = "";
  EXPECT_EQ(refusal(), "--trajectory: a folder of images has no times, which .tum needs");
  arguments.trajectory.clear();
  EXPECT_EQ(refusal(), "--calib: " + arguments.in + " has no calibration; name a file with one");
  arguments.calib = folder.write("wide.txt", "300 300 320 120 640 240\n");
  EXPECT_EQ(message_of([&] { track_plane(arguments); }),
            *arguments.calib + ": is for images of 640x240, these are 320x240");
}

}  // namespace track_plane_test
}  // namespace placegraph::apps
