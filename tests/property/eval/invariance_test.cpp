#include <gtest/gtest.h>
#include <placegraph/eval/trajectory/evaluate.h>

#include <functional>

#include "tests/support/trajectories.h"

namespace placegraph {
namespace invariance_test {

using test::isometry;

constexpr int kTrials = 20;
// Doubles at coordinates of up to 1e3 m: 1e-13 m each, times some hundred operations.
constexpr double kRounding = 1e-8;

Eigen::Isometry3d random_motion(Random& random) {
  Eigen::Vector3d w, t;
  for (int i = 0; i < 3; ++i) {
    w[i] = random.uniform(-1.7, 1.7);
    t[i] = random.uniform(-500, 500);
  }
  return isometry(w, t);
}

Trajectory moved(Trajectory trajectory, const Eigen::Isometry3d& T_new_old, double scale = 1) {
  for (StampedPose& pose : trajectory.poses) {
    pose.T_world_body->translation() *= scale;
    pose.T_world_body = T_new_old * *pose.T_world_body;
  }
  return trajectory;
}

EvaluationResult judge(const Trajectory& truth, const Trajectory& estimate, Alignment alignment) {
  EvaluationOptions options;
  options.alignment = alignment;
  options.segments.lengths_m = {10, 25, 60};
  options.segments.step = 3;
  return evaluate(truth, estimate, options);
}

void expect_same(const EvaluationResult& a, const EvaluationResult& b, bool absolute = true) {
  ASSERT_TRUE(a.outcome);
  ASSERT_TRUE(b.outcome);
  if (absolute) {
    EXPECT_NEAR(a.ape.error_m.rmse, b.ape.error_m.rmse, kRounding);
  }
  EXPECT_NEAR(a.segments.t_rel_percent, b.segments.t_rel_percent, kRounding * 100);
  // acos of a trace loses half the digits near zero.
  EXPECT_NEAR(a.segments.r_rel_deg_per_100m, b.segments.r_rel_deg_per_100m, 1e-4);
  EXPECT_NEAR(a.rpe.translation_m.rmse, b.rpe.translation_m.rmse, kRounding);
  EXPECT_NEAR(a.rpe.rotation_deg.rmse, b.rpe.rotation_deg.rmse, kRounding);
}

class Invariance : public ::testing::Test {
 protected:
  void for_random_drives(const std::function<void(const Trajectory&, const Trajectory&)>& body) {
    for (int trial = 0; trial < kTrials; ++trial) {
      SCOPED_TRACE("seed 11, stream " + std::to_string(trial));
      random = Random(11, static_cast<std::uint64_t>(trial));
      const Trajectory truth = test::winding_drive(150 + random.index(50));
      body(truth, test::drifting(truth, 0.03, 0.003, random));
    }
  }
  Random random{11};
};

TEST_F(Invariance, RigidMotionOfEitherTrajectoryChangesNoFigureOnceAligned) {
  for_random_drives([this](const Trajectory& truth, const Trajectory& estimate) {
    for (const Alignment alignment :
         {Alignment::kOrigin, Alignment::kSe3, Alignment::kSim3, Alignment::kScale}) {
      SCOPED_TRACE(to_string(alignment));
      const EvaluationResult base = judge(truth, estimate, alignment);
      expect_same(base, judge(truth, moved(estimate, random_motion(random)), alignment));
      expect_same(base, judge(moved(truth, random_motion(random)), estimate, alignment));
    }
  });
}

TEST_F(Invariance, ScalingTheEstimateChangesNoFigureOnceTheScaleIsFitted) {
  for_random_drives([this](const Trajectory& truth, const Trajectory& estimate) {
    for (const Alignment alignment : {Alignment::kSim3, Alignment::kScale}) {
      const double scale = random.uniform(0.1, 10);
      const EvaluationResult base = judge(truth, estimate, alignment);
      const EvaluationResult scaled =
          judge(truth, moved(estimate, random_motion(random), scale), alignment);
      expect_same(base, scaled);
      EXPECT_NEAR(scaled.alignment.scale * scale, base.alignment.scale, kRounding);
    }
  });
}

TEST_F(Invariance, RelativeFiguresDoNotDependOnARigidAlignment) {
  for_random_drives([](const Trajectory& truth, const Trajectory& estimate) {
    const EvaluationResult base = judge(truth, estimate, Alignment::kNone);
    expect_same(base, judge(truth, estimate, Alignment::kOrigin), false);
    expect_same(base, judge(truth, estimate, Alignment::kSe3), false);
  });
}

TEST_F(Invariance, EveryFittedFreedomLowersTheError) {
  for_random_drives([](const Trajectory& truth, const Trajectory& estimate) {
    const double origin = judge(truth, estimate, Alignment::kOrigin).ape.error_m.rmse;
    const double se3 = judge(truth, estimate, Alignment::kSe3).ape.error_m.rmse;
    EXPECT_LE(se3, origin + kRounding);
    EXPECT_LE(judge(truth, estimate, Alignment::kSim3).ape.error_m.rmse, se3 + kRounding);
    EXPECT_LE(judge(truth, estimate, Alignment::kScale).ape.error_m.rmse, origin + kRounding);
  });
}

TEST_F(Invariance, NoRigidMotionFitsBetterThanTheAlignment) {
  for_random_drives([this](const Trajectory& truth, const Trajectory& estimate) {
    const EvaluationResult best = judge(truth, estimate, Alignment::kSe3);
    Trajectory aligned = estimate;
    for (StampedPose& pose : aligned.poses)
      pose.T_world_body = best.alignment.apply(*pose.T_world_body);
    for (int k = 0; k < 5; ++k) {
      Eigen::Vector3d w, t;
      for (int i = 0; i < 3; ++i) {
        w[i] = random.normal(0, 1e-3);
        t[i] = random.normal(0, 1e-2);
      }
      EXPECT_GE(judge(truth, moved(aligned, isometry(w, t)), Alignment::kNone).ape.error_m.rmse,
                best.ape.error_m.rmse - kRounding);
    }
  });
}

TEST_F(Invariance, AssociationByTimeOfTheSameStampsEqualsThatByIndex) {
  for_random_drives([](const Trajectory& truth, const Trajectory& estimate) {
    EvaluationOptions by_time, by_index;
    by_time.association = Association::kTime;
    by_index.association = Association::kIndex;
    by_time.segments.lengths_m = by_index.segments.lengths_m = {10, 25};
    expect_same(evaluate(truth, estimate, by_time), evaluate(truth, estimate, by_index));
  });
}

TEST_F(Invariance, OdometryThatOnlyDriftsRaisesNoWarning) {
  for_random_drives([](const Trajectory& truth, const Trajectory& estimate) {
    const EvaluationResult r = judge(truth, estimate, Alignment::kOrigin);
    EXPECT_TRUE(r.warnings.empty()) << r.warnings.front();
  });
}

}  // namespace invariance_test
}  // namespace placegraph
