#include <gtest/gtest.h>
#include <placegraph/pipeline/slam/trajectory_recorder.h>

#include "tests/support/seed.h"

namespace placegraph {
namespace trajectory_recorder_test {

Frame frame(std::int64_t id) {
  Frame f;
  f.id = FrameId(id);
  f.stamp_ns = 100 * id;
  return f;
}
SE3 along(double z) { return SE3(SO3(), Eigen::Vector3d(0, 0, z)); }

/// Frames 0 to 4; 0 and 3 are keyframes 0 and 1, and every frame is a metre further.
struct Recorded {
  TrajectoryRecorder recorder;
  LocalMap map{{},
               Camera{.width = 100, .height = 100, .fx = 80, .fy = 80, .cx = 50, .cy = 50},
               Scale::kMetric};
  Recorded() {
    for (int i = 0; i < 5; ++i) {
      recorder.begin(frame(i));
      if (i % 3 == 0) {
        map.add_keyframe(along(i));
        map.update_poses({}, false);
        recorder.add_keyframe({KeyframeId(i / 3), frame(i)});
      }
      recorder.record(KeyframeId(i / 3), along(i % 3), 50);
      recorder.finish(along(i), 0);
    }
    recorder.report_all();
  }
};

TEST(TrajectoryRecorder, KeepsFramesRelativeToTheirKeyframe) {
  const Recorded r;
  ASSERT_EQ(r.recorder.records().size(), 5u);
  EXPECT_EQ(r.recorder.records()[4].keyframe, KeyframeId(1));
  EXPECT_NEAR(r.recorder.records()[4].T_keyframe_frame->translation().z(), 1, 1e-12);
  EXPECT_EQ(r.recorder.records()[4].inliers, 50);
  EXPECT_EQ(r.recorder.newest_keyframe(), KeyframeId(1));
  EXPECT_EQ(r.recorder.frame_of(KeyframeId(1)), FrameId(3));
  EXPECT_EQ(r.recorder.stamp_ns_of(KeyframeId(1)), 300);
}

TEST(TrajectoryRecorder, FramesMustBeInOrder) {
  const Recorded r;
  EXPECT_TRUE(TrajectoryRecorder().accepts(frame(7)));
  EXPECT_TRUE(r.recorder.accepts(frame(5)));
  EXPECT_FALSE(r.recorder.accepts(frame(4)));
  Frame late = frame(5);
  late.stamp_ns = 400;
  EXPECT_FALSE(r.recorder.accepts(late));
}

TEST(TrajectoryRecorder, FramesBetweenKeyframesFollowTheCorrectionOfTheirMotion) {
  Recorded r;
  Vector6d change;
  change << 0.3, 0, 0, 0, 0.03, 0;
  r.recorder.correct_motions({{KeyframeId(1), change}}, [](KeyframeId) { return along(3); });
  const auto& records = r.recorder.records();
  EXPECT_LT(records[0].T_keyframe_frame->log().norm(), 1e-12);  // a keyframe
  EXPECT_LT((records[4].T_keyframe_frame->inverse() * along(1)).log().norm(), 1e-12);
  // In proportion to the time; the error of the end, 2 m and 1 m ahead, is seen from the frame.
  for (int i = 1; i < 3; ++i) {
    const SE3 T_frame_end = along(3 - i);
    const Vector6d found =
        (along(i).inverse() * *records[static_cast<std::size_t>(i)].T_keyframe_frame).log();
    EXPECT_LT((found - i / 3.0 * (T_frame_end.adjoint() * change)).norm(), 1e-9) << i;
  }
}

TEST(TrajectoryRecorder, TheNewestFrameIsExplained) {
  Recorded r;
  r.recorder.explain(0.75, "");
  EXPECT_EQ(r.recorder.newest().confidence, 0.75);
  r.recorder.explain(std::nullopt, "too few points");
  EXPECT_EQ(r.recorder.newest().confidence, std::nullopt);
  EXPECT_EQ(r.recorder.newest().reason, "too few points");
}

TEST(TrajectoryRecorder, PosesAreRemovedFromAFrameOn) {
  Recorded r;
  r.recorder.remove_poses(FrameId(2), "contradicted");
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(r.recorder.records()[i].T_keyframe_frame.has_value(), i < 2) << i;
    EXPECT_EQ(r.recorder.records()[i].keyframe.has_value(), i < 2) << i;
    EXPECT_EQ(r.recorder.records()[i].reason, i < 2 ? "" : "contradicted") << i;
  }
  EXPECT_EQ(r.recorder.first_changed(), 2u);
  EXPECT_EQ(r.recorder.online(0).size(), 5u);  // as they were when the frames were processed
}

// The frame need not be there: frames of a video may be numbered with gaps.
TEST(TrajectoryRecorder, PosesAreRemovedFromAnyNumberOn) {
  Random random = test::seeded_random(1);
  for (int round = 0; round < 100; ++round) {
    TrajectoryRecorder recorder;
    std::vector<std::int64_t> ids;
    for (std::int64_t id = random.index(5); id < 40; id += 1 + random.index(5)) {
      recorder.begin(frame(id));
      recorder.record(KeyframeId(0), along(1), 50);
      recorder.finish(along(1), 0);
      ids.push_back(id);
    }
    recorder.report_all();
    const FrameId first(random.index(50));
    recorder.remove_poses(first, "contradicted");
    for (std::size_t i = 0; i < ids.size(); ++i)
      EXPECT_EQ(recorder.records()[i].keyframe.has_value(), ids[i] < first.value())
          << ids[i] << " of those from " << first << " on";
  }
}

TEST(TrajectoryRecorder, FramesOfAMotionThatIsUnknownStayAsTheyAre) {
  Recorded r;
  r.recorder.correct_motions({{KeyframeId(1), Vector6d::Ones()}},
                             [](KeyframeId) { return std::nullopt; });
  EXPECT_LT((r.recorder.records()[2].T_keyframe_frame->inverse() * along(2)).log().norm(), 1e-12);
  EXPECT_EQ(r.recorder.first_changed(), 5u);
}

TEST(TrajectoryRecorder, ACorrectionStaysWithTheKeyframeOfItsSegment) {
  Recorded r;
  r.recorder.correct({{FrameId(1), along(1.25)}, {FrameId(4), along(4.5)}}, KeyframeId(1), r.map);
  EXPECT_EQ(r.recorder.records()[1].keyframe, KeyframeId(0));
  EXPECT_NEAR(r.recorder.records()[1].T_keyframe_frame->translation().z(), 1.25, 1e-12);
  EXPECT_NEAR(r.recorder.records()[4].T_keyframe_frame->translation().z(), 1.5, 1e-12);
  EXPECT_EQ(r.recorder.first_changed(), 1u);
  // What was known online stays.
  EXPECT_NEAR(r.recorder.online(0)[4].T_world_body->translation().z(), 4, 1e-12);
}

TEST(TrajectoryRecorder, FramesFromBeforeASegmentHangOnItsFirstKeyframe) {
  Recorded r;
  r.map.restart(Scale::kMetric, std::nullopt);
  const KeyframeId first = r.map.add_keyframe(along(10));
  r.map.update_poses({}, false);
  r.recorder.correct({{FrameId(2), along(8)}}, first, r.map);
  EXPECT_EQ(r.recorder.records()[2].keyframe, first);
  EXPECT_NEAR(r.recorder.records()[2].T_keyframe_frame->translation().z(), -2, 1e-12);
}

TEST(TrajectoryRecorder, ANewScaleReachesTheKeyframesOfItsSegment) {
  Recorded r;
  r.recorder.rescale(KeyframeId(1), 3);
  EXPECT_NEAR(r.recorder.records()[1].T_keyframe_frame->translation().z(), 1, 1e-12);
  EXPECT_NEAR(r.recorder.records()[4].T_keyframe_frame->translation().z(), 3, 1e-12);
  EXPECT_EQ(r.recorder.first_changed(), 0u);
}

TEST(TrajectoryRecorder, AnOriginThatIsReplacedHasNoPoseUnlessTheCameraOnlyRotated) {
  TrajectoryRecorder recorder;
  for (int i = 0; i < 3; ++i) {
    recorder.begin(frame(i));
    recorder.begin_at_origin(i == 1);  // frame 1 has rotated since 0; 2 has not
    recorder.finish(along(0), 0);
    if (i == 1) {
      EXPECT_TRUE(recorder.online(0)[0].T_world_body);
    }
  }
  EXPECT_FALSE(recorder.online(0)[0].T_world_body);
  EXPECT_FALSE(recorder.online(0)[1].T_world_body);
  EXPECT_TRUE(recorder.online(0)[2].T_world_body);
}

TEST(TrajectoryRecorder, OnlinePosesAreThoseOfOneComponent) {
  TrajectoryRecorder recorder;
  for (int i = 0; i < 4; ++i) {
    recorder.begin(frame(i));
    recorder.finish(i == 1 ? std::nullopt : std::optional(along(i)), i < 2 ? 0 : 1);
  }
  const auto posed = [&](int component, std::size_t first) {
    std::vector<bool> result;
    for (const StampedPose& pose : recorder.online(component, first))
      result.push_back(pose.T_world_body.has_value());
    return result;
  };
  EXPECT_EQ(posed(0, 0), std::vector<bool>({true, false, false, false}));
  EXPECT_EQ(posed(1, 0), std::vector<bool>({false, false, true, true}));
  EXPECT_EQ(posed(1, 3), std::vector<bool>({true}));
}

TEST(TrajectoryRecorder, TakesUpASavedMapUpToItsLastKeyframe) {
  const Recorded r;
  Map map;
  map.frames = r.recorder.records();
  map.trajectory_online.poses = r.recorder.online(0);
  Keyframe keyframe;
  keyframe.id = KeyframeId(1), keyframe.frame = FrameId(3), keyframe.stamp_ns = 300;
  map.keyframes.push_back(keyframe);
  TrajectoryRecorder next;
  next.take_up(map, FrameId(3), 0);
  EXPECT_EQ(next.records().size(), 4u);
  EXPECT_EQ(next.online(0).size(), 4u);
  EXPECT_EQ(next.newest_keyframe(), KeyframeId(1));
  EXPECT_EQ(next.first_changed(), 4u);
}

}  // namespace trajectory_recorder_test
}  // namespace placegraph
