#include <gtest/gtest.h>
#include <placegraph/frontend/align/joint_histogram.h>
#include <placegraph/graph/core/random.h>

#include <cmath>

namespace placegraph {
namespace joint_histogram_test {

using Values = std::vector<double>;

double information(const Values& ref, const Values& cur) {
  return JointHistogram(ref, cur).mutual_information();
}

TEST(MutualInformation, OfTwoGreysIsThatOfAChannelWithErrors) {
  // The windows of the two values do not meet, so that they tell the values apart.
  for (const int wrong : {0, 1, 10, 25, 50}) {
    Values ref, cur;
    for (int i = 0; i < 200; ++i) {
      ref.push_back(i % 2 == 0 ? 40 : 170);
      const bool flipped = i / 2 < wrong;
      cur.push_back((i % 2 == 0) != flipped ? 12 : 90);
    }
    const double e = wrong / 100.0;
    const auto part = [](double p) { return p > 0 ? p * std::log(p) : 0; };
    EXPECT_NEAR(information(ref, cur), std::log(2) + part(e) + part(1 - e), 1e-9) << wrong;
  }
}

TEST(MutualInformation, IsNothingOfIndependentValues) {
  // Every value of one with every value of the other: the joint distribution is the product.
  Random random(1);
  Values a(23), b(31), ref, cur;
  for (double& value : a) value = random.uniform(0, 255);
  for (double& value : b) value = random.uniform(0, 255);
  for (const double x : a)
    for (const double y : b) ref.push_back(x), cur.push_back(y);
  EXPECT_NEAR(information(ref, cur), 0, 1e-12);
  EXPECT_EQ(information({}, {}), 0);
  EXPECT_NEAR(information(a, Values(23, 7)), 0, 1e-12);  // a constant tells nothing
}

TEST(MutualInformation, IsSymmetricAndDoesNotCareForOrder) {
  Random random(2);
  Values ref, cur;
  for (int i = 0; i < 150; ++i) {
    ref.push_back(random.uniform(0, 255));
    cur.push_back(0.01 * ref.back() * ref.back() + random.normal(0, 20));
  }
  const double once = information(ref, cur);
  EXPECT_NEAR(information(cur, ref), once, 1e-12);
  EXPECT_NEAR(information({ref.rbegin(), ref.rend()}, {cur.rbegin(), cur.rend()}), once, 1e-12);
  Values twice_ref = ref, twice_cur = cur;
  twice_ref.insert(twice_ref.end(), ref.begin(), ref.end());
  twice_cur.insert(twice_cur.end(), cur.begin(), cur.end());
  EXPECT_NEAR(information(twice_ref, twice_cur), once, 1e-12);
}

}  // namespace joint_histogram_test
}  // namespace placegraph
