#include <gtest/gtest.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/lie.h>
#include <tests/support/seed.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace placegraph {
namespace lie_test {

using std::numbers::pi;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// Where translation, rotation and log scale stand in the tangent.
template <class G>
struct Layout;
template <>
struct Layout<SO2> {
  static constexpr int kTranslation = 0, kRotation = 1, kScale = 0;
};
template <>
struct Layout<SO3> {
  static constexpr int kTranslation = 0, kRotation = 3, kScale = 0;
};
template <>
struct Layout<SE2> {
  static constexpr int kTranslation = 2, kRotation = 1, kScale = 0;
};
template <>
struct Layout<SE3> {
  static constexpr int kTranslation = 3, kRotation = 3, kScale = 0;
};
template <>
struct Layout<Sim3> {
  static constexpr int kTranslation = 3, kRotation = 3, kScale = 1;
};

template <class G>
struct Sample {
  std::string name;
  typename G::Tangent xi;
  double angle;   ///< [rad]
  double length;  ///< of the translation, and of what it grows to under the scale
};

template <class G>
Sample<G> make_sample(Random& random, const std::string& name, double angle, double translation,
                      double log_scale) {
  using L = Layout<G>;
  Sample<G> sample{name, G::Tangent::Zero(), angle, 0};
  const auto direction = [&](int size) {
    Eigen::VectorXd d(size);
    for (double& value : d) value = random.normal();
    return Eigen::VectorXd(d / d.norm());
  };
  if constexpr (L::kTranslation > 0) {
    sample.xi.template head<L::kTranslation>() = translation * direction(L::kTranslation);
    sample.length = translation * std::exp(std::abs(log_scale * L::kScale));
  }
  sample.xi.template segment<L::kRotation>(L::kTranslation) = angle * direction(L::kRotation);
  if constexpr (L::kScale > 0) sample.xi[G::kDof - 1] = log_scale;
  sample.name += " [angle " + std::to_string(angle) + ", translation " +
                 std::to_string(translation) + ", log scale " + std::to_string(log_scale) + "]";
  return sample;
}

/// Identity, near zero, near pi, at random, far away; for similarities every pairing of small and
/// large angle with small and large scale.
template <class G>
std::vector<Sample<G>> make_samples(Random& random) {
  std::vector<Sample<G>> samples;
  samples.push_back(make_sample<G>(random, "identity", 0, 0, 0));
  for (const double tiny : {1e-300, 1e-160, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4}) {
    samples.push_back(make_sample<G>(random, "near zero", tiny, tiny, tiny));
    samples.push_back(make_sample<G>(random, "near zero, far away", tiny, 1e4, -tiny));
    samples.push_back(make_sample<G>(random, "no angle", 0, 1, tiny));
    samples.push_back(make_sample<G>(random, "no scale", tiny, 1, 0));
  }
  for (const double before : {1e-9, 1e-7, 1e-5, 1e-3})
    for (const double log_scale : {0.0, 1e-9, 0.5})
      samples.push_back(make_sample<G>(random, "near pi", pi - before, 3, log_scale));
  for (const double angle : {1e-9, 1e-3, 0.1, 0.2999, 0.3001, 0.9999, 1.0001, 3.0})
    for (const double log_scale : {-4.0, -2.0, -0.7, -1e-3, 1e-9, 1e-3, 0.7, 1.9999, 4.0})
      samples.push_back(make_sample<G>(random, "grid", angle, 2, log_scale));
  for (int i = 0; i < 40; ++i)
    samples.push_back(make_sample<G>(random, "random", random.uniform(0, 3.1),
                                     random.uniform(0, 10), random.uniform(-2, 2)));
  for (const double translation : {1e3, 1e5, 1e7})
    samples.push_back(make_sample<G>(random, "far away", random.uniform(0, 3.1), translation,
                                     random.uniform(-1, 1)));
  return samples;
}

template <class G>
class LieGroup : public testing::Test {
 protected:
  Random random_ = test::seeded_random(20240607);
  std::vector<Sample<G>> samples_ = make_samples<G>(random_);

  /// Rounding of a few operations on numbers of size 1 and on translations of that length.
  static double tolerance(double length) { return 60 * kEpsilon * (1 + length); }

  G random_element() {
    return G::exp(make_sample<G>(random_, "", random_.uniform(0, 3), random_.uniform(0, 5),
                                 random_.uniform(-1, 1))
                      .xi);
  }
  typename G::Point random_point() {
    typename G::Point p;
    for (double& value : p) value = random_.uniform(-5, 5);
    return p;
  }
};

using Groups = testing::Types<SO2, SO3, SE2, SE3, Sim3>;

struct GroupNames {
  template <class G>
  static std::string GetName(int i) {
    return std::vector<std::string>{"SO2", "SO3", "SE2", "SE3", "Sim3"}[i];
  }
};

TYPED_TEST_SUITE(LieGroup, Groups, GroupNames);

template <class A, class B>
double distance(const A& a, const B& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

/// Largest entry: with it, products of matrices bound their rounding.
template <class A>
double size(const A& a) {
  return 1 + a.cwiseAbs().maxCoeff();
}

/// Five-point derivative of f: Tangent -> Tangent at zero; truncation of order h^4 = 1e-16.
template <class G, class F>
typename G::Jacobian derivative(F&& f) {
  constexpr double h = 1e-4;
  typename G::Jacobian J;
  for (int i = 0; i < G::kDof; ++i) {
    const auto at = [&](double step) ->
        typename G::Tangent { return f(typename G::Tangent(step * G::Tangent::Unit(i))); };
    J.col(i) = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
  }
  return J;
}

TYPED_TEST(LieGroup, ExpOfLogIsTheElement) {
  for (const auto& sample : this->samples_) {
    const TypeParam T = TypeParam::exp(sample.xi);
    EXPECT_LT(distance(TypeParam::exp(T.log()).matrix(), T.matrix()),
              this->tolerance(sample.length) * size(T.matrix()) / (1 + sample.length) +
                  this->tolerance(sample.length))
        << sample.name;
  }
}

TYPED_TEST(LieGroup, LogOfExpIsTheTangentInsideTheInjectivityRadius) {
  for (const auto& sample : this->samples_)
    EXPECT_LT(distance(TypeParam::exp(sample.xi).log(), sample.xi), this->tolerance(sample.length))
        << sample.name;
}

TYPED_TEST(LieGroup, LogKeepsTinyTangentsToFullRelativePrecision) {
  for (const auto& sample : this->samples_)
    if (sample.name.starts_with("near zero [") && sample.angle >= 1e-160) {
      EXPECT_LT(distance(TypeParam::exp(sample.xi).log(), sample.xi), 1e-15 + 1e-9 * sample.angle)
          << sample.name;
      using L = Layout<TypeParam>;
      const auto rotation = [](const auto& xi) {
        return xi.template segment<L::kRotation>(L::kTranslation).eval();
      };
      EXPECT_LT(distance(rotation(TypeParam::exp(sample.xi).log()), rotation(sample.xi)),
                1e-14 * sample.angle)
          << sample.name;
    }
}

TYPED_TEST(LieGroup, ExpOfZeroIsExactlyTheIdentity) {
  EXPECT_EQ(TypeParam::exp(TypeParam::Tangent::Zero()).matrix(), TypeParam().matrix());
  EXPECT_EQ(TypeParam().log(), TypeParam::Tangent::Zero());
}

TYPED_TEST(LieGroup, ExpOfARotationByPiIsRecoveredUpToItsSign) {
  for (int i = 0; i < 20; ++i) {
    const auto sample = make_sample<TypeParam>(this->random_, "half turn", pi, 2, 0.3);
    const TypeParam T = TypeParam::exp(sample.xi);
    const auto xi = T.log();
    EXPECT_LT(distance(TypeParam::exp(xi).matrix(), T.matrix()), this->tolerance(10));
    using L = Layout<TypeParam>;
    EXPECT_NEAR(xi.template segment<L::kRotation>(L::kTranslation).norm(), pi, 2e-15);
  }
}

TYPED_TEST(LieGroup, ElementTimesInverseIsTheIdentity) {
  for (const auto& sample : this->samples_) {
    const TypeParam T = TypeParam::exp(sample.xi), inverse = T.inverse();
    const double bound = this->tolerance(sample.length) * size(inverse.matrix()) * size(T.matrix());
    EXPECT_LT(distance((T * inverse).matrix(), TypeParam().matrix()), bound) << sample.name;
    EXPECT_LT(distance((inverse * T).matrix(), TypeParam().matrix()), bound) << sample.name;
    EXPECT_LT(distance(inverse.matrix(), TypeParam::exp(-sample.xi).matrix()),
              this->tolerance(sample.length) * size(inverse.matrix()))
        << sample.name;
  }
}

TYPED_TEST(LieGroup, ProductIsAssociativeAndThatOfTheMatrices) {
  for (int i = 0; i < 100; ++i) {
    const TypeParam A = this->random_element(), B = this->random_element(),
                    C = this->random_element();
    const double bound = this->tolerance(size(A.matrix()) * size(B.matrix()) * size(C.matrix()));
    EXPECT_LT(distance(((A * B) * C).matrix(), (A * (B * C)).matrix()), bound);
    EXPECT_LT(distance((A * B).matrix(), A.matrix() * B.matrix()), bound);
    EXPECT_LT(distance((A * TypeParam()).matrix(), A.matrix()), this->tolerance(0));
  }
}

TYPED_TEST(LieGroup, LongProductsStayInTheGroup) {
  TypeParam T;
  for (int i = 0; i < 20000; ++i) {
    auto xi = make_sample<TypeParam>(this->random_, "", this->random_.uniform(0, 3), 1, 0).xi;
    T = T * TypeParam::exp(xi);
  }
  using L = Layout<TypeParam>;
  constexpr int kSpace = L::kRotation == 1 ? 2 : 3;
  const Eigen::Matrix<double, kSpace, kSpace> R =
      T.matrix().template topLeftCorner<kSpace, kSpace>();
  EXPECT_LT(distance(R.transpose() * R, Eigen::Matrix<double, kSpace, kSpace>::Identity()), 1e-14);
}

TYPED_TEST(LieGroup, ActionOnPointsFollowsTheProductAndTheInverse) {
  for (int i = 0; i < 100; ++i) {
    const TypeParam A = this->random_element(), B = this->random_element();
    const auto p = this->random_point();
    const double bound = this->tolerance(10 * size(A.matrix()) * size(B.matrix()));
    EXPECT_LT(distance((A * B) * p, A * (B * p)), bound);
    EXPECT_LT(distance(A.inverse() * (A * p), p), bound * size(A.inverse().matrix()));
    constexpr int kSpace = TypeParam::Point::RowsAtCompileTime;
    Eigen::VectorXd by_matrix = A.matrix().template topLeftCorner<kSpace, kSpace>() * p;
    if (A.matrix().cols() > kSpace) by_matrix += A.matrix().col(kSpace).template head<kSpace>();
    EXPECT_LT(distance(A * p, by_matrix), bound);
  }
}

TYPED_TEST(LieGroup, PlusPerturbsOnTheRight) {
  const TypeParam A = this->random_element(), B = this->random_element();
  EXPECT_EQ(A.plus(B.log()).matrix(), (A * TypeParam::exp(B.log())).matrix());
}

TYPED_TEST(LieGroup, AdjointCarriesTangentsAcross) {
  for (const auto& sample : this->samples_) {
    const TypeParam T = this->random_element();
    const auto moved = (T.adjoint() * sample.xi).eval();
    const double length = size(moved) + size(T.adjoint()) * (1 + sample.length);
    EXPECT_LT(distance((T * TypeParam::exp(sample.xi) * T.inverse()).matrix(),
                       TypeParam::exp(moved).matrix()),
              this->tolerance(length * size(T.matrix()) * size(T.inverse().matrix())))
        << sample.name;
  }
}

TYPED_TEST(LieGroup, AdjointOfAProductIsTheProductOfAdjoints) {
  for (int i = 0; i < 100; ++i) {
    const TypeParam A = this->random_element(), B = this->random_element();
    EXPECT_LT(distance((A * B).adjoint(), A.adjoint() * B.adjoint()),
              this->tolerance(7 * size(A.adjoint()) * size(B.adjoint())));
    EXPECT_LT(distance(A.inverse().adjoint() * A.adjoint(), TypeParam::Jacobian::Identity().eval()),
              this->tolerance(7 * size(A.adjoint()) * size(A.inverse().adjoint())));
  }
}

TYPED_TEST(LieGroup, LittleAdjointIsTheDerivativeOfTheAdjoint) {
  for (int i = 0; i < 20; ++i) {
    const auto a = this->random_element().log(), b = this->random_element().log();
    // d/dt Ad(exp(t a)) b at 0, by the five-point rule: h^4 times the fifth power of ad(a).
    const auto at = [&](double t) ->
        typename TypeParam::Tangent { return TypeParam::exp(t * a).adjoint() * b; };
    constexpr double h = 1e-4;
    const typename TypeParam::Tangent numeric =
        (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
    EXPECT_LT(distance(TypeParam::ad(a) * b, numeric), 1e-11 * size(a) * size(b));
    EXPECT_LT(distance(TypeParam::ad(a) * b, -TypeParam::ad(b) * a), 1e-13 * size(a) * size(b));
  }
}

TYPED_TEST(LieGroup, RightJacobianIsTheDerivativeOfExp) {
  for (const auto& sample : this->samples_) {
    const TypeParam inverse = TypeParam::exp(sample.xi).inverse();
    const auto numeric = derivative<TypeParam>([&](const typename TypeParam::Tangent& step) {
      return (inverse * TypeParam::exp(sample.xi + step)).log();
    });
    // Rounding of the products, through the step of 1e-4.
    const double rounding = kEpsilon * size(inverse.matrix()) * (1 + sample.length) / 1e-4;
    EXPECT_LT(distance(TypeParam::right_jacobian(sample.xi), numeric),
              20 * rounding + 1e-12 * size(numeric))
        << sample.name;
  }
}

TYPED_TEST(LieGroup, InverseRightJacobianIsTheDerivativeOfLog) {
  for (const auto& sample : this->samples_) {
    if (sample.angle > pi - 0.02) continue;  // the step would cross the cut of the logarithm
    const TypeParam T = TypeParam::exp(sample.xi);
    const auto numeric = derivative<TypeParam>([&](const typename TypeParam::Tangent& step) {
      return (T.plus(step).log() - sample.xi).eval();
    });
    const auto J = TypeParam::right_jacobian_inverse(sample.xi);
    const double rounding = kEpsilon * size(T.matrix()) * (1 + sample.length) / 1e-4;
    EXPECT_LT(distance(J, numeric), 20 * rounding + 1e-11 * size(J)) << sample.name;
  }
}

TYPED_TEST(LieGroup, RightJacobianTimesItsInverseIsTheIdentity) {
  for (const auto& sample : this->samples_) {
    const auto J = TypeParam::right_jacobian(sample.xi);
    const auto J_inverse = TypeParam::right_jacobian_inverse(sample.xi);
    EXPECT_LT(distance(J * J_inverse, TypeParam::Jacobian::Identity().eval()),
              10 * kEpsilon * size(J) * size(J_inverse))
        << sample.name;
  }
}

TYPED_TEST(LieGroup, LeftJacobianIsTheAdjointTimesTheRightOne) {
  for (const auto& sample : this->samples_) {
    const auto left = TypeParam::right_jacobian(-sample.xi);
    const auto right = TypeParam::right_jacobian(sample.xi);
    const auto adjoint = TypeParam::exp(sample.xi).adjoint();
    EXPECT_LT(distance(left, adjoint * right), 20 * kEpsilon * size(adjoint) * size(right))
        << sample.name;
  }
}

}  // namespace lie_test
}  // namespace placegraph
