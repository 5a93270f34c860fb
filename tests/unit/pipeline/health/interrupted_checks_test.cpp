// Checks that go on from a saved state say what they would have said without an interruption.
#include <gtest/gtest.h>
#include <placegraph/pipeline/health/contradicted_steps.h>
#include <placegraph/pipeline/health/depth_unit_check.h>
#include <placegraph/pipeline/health/flow_check.h>
#include <placegraph/pipeline/health/image_quality.h>
#include <placegraph/pipeline/health/intrinsics_check.h>
#include <placegraph/pipeline/health/repeated_images.h>
#include <placegraph/pipeline/health/right_image_time.h>
#include <placegraph/pipeline/overlays/standing_patches.h>
#include <placegraph/pipeline/health/window_residuals.h>
#include <placegraph/pipeline/scale/scale_check.h>

#include <opencv2/core.hpp>

#include "tests/support/saved_state.h"
#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace interrupted_checks_test {

constexpr int kSteps = 40;

template <class Check>
std::string notes_of(const Check& check) {
  std::string text;
  const auto add = [&](const DataNote& note) { text += note.text + "; " + note.advice + "\n"; };
  if constexpr (requires { check.notes(); }) {
    for (const DataNote& note : check.notes()) add(note);
  } else if (const auto note = check.note()) {
    add(*note);
  }
  return text;
}

/// Adds the same to two checks, and replaces one of them at a random step by one that takes its
/// state. Both must say the same at every step. Returns what they say in the end.
template <class Check, class Add>
std::string said_by(Random& random, const Check& fresh, const Add& add) {
  Check whole = fresh, interrupted = fresh;
  const int end = random.index(kSteps);
  for (int i = 0; i < kSteps; ++i) {
    Random same = random;
    add(whole, i, random);
    add(interrupted, i, same);
    if (i == end) interrupted = test::resumed(interrupted, fresh);
    EXPECT_EQ(notes_of(whole), notes_of(interrupted)) << "step " << i << ", interrupted at " << end;
  }
  return notes_of(whole);
}

Calibration stereo() {
  Calibration calibration;
  calibration.camera = test::pinhole(160, 120, 100);
  calibration.baseline_m = 0.5;
  return calibration;
}

ImageStatistics poor_image(Random& random) {
  ImageStatistics statistics;
  statistics.mean = random.uniform(10, 250);
  statistics.range = random.uniform(0, 200);
  statistics.white = random.uniform();
  statistics.uniform = random.uniform();
  statistics.detail = random.uniform();
  return statistics;
}

RightCameraOffset late_offset(Random& random) {
  return {{0.1 * random.uniform(), -0.8}, 1e4 * Eigen::Matrix2d::Identity()};
}

IntrinsicsEvidence wrong_intrinsics(Random& random) {
  IntrinsicsEvidence evidence;
  evidence.information = 1e6 * IntrinsicsEvidence::Matrix::Identity();
  evidence.gradient.setConstant(-1e4 * random.uniform());
  evidence.residuals = 100;
  return evidence;
}

TEST(InterruptedChecks, SayWhatTheyWouldHaveSaidWithoutTheInterruption) {
  Random random = test::seeded_random(3);
  std::string said;
  for (int round = 0; round < 20; ++round) {
    said += said_by(
        random, ImageQuality("images", NoteCause::kImages),
        [](ImageQuality& check, int i, Random& r) { check.add(FrameId(i), poor_image(r)); });
    said += said_by(random, ContradictedSteps(), [](ContradictedSteps& check, int i, Random& r) {
      check.add(FrameId(i), r.uniform() < 0.7);
    });
    said += said_by(random, ScaleCheck(), [](ScaleCheck& check, int i, Random& r) {
      check.add(FrameId(i), r.uniform());
    });
    said += said_by(random, FlowCheck(stereo()),
                    [](FlowCheck& check, int i, Random& r) { check.add(FrameId(i), r.uniform()); });
    said += said_by(random, RightImageTime(stereo()), [](RightImageTime& check, int, Random& r) {
      check.add(late_offset(r), {0, 0, 0.4});
    });
    said += said_by(random, IntrinsicsCheck(stereo()),
                    [](IntrinsicsCheck& check, int, Random& r) { check.add(wrong_intrinsics(r)); });
    said += said_by(random, ResidualCheck(stereo()), [](ResidualCheck& check, int, Random& r) {
      check.add(WindowResiduals{1000, r.index(200), 1000, r.index(200)});
    });
    said += said_by(random, DepthUnitCheck(), [](DepthUnitCheck& check, int, Random& r) {
      Frame frame;
      frame.depth = Image(120, 160, CV_32FC1, cv::Scalar(20 * r.uniform()));
      check.add(frame);
    });
  }
  for (const char* what : {"images", "rotations", "scale", "motion of the camera", "baselines"})
    EXPECT_NE(said.find(what), std::string::npos) << what;
}

// What stood still before the interruption is suspected after it.
TEST(InterruptedChecks, PatchesThatStandAreRemembered) {
  Random random = test::seeded_random(4);
  const Camera camera = stereo().camera;
  StandingPatches whole(camera), interrupted(camera);
  for (int i = 0; i < kSteps; ++i) {
    Image image(camera.height, camera.width, CV_8UC1);
    for (int v = 0; v < image.rows; ++v)
      for (int u = 0; u < image.cols; ++u) {
        const int moved = u < 80 ? u : u + 5 * i;  // the left half stands still
        image.at<std::uint8_t>(v, u) =
            static_cast<std::uint8_t>((moved / 4 * 71 + v / 4 * 37) * 13);
      }
    whole.compare(image, {});
    interrupted.compare(image, {});
    if (random.uniform() < 0.3) interrupted = test::resumed(interrupted, StandingPatches(camera));
    EXPECT_EQ(whole.suspects(), interrupted.suspects()) << i;
    EXPECT_EQ(cv::norm(whole.elsewhere(), interrupted.elsewhere(), cv::NORM_INF), 0) << i;
  }
  EXPECT_TRUE(whole.suspects());
}

TEST(InterruptedChecks, AnImageThatRepeatsTheLastOneBeforeIsCounted) {
  Frame frame;
  frame.image = Image(16, 16, CV_8UC1, cv::Scalar(9));
  RepeatedImages check;
  check.go_on_after(frame);
  for (int i = 0; i < 3; ++i) check.add(frame);
  EXPECT_TRUE(check.note());
}

}  // namespace interrupted_checks_test
}  // namespace placegraph
