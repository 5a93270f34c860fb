#include <gtest/gtest.h>
#include <placegraph/backend/factors/absolute_rotation.h>
#include <placegraph/backend/factors/bearing.h>
#include <placegraph/backend/factors/distance.h>
#include <placegraph/backend/factors/height_above_plane.h>
#include <placegraph/backend/factors/line_reprojection.h>
#include <placegraph/backend/factors/linear_prior.h>
#include <placegraph/backend/factors/marker_corners.h>
#include <placegraph/backend/factors/non_holonomic.h>
#include <placegraph/backend/factors/plane_observation.h>
#include <placegraph/backend/factors/plane_orthogonal.h>
#include <placegraph/backend/factors/plane_parallel.h>
#include <placegraph/backend/factors/point_in_node.h>
#include <placegraph/backend/factors/point_observation.h>
#include <placegraph/backend/factors/point_on_plane.h>
#include <placegraph/backend/factors/pose_prior.h>
#include <placegraph/backend/factors/position.h>
#include <placegraph/backend/factors/relative_pose.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <memory>
#include <typeinfo>

#include "tests/support/factor_check.h"

namespace placegraph {
namespace factor_laws_test {

/// For messages: the type of a factor.
const char* name_of(const Factor& factor) { return typeid(factor).name(); }

using Factors = std::vector<std::shared_ptr<const Factor>>;

Eigen::Vector3d random_vector(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

SE3 random_pose(Random& random) {
  return SE3(SO3::exp(random_vector(random, 0.3)), random_vector(random, 1));
}

Eigen::MatrixXd whitening_of(Eigen::Index size) {
  Eigen::MatrixXd W = Eigen::MatrixXd::Identity(size, size) * 2;
  for (Eigen::Index i = 1; i < size; ++i) W(i - 1, i) = 0.3 * static_cast<double>(i);
  return W;
}

Camera camera() {
  Camera camera;
  camera.fx = 500, camera.fy = 480, camera.cx = 320, camera.cy = 240;
  return camera;
}

/// Those that can be told in another scale, see Factor::transformed; their measurements do not say
/// where the world is, but for the pose prior.
Factors transformable() {
  Random random(1);
  return {std::make_shared<DistanceFactor>(1.5, 0.1),
          std::make_shared<AbsoluteRotationFactor>(SO3::exp({0.2, 0.3, -0.4}), whitening_of(3)),
          std::make_shared<PlaneOrthogonalFactor>(0.1),
          std::make_shared<PlaneParallelFactor>(0.1),
          std::make_shared<HeightAbovePlaneFactor>(1.65, 0.1),
          std::make_shared<RelativePoseFactor<SE3>>(random_pose(random), whitening_of(6)),
          std::make_shared<RelativePoseFactor<SE3>>(random_pose(random), whitening_of(6),
                                                    RotationError::kQuaternion),
          std::make_shared<PosePriorFactor<SE3>>(random_pose(random), whitening_of(6))};
}

/// Those that are always told in the scale of their measurement.
Factors others() {
  const Eigen::Vector2d px(300, 200);
  return {std::make_shared<BearingFactor>(Eigen::Vector3d(0.3, 0.2, 1), whitening_of(3)),
          std::make_shared<NonHolonomicFactor>(Eigen::Vector3d(1, 0.1, 0),
                                               Eigen::Vector3d(0.3, 1, -2), 0.05),
          std::make_shared<PointInNodeFactor<SE3>>(Eigen::Vector3d(1, 2, 7), whitening_of(3)),
          std::make_shared<PointObservationFactor<Reprojection>>(Reprojection(camera(), px, 0.7)),
          std::make_shared<PointObservationFactor<InverseDepth>>(InverseDepth(0.1, 0.01)),
          std::make_shared<PointOnPlaneFactor>(0.2),
          std::make_shared<LineReprojectionFactor>(camera(), px, Eigen::Vector2d(500, 180), 0.7),
          std::make_shared<MarkerCornersFactor>(camera(),
                                                MarkerCornersFactor::Corners{px, px, px, px}, 0.7)};
}

/// Poses near the origin that look along z, and things in front of them.
std::vector<Variable> variables_of(const Factor& factor, Random& random) {
  std::vector<Variable> variables;
  for (const std::size_t kind : factor.variable_kinds()) {
    const Eigen::Vector3d ahead = Eigen::Vector3d(0, 0, 8) + random_vector(random, 2);
    const Eigen::Vector3d direction = Eigen::Vector3d(1, 1, 0.2) + random_vector(random, 0.5);
    const SE3 pose = random_pose(random);
    if (kind == Variable(SE3()).index())
      variables.emplace_back(pose);
    else if (kind == Variable(SO3()).index())
      variables.emplace_back(pose.rotation());
    else if (kind == Variable(Plane3()).index())
      variables.emplace_back(Plane3(direction, random.uniform(1, 4)));
    else if (kind == Variable(Line3()).index())
      variables.emplace_back(Line3::from_direction(ahead, direction));
    else if (kind == Variable(Marker()).index())
      variables.emplace_back(Marker{SE3(pose.rotation(), ahead), 0.5});
    else
      variables.emplace_back(ahead);
  }
  return variables;
}

Variable transformed(const Sim3& S_new_old, const Variable& x) {
  const SO3& R = S_new_old.rotation();
  const auto pose = [&](const SE3& T) {
    return SE3(R * T.rotation(), S_new_old * T.translation());
  };
  if (const auto* T = std::get_if<SE3>(&x)) return pose(*T);
  if (const auto* rotation = std::get_if<SO3>(&x)) return R * *rotation;
  if (const auto* p = std::get_if<Eigen::Vector3d>(&x)) return Eigen::Vector3d(S_new_old * *p);
  if (const auto* line = std::get_if<Line3>(&x))
    return Line3::from_direction(S_new_old * line->nearest_point(), R * line->direction());
  if (const auto* marker = std::get_if<Marker>(&x))
    return Marker{pose(marker->T_world_marker), S_new_old.scale() * marker->size_m};
  const auto& plane = std::get<Plane3>(x);
  const Eigen::Vector3d n = R * plane.normal();
  return Plane3(n, S_new_old.scale() * plane.distance() + n.dot(S_new_old.translation()));
}

std::vector<Variable> transformed(const Sim3& S_new_old, std::vector<Variable> variables) {
  for (Variable& x : variables) x = transformed(S_new_old, x);
  return variables;
}

/// A plane and a line have no sign, so that neither has a residual that is made of one.
void expect_the_same(const Factor& factor, Eigen::VectorXd r, Eigen::VectorXd expected) {
  if (dynamic_cast<const PlaneParallelFactor*>(&factor)) {  // a vector in the world
    r = Eigen::VectorXd::Constant(1, r.norm());
    expected = Eigen::VectorXd::Constant(1, expected.norm());
  }
  const double off = std::min((r - expected).norm(), (r + expected).norm());
  EXPECT_LT(off, 1e-9 * (1 + expected.norm())) << typeid(factor).name();
}

TEST(FactorLaws, AllHaveTheJacobiansOfFiniteDifferencesAnywhere) {
  Random random(2);
  for (const Factors& factors : {transformable(), others()})
    for (const auto& factor : factors)
      for (int trial = 0; trial < 5; ++trial) {
        SCOPED_TRACE(name_of(*factor));
        test::expect_jacobians_match(*factor, variables_of(*factor, random), 1e-6);
      }
}

TEST(FactorLaws, TheResidualIsTheSameWithAndWithoutDerivatives) {
  Random random(3);
  for (const Factors& factors : {transformable(), others()})
    for (const auto& factor : factors) {
      const std::vector<Variable> variables = variables_of(*factor, random);
      std::vector<Eigen::MatrixXd> J;
      const Eigen::VectorXd r = test::evaluate(*factor, variables, &J);
      EXPECT_EQ(r.size(), factor->residual_size());
      EXPECT_LT((r - test::evaluate(*factor, variables)).norm(), 1e-12 * (1 + r.norm()))
          << name_of(*factor);
      for (const Eigen::MatrixXd& J_k : J) EXPECT_LT(J_k.cwiseAbs().maxCoeff(), 1e98);
    }
}

TEST(FactorLaws, MeasurementsBetweenVariablesDoNotSayWhereTheWorldIs) {
  Random random(4);
  Factors factors = others();
  for (const auto& factor : transformable())
    if (factor->variable_kinds().size() > 1) factors.push_back(factor);
  for (const auto& factor : factors)
    for (int trial = 0; trial < 5; ++trial) {
      const std::vector<Variable> variables = variables_of(*factor, random);
      const Sim3 T_new_old(SO3::exp(random_vector(random, 2)), random_vector(random, 10), 1);
      expect_the_same(*factor, test::evaluate(*factor, transformed(T_new_old, variables)),
                      test::evaluate(*factor, variables));
    }
}

TEST(FactorLaws, ATransformedFactorSaysTheSameOfTransformedVariables) {
  Random random(5);
  for (const auto& factor : transformable())
    for (const double scale : {0.2, 1.0, 7.0}) {
      const Sim3 S_new_old(SO3::exp(random_vector(random, 2)), random_vector(random, 10), scale);
      const auto other = factor->transformed(S_new_old);
      ASSERT_NE(other, nullptr);
      const std::vector<Variable> variables = variables_of(*factor, random);
      expect_the_same(*factor, test::evaluate(*other, transformed(S_new_old, variables)),
                      test::evaluate(*factor, variables));
    }
  const Sim3 S_new_old(SO3::exp({0.1, 0.2, 0.3}), {1, 2, 3}, 2);
  for (const auto& factor : others())
    EXPECT_EQ(factor->transformed(S_new_old), nullptr) << name_of(*factor);
  EXPECT_EQ(PosePriorFactor<SE2>(SE2(), whitening_of(3)).transformed(S_new_old), nullptr);
  EXPECT_EQ(RelativePoseFactor<Sim3>(Sim3(), whitening_of(7)).transformed(S_new_old), nullptr);
}

TEST(FactorLaws, ATransformedPlaneObservationIsTheSameToTheFirstOrderOfItsError) {
  Random random(6);
  const PlaneObservationFactor at_one_scale(Plane3({0.2, -1, 0.3}, 1.65), whitening_of(3));
  const SE3 T_world_cam = random_pose(random);
  const Plane3 seen = transform_to(T_world_cam.inverse(), Plane3({0.2, -1, 0.3}, 1.65));
  for (const double scale : {0.5, 1.0, 3.0}) {
    const Sim3 S_new_old(SO3::exp(random_vector(random, 2)), random_vector(random, 10), scale);
    const auto other = at_one_scale.transformed(S_new_old);
    for (const double size : {1e-3, 1e-4}) {
      const std::vector<Variable> at{T_world_cam, seen.plus(random_vector(random, size))};
      const Eigen::VectorXd r = test::evaluate(at_one_scale, at);
      const Eigen::VectorXd r_new = test::evaluate(*other, transformed(S_new_old, at));
      const double order = scale == 1 ? 1e-12 : 100 * size * size;
      EXPECT_LT(std::min((r_new - r).norm(), (r_new + r).norm()), order) << "scale " << scale;
    }
  }
}

TEST(LinearPriorLaws, IsLinearInTheTangentsFromItsPoint) {
  Random random(7);
  const SO3 R = SO3::exp({0.3, -1, 0.2});
  const std::vector<Variable> at{1.5,
                                 SE2(1, 2, 0.5),
                                 SE3(R, Eigen::Vector3d(1, 2, 3)),
                                 Sim3(R, {3, 2, 1}, 1.3),
                                 R,
                                 Eigen::Vector3d(1, 2, 3),
                                 Line3::from_direction({1, 2, 3}, {1, 0, 2}),
                                 Plane3({0.1, -0.9, 0.2}, 1.6),
                                 Marker{SE3(R, Eigen::Vector3d(1, 0, 5)), 0.3}};
  Eigen::Index columns = 0;
  for (const Variable& x : at) columns += degrees_of_freedom(x);
  Eigen::MatrixXd J(5, columns);
  for (double& entry : J.reshaped()) entry = random.normal();
  const Eigen::VectorXd e = Eigen::VectorXd::LinSpaced(5, -1, 1);
  const LinearPriorFactor prior(at, J, e);
  EXPECT_EQ(prior.residual_size(), 5);
  EXPECT_EQ(prior.variable_kinds(), (std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_LT((test::evaluate(prior, at) - e).norm(), 1e-14);
  Eigen::VectorXd delta(columns);
  for (double& entry : delta) entry = random.uniform(-0.5, 0.5);
  std::vector<Variable> moved;
  Eigen::Index first = 0;
  for (const Variable& x : at) {
    moved.push_back(plus(x, delta.segment(first, degrees_of_freedom(x))));
    first += degrees_of_freedom(x);
  }
  EXPECT_LT((test::evaluate(prior, moved) - e - J * delta).norm(), 1e-11);
  test::expect_jacobians_match(prior, moved);
}

}  // namespace factor_laws_test
}  // namespace placegraph
