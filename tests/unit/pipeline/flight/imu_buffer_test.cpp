#include <gtest/gtest.h>
#include <placegraph/pipeline/flight/imu_buffer.h>

#include <cmath>

namespace placegraph {
namespace imu_buffer_test {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Code = Outcome::Code;

constexpr std::int64_t kMs_ns = 1'000'000;
constexpr double kRounding = 1e-12;
const SO3 kBodyCam = SO3::exp({2.0, -0.7, 0.4});

/// A sample every 10 ms from 0 to 200 ms, with rates rate(t) [rad/s] and forces (0, t, 9.8).
template <class Rate>
ImuBuffer filled(const Rate& rate, double gyro_noise = 0) {
  ImuBuffer buffer(kBodyCam, gyro_noise);
  for (int ms = 0; ms <= 200; ms += 10)
    EXPECT_TRUE(buffer.add({ms * kMs_ns, rate(1e-3 * ms), Vector3d(0, 1e-3 * ms, 9.8)}));
  return buffer;
}

/// Of the body, from what is told of the camera.
Vector3d body_rotation(const KnownRotation& camera) {
  return (kBodyCam * camera.R_1_2 * kBodyCam.inverse()).log();
}

TEST(ImuBuffer, IntegratesAConstantRateOverAnyTime) {
  const Vector3d rate(0.3, -0.5, 0.9);
  const ImuBuffer buffer = filled([&](double) { return rate; });
  for (const auto& [from_ms, to_ms] : {std::pair{0, 200}, {20, 70}, {13, 16}, {13, 158}}) {
    const KnownRotation found =
        buffer.camera_rotation(from_ms * kMs_ns, to_ms * kMs_ns, std::nullopt);
    const Vector3d expected = 1e-3 * (to_ms - from_ms) * rate;
    EXPECT_LT((body_rotation(found) - expected).norm(), kRounding) << from_ms << " " << to_ms;
  }
}

TEST(ImuBuffer, TakesRatesAsLinearBetweenSamples) {
  const Vector3d axis = Vector3d(1, 2, -2) / 3;
  const ImuBuffer buffer = filled([&](double t) { return Vector3d(5 * t * axis); });
  const KnownRotation found = buffer.camera_rotation(33 * kMs_ns, 142 * kMs_ns, std::nullopt);
  const Vector3d expected = 2.5 * (0.142 * 0.142 - 0.033 * 0.033) * axis;
  EXPECT_LT((body_rotation(found) - expected).norm(), kRounding);
}

TEST(ImuBuffer, TakesTheBiasOffAndAddsItsCovariance) {
  const Vector3d rate(0.3, -0.5, 0.9), bias(0.02, 0.03, -0.01);
  const double noise = 0.01, dt = 0.1;
  const ImuBuffer buffer = filled([&](double) { return rate; }, noise);
  BodyState state;
  state.gyro_bias = bias;
  state.covariance.diagonal() << 10, 20, 30, 40, 50, 60, 70, 80, 90, 1e-4, 2e-4, 3e-4, 15, 16, 17;
  const KnownRotation found = buffer.camera_rotation(0, 100 * kMs_ns, state);
  EXPECT_LT((body_rotation(found) - dt * (rate - bias)).norm(), kRounding);
  const Matrix3d covariance_body = noise * noise * dt * Matrix3d::Identity() +
                                   dt * dt * Matrix3d(Vector3d(1e-4, 2e-4, 3e-4).asDiagonal());
  const Matrix3d R = kBodyCam.matrix();
  EXPECT_LT((R * found.covariance * R.transpose() - covariance_body).norm(), kRounding);
  // Where no state is known, the rates are taken as they are.
  const KnownRotation raw = buffer.camera_rotation(0, 100 * kMs_ns, std::nullopt);
  EXPECT_LT((body_rotation(raw) - dt * rate).norm(), kRounding);
  EXPECT_LT((raw.covariance - noise * noise * dt * Matrix3d::Identity()).norm(), kRounding);
}

TEST(ImuBuffer, TimeThatNoSamplesEncloseIsWithoutRotation) {
  const Vector3d rate(0, 0, 1);
  const ImuBuffer buffer = filled([&](double) { return rate; });
  const KnownRotation found = buffer.camera_rotation(150 * kMs_ns, 300 * kMs_ns, std::nullopt);
  EXPECT_LT((body_rotation(found) - 0.05 * rate).norm(), kRounding);
  EXPECT_EQ(ImuBuffer(kBodyCam, 0.1).camera_rotation(0, kMs_ns, std::nullopt).R_1_2.log().norm(),
            0);
}

TEST(ImuBuffer, KeepsTheLastSampleAtOrBeforeTheImageThatIsPast) {
  ImuBuffer buffer = filled([](double) { return Vector3d(0, 0, 1); });
  buffer.forget_before(105 * kMs_ns);
  ASSERT_EQ(buffer.samples().size(), 11u);
  EXPECT_EQ(buffer.samples().front().stamp_ns, 100 * kMs_ns);
  buffer.forget_before(110 * kMs_ns);
  EXPECT_EQ(buffer.samples().front().stamp_ns, 110 * kMs_ns);
  buffer.forget_before(900 * kMs_ns);
  EXPECT_EQ(buffer.samples().size(), 1u);
}

TEST(ImuBuffer, MeanForceIsThatOfTheSamplesKept) {
  ImuBuffer buffer = filled([](double) { return Vector3d(0, 0, 0); });
  buffer.forget_before(100 * kMs_ns);
  ASSERT_TRUE(buffer.mean_force_body());
  EXPECT_LT((*buffer.mean_force_body() - Vector3d(0, 0.15, 9.8)).norm(), kRounding);
  EXPECT_FALSE(ImuBuffer(kBodyCam, 0.1).mean_force_body());
}

TEST(ImuBuffer, ReachesAsFarBeyondItsNewestSampleAsIsAllowed) {
  const ImuBuffer buffer = filled([](double) { return Vector3d(0, 0, 0); });
  EXPECT_TRUE(buffer.reaches(100 * kMs_ns, 0.25));
  EXPECT_TRUE(buffer.reaches(449 * kMs_ns, 0.25));
  EXPECT_FALSE(buffer.reaches(451 * kMs_ns, 0.25));
  EXPECT_FALSE(ImuBuffer(kBodyCam, 0.1).reaches(0, 0.25));
}

TEST(ImuBuffer, RefusesSamplesThatAreNotFiniteOrOutOfOrderAndDoesNotKeepThem) {
  ImuBuffer buffer(kBodyCam, 0.1);
  ASSERT_TRUE(buffer.add({kMs_ns, {0, 0, 0}, {0, 0, 9.8}}));
  EXPECT_EQ(buffer.add({kMs_ns, {0, 0, 0}, {0, 0, 9.8}}).code, Code::kInconsistent);
  EXPECT_EQ(buffer.add({2 * kMs_ns, {NAN, 0, 0}, {0, 0, 9.8}}).code, Code::kInconsistent);
  EXPECT_EQ(buffer.add({2 * kMs_ns, {0, 0, 0}, {0, INFINITY, 0}}).code, Code::kInconsistent);
  EXPECT_EQ(buffer.samples().size(), 1u);
}

}  // namespace imu_buffer_test
}  // namespace placegraph
