#include "apps/support/numbers_json.h"

#include <gtest/gtest.h>

namespace placegraph::apps {
namespace numbers_json_test {

using nlohmann::json;

TEST(NumbersJson, MatricesAreListedRowByRow) {
  Eigen::Matrix<double, 2, 3> matrix;
  matrix << 1, 2, 3, 4, 5, 6;
  EXPECT_EQ(numbers(matrix), (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(numbers(matrix.transpose()), (std::vector<double>{1, 4, 2, 5, 3, 6}));
  EXPECT_EQ(numbers(Eigen::Vector3d(7, 8, 9)), (std::vector<double>{7, 8, 9}));
  EXPECT_EQ(rows_json(matrix), (json{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}}));
  EXPECT_EQ(rows_json(Eigen::MatrixXd(0, 3)), json::array());
}

TEST(NumbersJson, APoseHasTheRealPartOfItsQuaternionLast) {
  const SE3 turned(SO3(Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5)), {1, 2, 3});
  EXPECT_EQ(pose_json(turned),
            (json{{"position_m", {1.0, 2.0, 3.0}}, {"quaternion_xyzw", {0.5, -0.5, 0.5, 0.5}}}));
}

}  // namespace numbers_json_test
}  // namespace placegraph::apps
