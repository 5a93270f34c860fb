#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/loops/loop_closer.h>

#include "tests/support/scenes/street.h"

namespace placegraph {
namespace loop_closer_test {

using namespace test;

constexpr double kDepth_m = 10;

/// Keyframes of two drives down the same street: 0 to 3, then 4 to 6 from the second one's start
/// on; the second in a unit of its own, as a single eye has it.
class LoopCloserOnAStreet : public testing::Test {
 protected:
  static constexpr int kFirst = 4, kAll = 7;
  static SE3 T_world(int keyframe) {
    return street_T_world_cam(keyframe < kFirst ? 2 * keyframe : 2 * (keyframe - kFirst) + 1);
  }
  static const Image& image(int keyframe) {
    static const std::vector<Image> images = [] {
      std::vector<Image> all;
      for (int k = 0; k < kAll; ++k)
        all.push_back(render(street_camera(), T_world(k), street(), 2).grey);
      return all;
    }();
    return images[static_cast<std::size_t>(keyframe)];
  }
  static Frame frame(int keyframe) {
    Frame frame;
    frame.id = FrameId(keyframe < kFirst ? keyframe : 100 + keyframe);
    frame.image = image(keyframe);
    return frame;
  }
  static LoopOptions small_options() {
    LoopOptions options;
    options.detector.max_features = 600;
    options.database.first_training = 4;
    options.min_similarity = 0;  // seven views are no basis for the weights of words
    return options;
  }
  static Calibration monocular() {
    Calibration calibration;
    calibration.camera = street_camera();
    return calibration;
  }
  static std::string stages(const LoopCloser& closer) {
    std::string text;
    for (const LoopRecord& r : closer.records())
      text += to_string(r.query_frame) + "-" + to_string(r.match_frame) + " " + to_string(r.stage) +
              " " + std::to_string(r.inliers) + "; ";
    return text;
  }
  static SE3 T_previous_this(int k, double unit_m) {
    const SE3 T = T_world(k - 1).inverse() * T_world(k);
    return SE3(T.rotation(), T.translation() / unit_m);
  }
  /// The loops after both drives. `drift` is how far off odometry between the drives is; without it
  /// they are two runs of tracking, which no odometry joins.
  std::vector<Loop> drive(LoopCloser& closer, double unit_m, const std::optional<SE3>& drift,
                          bool scale_unknown) {
    const auto odometry = [&](KeyframeId from, KeyframeId to) -> std::optional<TrackedMotion> {
      const std::int64_t a = from.value(), b = to.value();
      const bool across = (a < kFirst) != (b < kFirst);
      if (across && !drift) return std::nullopt;
      SE3 T = T_world(static_cast<int>(a)).inverse() * T_world(static_cast<int>(b));
      if (a >= kFirst && b >= kFirst) T = SE3(T.rotation(), T.translation() / unit_m);
      if (across) T = T * *drift;
      return TrackedMotion{T, across ? 5.0 : T.translation().norm()};
    };
    std::vector<Loop> loops;
    for (int k = 0; k < kAll; ++k) {
      const bool begins = k == 0 || k == kFirst;
      const double unit = k < kFirst ? 1 : unit_m;
      closer.add_view(KeyframeId(k), frame(k),
                      begins ? std::nullopt : std::optional(T_previous_this(k, unit)));
      const auto unknown = [&](KeyframeId, KeyframeId) { return scale_unknown; };
      const auto found = closer.find_loops({odometry, {}, unknown, apart_}, kDepth_m / unit);
      loops.insert(loops.end(), found.begin(), found.end());
    }
    return loops;
  }

  std::function<bool(KeyframeId, KeyframeId)>
      apart_;  // whether two keyframes are in different components
};

TEST_F(LoopCloserOnAStreet, AcceptsARevisitWhenASecondOneAgrees) {
  LoopCloser closer(small_options(), monocular(), 1);
  const auto loops = drive(closer, 1, SE3(), false);
  ASSERT_GE(loops.size(), 2u) << stages(closer);
  for (const Loop& loop : loops) {
    EXPECT_GE(loop.query, KeyframeId(kFirst));
    EXPECT_LT(loop.match, KeyframeId(kFirst));
    const SE3 truth = T_world(static_cast<int>(loop.match.value())).inverse() *
                      T_world(static_cast<int>(loop.query.value()));
    EXPECT_LT(distance_m(loop.T_match_query, truth), 0.1);
    EXPECT_EQ(loop.scale_match_query, 1);
    EXPECT_EQ(loop.information(6, 6), 0);
    EXPECT_GT(loop.information(0, 0), 0);
  }
  const auto accepted = std::count_if(closer.records().begin(), closer.records().end(),
                                      [](const LoopRecord& r) { return r.accepted(); });
  EXPECT_EQ(static_cast<std::size_t>(accepted), loops.size());
}

/// Knows which keyframe of the first drive each one of the second drive is beside.
struct TrueNeighbours final : PlaceRetrieval {
  int first_drive = 0, images = 0, cleared = 0;
  std::vector<FrameId> frames;  // begun
  void begin_frame(FrameId frame) override { frames.push_back(frame); }
  void clear() override {
    images = 0;
    ++cleared;
  }
  void add(const Image&) override { ++images; }
  std::vector<PlaceSimilarity> query(const Image&, int first, int last) override {
    const int beside = images - 1 - first_drive;
    if (beside < first || beside > last) return {};
    return {{beside, -7}};
  }
};

TEST_F(LoopCloserOnAStreet, TakesTheCandidatesOfARecognizerOfTheCallers) {
  LoopOptions options = small_options();
  options.min_similarity = 0.9;            // of visual words; it does not count here
  options.database.first_training = 1000;  // there are no visual words
  const auto recognizer = std::make_shared<TrueNeighbours>();
  recognizer->first_drive = kFirst;
  recognizer->images = 3;
  LoopCloser closer(options, monocular(), 1, recognizer);
  EXPECT_EQ(recognizer->cleared, 1);
  const auto loops = drive(closer, 1, SE3(), false);
  EXPECT_EQ(recognizer->images, kAll);
  std::vector<FrameId> frames = recognizer->frames;
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  ASSERT_EQ(frames.size(), static_cast<std::size_t>(kAll));
  for (const LoopCloser::View& view : closer.views())
    EXPECT_EQ(frames[static_cast<std::size_t>(&view - closer.views().data())], view.frame);
  ASSERT_GE(loops.size(), 2u) << stages(closer);
  for (const Loop& loop : loops) EXPECT_EQ(loop.query.value() - loop.match.value(), kFirst);
  for (const LoopRecord& record : closer.records()) EXPECT_EQ(record.similarity, -7);
}

TEST_F(LoopCloserOnAStreet, ComparesANewComponentWithTheNewestFramesOfAnother) {
  LoopOptions options = small_options();
  options.min_frame_gap = 200;  // more than the two drives have
  LoopCloser within(options, monocular(), 1);
  EXPECT_TRUE(drive(within, 1, {}, true).empty());
  EXPECT_TRUE(within.records().empty()) << stages(within);
  apart_ = [](KeyframeId a, KeyframeId b) { return (a.value() < kFirst) != (b.value() < kFirst); };
  LoopCloser across(options, monocular(), 1);
  EXPECT_GE(drive(across, 1, {}, true).size(), 2u) << stages(across);
}

TEST_F(LoopCloserOnAStreet, LooksAtNoCandidateThatIsOutOfReachByOdometry) {
  LoopCloser closer(small_options(), monocular(), 1);
  EXPECT_TRUE(drive(closer, 1, pose({0, 0, 0}, {0, 0, 6}), false).empty());
  ASSERT_FALSE(closer.records().empty());
  for (const LoopRecord& record : closer.records()) {
    EXPECT_EQ(record.stage, LoopStage::kReach) << stages(closer);
    EXPECT_EQ(record.model, LoopModel::kNone);
  }
}

TEST_F(LoopCloserOnAStreet, RefusesALoopThatOdometryCannotHaveDriftedTo) {
  // 11 degrees over 5 m at a depth of 10 m, where 2.5 are allowed.
  LoopCloser closer(small_options(), monocular(), 1);
  EXPECT_TRUE(drive(closer, 1, pose({0, 0.2, 0}, {0, 0, 0}), false).empty());
  const auto refused =
      std::find_if(closer.records().begin(), closer.records().end(),
                   [](const LoopRecord& r) { return r.stage == LoopStage::kDrift; });
  ASSERT_NE(refused, closer.records().end()) << stages(closer);
  EXPECT_NE(refused->model, LoopModel::kNone);
  EXPECT_GT(refused->inliers, 0);
}

TEST_F(LoopCloserOnAStreet, WaitsForASecondLoopThatAgrees) {
  // The two drives are sure of themselves, but each says another length of the second drive's path:
  // no two loops agree.
  LoopCloser closer(small_options(), monocular(), 1);
  std::size_t loops = 0;
  for (int k = 0; k < kAll; ++k) {
    const auto odometry = [](KeyframeId from, KeyframeId to) -> std::optional<TrackedMotion> {
      const std::int64_t a = from.value(), b = to.value();
      if ((a < kFirst) != (b < kFirst)) return std::nullopt;
      const SE3 T = T_world(static_cast<int>(a)).inverse() * T_world(static_cast<int>(b));
      return TrackedMotion{a < kFirst ? T : T.scaled(2), T.translation().norm()};
    };
    closer.add_view(KeyframeId(k), frame(k),
                    k == 0 || k == kFirst ? std::nullopt : std::optional(T_previous_this(k, 1)));
    loops += closer.find_loops({odometry, {}, {}, {}}, kDepth_m).size();
  }
  EXPECT_EQ(loops, 0u);
  const auto pending =
      std::count_if(closer.records().begin(), closer.records().end(),
                    [](const LoopRecord& r) { return r.stage == LoopStage::kSupport; });
  EXPECT_GE(pending, 2) << stages(closer);
}

/// The map knows the two by `sigma`, over `way`, and is `off` from the truth.
KnownMotions certain_map(const SE3& off, double sigma, double path,
                         const std::function<SE3(std::int64_t)>& T_world) {
  KnownMotions known;
  known.odometry = [=](KeyframeId a, KeyframeId b) {
    return TrackedMotion{T_world(a.value()).inverse() * T_world(b.value()), 1000};
  };
  known.map = [=](KeyframeId a, KeyframeId b) {
    PredictedMotion motion{Sim3(T_world(a.value()).inverse() * T_world(b.value()) * off)};
    motion.covariance.diagonal().head<6>().setConstant(sigma * sigma);
    motion.path_length = path;
    return motion;
  };
  return known;
}

TEST_F(LoopCloserOnAStreet, RefusesALoopThatACertainMapContradicts) {
  const auto found = [&](const SE3& off, double sigma, double path) {
    const auto known =
        certain_map(off, sigma, path, [](std::int64_t k) { return T_world(static_cast<int>(k)); });
    LoopCloser closer(small_options(), monocular(), 1);
    std::size_t loops = 0;
    for (int k = 0; k < kAll; ++k) {
      closer.add_view(KeyframeId(k), frame(k),
                      k == 0 || k == kFirst ? std::nullopt : std::optional(T_previous_this(k, 1)));
      loops += closer.find_loops(known, kDepth_m).size();
    }
    const bool refused =
        std::any_of(closer.records().begin(), closer.records().end(),
                    [](const LoopRecord& r) { return r.stage == LoopStage::kCovariance; });
    EXPECT_EQ(refused, loops == 0) << stages(closer);
    return loops;
  };
  const SE3 aside = pose({0, 0, 0}, {2, 0, 0});
  EXPECT_GE(found(SE3(), 0.01, 5), 2u);
  EXPECT_EQ(found(aside, 0.01, 5), 0u);
  EXPECT_GE(found(aside, 2, 5), 2u);       // the map is not so sure
  EXPECT_GE(found(aside, 0.01, 300), 2u);  // so much may have drifted unseen
}

TEST_F(LoopCloserOnAStreet, TellsTheRatioOfUnitsWhereTheyDiffer) {
  LoopCloser closer(small_options(), monocular(), 1);
  const auto loops = drive(closer, 2.5, std::nullopt, true);
  ASSERT_GE(loops.size(), 2u) << stages(closer);
  for (const Loop& loop : loops) {
    const SE3 truth = T_world(static_cast<int>(loop.match.value())).inverse() *
                      T_world(static_cast<int>(loop.query.value()));
    EXPECT_LT(distance_m(loop.T_match_query, truth), 0.15);
    EXPECT_NEAR(std::log(loop.scale_match_query), std::log(2.5), 0.08);
    EXPECT_GT(loop.information(6, 6), 0);
  }
}

TEST_F(LoopCloserOnAStreet, RefusesAnotherSizeWhereUnitsAreOne) {
  LoopCloser closer(small_options(), monocular(), 1);
  EXPECT_TRUE(drive(closer, 2.5, std::nullopt, false).empty());
}

TEST_F(LoopCloserOnAStreet, RelocalizesAFrameAtAKnownKeyframe) {
  LoopCloser closer(small_options(), monocular(), 1);
  EXPECT_FALSE(closer.relocalize(frame(kFirst)));
  for (int k = 0; k < kFirst; ++k)
    closer.add_view(KeyframeId(k), frame(k),
                    k ? std::optional(T_previous_this(k, 1)) : std::nullopt);
  const auto found = closer.relocalize(frame(kFirst + 1));
  ASSERT_TRUE(found);
  const SE3 truth = T_world(static_cast<int>(found->match.value())).inverse() * T_world(kFirst + 1);
  EXPECT_LT(distance_m(found->T_match_query, truth), 0.1);
}

TEST_F(LoopCloserOnAStreet, KnowsTheKeyframesOfAMapThatItIsGiven) {
  LoopCloser driven(small_options(), monocular(), 1);
  for (int k = 0; k < kFirst; ++k)
    driven.add_view(KeyframeId(k), frame(k),
                    k ? std::optional(T_previous_this(k, 1)) : std::nullopt);
  Map map;
  for (const LoopCloser::View& view : driven.views()) {
    Keyframe keyframe;
    keyframe.id = view.keyframe;
    keyframe.frame = view.frame;
    keyframe.features = view.features;
    map.keyframes.push_back(keyframe);
  }
  const LoopCloser memory(small_options(), monocular(), 1, map);
  EXPECT_EQ(memory.views().size(), driven.views().size());
  const auto found = memory.relocalize(frame(kFirst + 1), 0),
             same = driven.relocalize(frame(kFirst + 1), 0);
  ASSERT_TRUE(found && same);
  EXPECT_EQ(found->match, same->match);
  EXPECT_EQ(distance_m(found->T_match_query, same->T_match_query), 0);
  EXPECT_FALSE(LoopCloser(small_options(), monocular(), 1, Map()).relocalize(frame(0), 0));
}

TEST_F(LoopCloserOnAStreet, GrowsDepthsWithTheUnit) {
  LoopCloser closer(small_options(), monocular(), 1);
  for (int k = 0; k < 2; ++k)
    closer.add_view(KeyframeId(k), frame(k),
                    k ? std::optional(T_previous_this(k, 1)) : std::nullopt);
  std::vector<std::optional<Eigen::Vector3f>> before;
  for (const Feature& feature : closer.views()[1].features) before.push_back(feature.point_cam);
  closer.rescale(2, KeyframeId(1));
  int seen = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!before[i]) continue;
    EXPECT_LT((*closer.views()[1].features[i].point_cam - 2 * *before[i]).norm(), 1e-4);
    ++seen;
  }
  EXPECT_GT(seen, 20);
}

TEST_F(LoopCloserOnAStreet, GrowsTheMotionOfLoopsToViewsOfTheUnitThatGrows) {
  Map map;
  for (int k = 0; k < 8; ++k) {
    Keyframe keyframe;
    keyframe.id = KeyframeId(3 * k + 1);
    keyframe.frame = FrameId(10 * k);
    map.keyframes.push_back(keyframe);
  }
  for (const int match : {0, 20, 30, 70, 35}) {  // the last is no keyframe
    LoopRecord record;
    record.query_frame = FrameId(70);
    record.match_frame = FrameId(match);
    record.T_match_query = SE3(SO3(), Eigen::Vector3d(1, 2, 3));
    map.loops.push_back(record);
  }
  LoopCloser closer(small_options(), monocular(), 1, map);
  closer.rescale(2, KeyframeId(8));  // between the ids 7 (frame 20) and 10 (frame 30)
  for (const LoopRecord& record : closer.records()) {
    const int match = static_cast<int>(record.match_frame.value());
    const double factor = match == 30 || match == 70 ? 2 : 1;
    EXPECT_EQ(record.T_match_query.translation(), factor * Eigen::Vector3d(1, 2, 3)) << match;
  }
}

}  // namespace loop_closer_test
}  // namespace placegraph
