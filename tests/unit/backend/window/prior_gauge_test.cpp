#include <gtest/gtest.h>
#include <placegraph/backend/window/prior_gauge.h>
#include <placegraph/graph/core/random.h>

#include <Eigen/Dense>

#include "tests/support/ids.h"

namespace placegraph {
namespace prior_gauge_test {

Eigen::MatrixXd random_matrix(Random& random, Eigen::Index rows, Eigen::Index cols) {
  Eigen::MatrixXd m(rows, cols);
  for (Eigen::Index i = 0; i < m.size(); ++i) m.data()[i] = random.normal();
  return m;
}

/// Two keyframes, a plane and a world, of full rank.
MarginalPrior full_prior() {
  Random random(71);
  MarginalPrior prior;
  prior.keyframes = test::ids<KeyframeId>({3, 4});
  prior.T_map_cam_lin = {SE3(SO3::exp({0.1, 0.2, 0.3}), Eigen::Vector3d(1, 2, 3)),
                         SE3(SO3::exp({0.2, 0.1, 0.1}), Eigen::Vector3d(1, 2, 5))};
  prior.planes = {PlaneId(7)};
  prior.plane_lin = {Plane3({0, 1, 0.2}, 1.5)};
  prior.manhattan_frames = {ManhattanFrameId(9)};
  prior.R_map_manhattan_lin = {SO3::exp({-0.2, 0.1, 0})};
  prior.J = random_matrix(random, 18, 18);
  prior.e = random_matrix(random, 18, 1);
  return prior;
}

/// Relative motion of the two keyframes alone.
MarginalPrior floating_prior() {
  MarginalPrior prior = full_prior();
  prior.planes.clear(), prior.plane_lin.clear();
  prior.manhattan_frames.clear(), prior.R_map_manhattan_lin.clear();
  const SE3 T_from_to = prior.T_map_cam_lin[0].inverse() * prior.T_map_cam_lin[1];
  prior.J.resize(6, 12);
  prior.J << -T_from_to.inverse().adjoint(), Matrix6d::Identity();
  prior.e = Eigen::VectorXd::Constant(6, 0.1);
  return prior;
}

/// H and b of a prior with `columns` integrated out.
std::pair<Eigen::MatrixXd, Eigen::VectorXd> without(const MarginalPrior& prior, Eigen::Index begin,
                                                    Eigen::Index size) {
  std::vector<Eigen::Index> gone, rest;
  for (Eigen::Index i = 0; i < prior.J.cols(); ++i)
    (i >= begin && i < begin + size ? gone : rest).push_back(i);
  const Eigen::MatrixXd H = prior.J.transpose() * prior.J;
  const Eigen::VectorXd b = prior.J.transpose() * prior.e;
  const Eigen::MatrixXd H_inverse = H(gone, gone).inverse();
  return {H(rest, rest) - H(rest, gone) * H_inverse * H(gone, rest),
          b(rest) - H(rest, gone) * H_inverse * b(gone)};
}

TEST(PriorGauge, HoldsTheWindowInTheMapIfItResistsEveryCommonMotion) {
  EXPECT_TRUE(holds_pose(full_prior()));
  EXPECT_FALSE(holds_pose(floating_prior())) << "what is relative resists none";
  EXPECT_FALSE(holds_pose(MarginalPrior()));
  MarginalPrior almost = full_prior();
  almost.J = almost.J.topRows(5).eval();
  EXPECT_FALSE(holds_pose(almost)) << "five rows resist five directions";
}

TEST(PriorGauge, HoldsTheUnitIfItResistsGrowth) {
  const Eigen::Vector3d center(1, 2, 3);
  EXPECT_TRUE(holds_scale(floating_prior(), center)) << "the length of the motion is measured";
  MarginalPrior rotating = floating_prior();
  rotating.J = rotating.J.bottomRows(3).eval();
  EXPECT_FALSE(holds_scale(rotating, center)) << "a rotation has no unit";
  EXPECT_FALSE(holds_scale(MarginalPrior(), center));
}

TEST(PriorGauge, ForgetsTheUnitByTheDeviationThatIsAsked) {
  // With the scale as one more unknown of that deviation, integrated out: I + sigma^2 s s^T.
  const Eigen::Vector3d center(1, 2, 3);
  MarginalPrior prior = floating_prior();
  const Eigen::Vector3d growth =
      prior.T_map_cam_lin[1].rotation().inverse() * (prior.T_map_cam_lin[1].translation() - center);
  const Eigen::VectorXd s = prior.keyframe_columns(1).leftCols<3>() * growth;
  const double sigma = 0.3;
  const Eigen::MatrixXd covariance =
      Eigen::MatrixXd::Identity(6, 6) + sigma * sigma * s * s.transpose();
  const Eigen::MatrixXd expected = prior.J.transpose() * covariance.inverse() * prior.J;
  const Eigen::VectorXd b = prior.J.transpose() * covariance.inverse() * prior.e;
  relax_scale(prior, center, sigma);
  EXPECT_LT((prior.J.transpose() * prior.J - expected).norm(), 1e-12 * expected.norm());
  EXPECT_LT((prior.J.transpose() * prior.e - b).norm(), 1e-12);
}

TEST(PriorGauge, RelativeToItsFirstKeyframeNoLongerResistsCommonMotions) {
  // The first keyframe held, all of it may be moved together: the columns of that motion are
  // integrated out.
  MarginalPrior prior = full_prior();
  const SE3 T_first = prior.T_map_cam_lin[0];
  const SE3 T_second_first = prior.T_map_cam_lin[1].inverse() * T_first;
  Eigen::Matrix<double, 3, 6> J_plane;
  transform_to(SE3(), prior.plane_lin[0], &J_plane);
  MarginalPrior common = prior;
  common.J.leftCols<6>() = prior.keyframe_columns(0) +
                           prior.keyframe_columns(1) * T_second_first.adjoint() -
                           prior.plane_columns(0) * J_plane * T_first.adjoint();
  common.J.middleCols<3>(3) +=
      prior.manhattan_columns(0) *
      (prior.R_map_manhattan_lin[0].inverse() * T_first.rotation()).matrix();
  const auto [H, b] = without(common, 0, 6);
  hold_first(prior);
  EXPECT_EQ(prior.keyframes, test::ids<KeyframeId>({4}));
  EXPECT_EQ(prior.T_map_cam_lin.size(), 1u);
  EXPECT_LT((prior.J.transpose() * prior.J - H).norm(), 1e-9 * H.norm());
  EXPECT_LT((prior.J.transpose() * prior.e - b).norm(), 1e-9 * b.norm());
}

TEST(PriorGauge, AForgottenPlaneIsIntegratedOut) {
  MarginalPrior prior = full_prior();
  const auto [H, b] = without(prior, 12, 3);
  forget_plane(prior, 0);
  EXPECT_TRUE(prior.planes.empty());
  EXPECT_EQ(prior.J.cols(), 15);
  EXPECT_LT((prior.J.transpose() * prior.J - H).norm(), 1e-9 * H.norm());
  EXPECT_LT((prior.J.transpose() * prior.e - b).norm(), 1e-9 * b.norm());
}

}  // namespace prior_gauge_test
}  // namespace placegraph
