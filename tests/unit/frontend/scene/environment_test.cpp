#include <gtest/gtest.h>
#include <placegraph/frontend/scene/environment.h>
#include <placegraph/frontend/scene/scene_masks.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/line_segment.h>

#include <cmath>

#include "tests/support/message_of.h"

namespace placegraph {
namespace environment_test {

using Shares = std::array<double, kEnvironmentCount>;

double value(const EnvironmentEvidence& evidence, const std::string& name) {
  for (std::size_t i = 0; i < kEvidenceCount; ++i)
    if (evidence_names()[i] == name) return evidence.values[i];
  ADD_FAILURE() << name;
  return 0;
}

/// Streets are open to the sky, corridors are not; both are noisy.
std::vector<EnvironmentSample> streets_and_corridors(int each) {
  Random random(7);
  std::vector<EnvironmentSample> samples;
  for (int i = 0; i < 2 * each; ++i) {
    EnvironmentSample sample;
    const bool street = i % 2 == 0;
    sample.kind = street ? Environment::kStreet : Environment::kCorridor;
    SurfaceShares shares;
    shares.above[0] = (street ? 0.5 : 0.1) + random.normal(0, 0.1);
    sample.evidence.see(shares);
    std::vector<Eigen::Vector3d> points;
    for (int k = 0; k < 50; ++k)
      points.emplace_back(random.uniform(-1, 1) * (street ? 8 : 1), random.uniform(-1, 1),
                          random.uniform(2, street ? 40 : 8));
    sample.evidence.see(points, true);
    samples.push_back(sample);
  }
  return samples;
}

TEST(EnvironmentEvidence, MeasuresPointsInMetresOnlyWhereTheUnitIsKnown) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 40; ++i) points.emplace_back(i % 2 ? 2.0 : -2.0, -1, 10);
  EnvironmentEvidence metric, unitless, few;
  metric.see(points, true);
  EXPECT_NEAR(value(metric, "depth"), 1, 1e-12);
  EXPECT_NEAR(value(metric, "side"), std::log10(2.0), 1e-12);
  EXPECT_NEAR(value(metric, "above"), 0, 1e-12);
  EXPECT_NEAR(value(metric, "tall"), 0.1, 1e-12);
  EXPECT_NEAR(value(metric, "spread"), 0, 1e-12);
  unitless.see(points, false);
  EXPECT_NEAR(value(unitless, "tall"), 0.1, 1e-12);
  EXPECT_TRUE(std::isnan(value(unitless, "depth")));
  points.resize(10);
  few.see(points, true);
  EXPECT_TRUE(std::isnan(value(few, "tall")));
}

TEST(EnvironmentEvidence, TellsUprightEdgesFromLevelOnes) {
  Camera camera;
  camera.width = 320, camera.height = 240;
  camera.fx = camera.fy = 300, camera.cx = 160, camera.cy = 120;
  std::vector<LineSegment> segments;
  for (int i = 0; i < 9; ++i) segments.push_back({{20.0 * i, 10}, {20.0 * i, 70}});
  for (int i = 0; i < 3; ++i) segments.push_back({{100, 30.0 * i}, {160, 30.0 * i}});
  EnvironmentEvidence evidence;
  evidence.see(segments, camera);
  EXPECT_NEAR(value(evidence, "upright"), 0.75, 1e-12);
  EXPECT_NEAR(value(evidence, "level"), 0.25, 1e-12);
}

TEST(EnvironmentModel, LearnsKindsAndManagesWithoutPointsOrPicture) {
  const auto samples = streets_and_corridors(60);
  const EnvironmentModel model = train_environments(samples);
  int right = 0, without_points = 0;
  for (EnvironmentSample sample : samples) {
    const auto kind = static_cast<std::size_t>(sample.kind);
    right += model.probabilities(sample.evidence)[kind] > 0.5;
    for (const char* name : {"spread", "tall", "depth", "side", "above"})
      for (std::size_t i = 0; i < kEvidenceCount; ++i)
        if (std::string(evidence_names()[i]) == name) sample.evidence.values[i] = NAN;
    without_points += model.probabilities(sample.evidence)[kind] > 0.5;
  }
  EXPECT_GT(right, 116);           // of 120
  EXPECT_GT(without_points, 110);  // two deviations lie between the means
  const Shares unseen = model.probabilities(samples[0].evidence);
  EXPECT_LT(unseen[static_cast<std::size_t>(Environment::kHall)], 1e-3);  // never shown
  EXPECT_THROW(train_environments({samples[0], samples[2]}), ArgumentError);
}

TEST(EnvironmentModel, WithoutEvidenceKnowsOnlyWhatItIsBiasedTo) {
  EnvironmentModel model;
  for (const double p : model.probabilities({})) EXPECT_NEAR(p, 0.2, 1e-12);
}

TEST(EnvironmentModel, ReadsWhatItWritesAndNamesTheLineThatIsWrong) {
  const EnvironmentModel model = train_environments(streets_and_corridors(20));
  const EnvironmentModel read = parse_environments(to_text(model), "model.txt");
  const EnvironmentEvidence evidence = streets_and_corridors(1)[0].evidence;
  const Shares a = model.probabilities(evidence), b = read.probabilities(evidence);
  for (std::size_t k = 0; k < kEnvironmentCount; ++k) EXPECT_NEAR(a[k], b[k], 1e-2);
  const auto refused = [](const std::string& text) {
    return test::message_of([&] { (void)parse_environments(text, "model.txt"); });
  };
  EXPECT_NE(refused("environment 3\n").find("model.txt:1"), std::string::npos);
  EXPECT_NE(refused("# words\nbias 1 2 3\n").find("model.txt:2"), std::string::npos);
  EXPECT_NE(refused("bias 0 0 0 0 0\n").find("missing"), std::string::npos);
}

TEST(EnvironmentModel, ThatComesAlongCanBeRead) {
  const Shares p = built_in_environments().probabilities({});
  double sum = 0;
  for (const double share : p) sum += share;
  EXPECT_NEAR(sum, 1, 1e-9);
}

TEST(EnvironmentFilter, IsSlowToChangeItsMindAndDoesSoForGoodReason) {
  const Shares street{0.8, 0.05, 0.05, 0.05, 0.05}, corridor{0.05, 0.05, 0.8, 0.05, 0.05};
  EnvironmentFilter filter{EnvironmentFilterOptions{}};
  EXPECT_FALSE(filter.add(street));  // one view says nothing yet
  for (int i = 0; i < 8; ++i) filter.add(street);
  ASSERT_EQ(filter.kind(), Environment::kStreet);
  filter.add(corridor);
  EXPECT_EQ(filter.kind(), Environment::kStreet);  // an odd view among many
  for (int i = 0; i < 8; ++i) filter.add(corridor);
  EXPECT_EQ(filter.kind(), Environment::kCorridor);
}

TEST(EnvironmentFilter, SaysUnknownWhereViewsSayNothing) {
  EnvironmentFilter filter{EnvironmentFilterOptions{}};
  for (int i = 0; i < 50; ++i) EXPECT_FALSE(filter.add({0.2, 0.2, 0.2, 0.2, 0.2}));
  EnvironmentFilterOptions wrong;
  wrong.leave = 0.9;
  EXPECT_THROW(EnvironmentFilter{wrong}, ArgumentError);
}

}  // namespace environment_test
}  // namespace placegraph
