#include <gtest/gtest.h>
#include <placegraph/backend/window/window_blocks.h>

#include <limits>

#include "tests/support/scenes/window_factors.h"

namespace placegraph {
namespace window_blocks_test {

using test::FactorScene;

SlidingWindow window_with_landmarks() {
  SlidingWindow window = FactorScene().window({});
  window.add_manhattan_frame(ManhattanFrameId(3), SO3::exp({0.5, 0, 0}));
  window.add_line(LineId(8), Line3::from_direction({1, 2, 3}, {0, 1, 0}));
  window.add_line(LineId(5), Line3::from_direction({-1, 2, 4}, {1, 1, 0}));
  window.add_landmark(LandmarkId(30), {1, 2, 9});
  window.add_landmark(LandmarkId(4), {-1, 0, 7});
  return window;
}

TEST(WindowBlocks, HoldTheEstimatesInTheOrderOfKindsAndIds) {
  const SlidingWindow window = window_with_landmarks();
  const WindowState& state = window.state();
  WindowBlocks blocks(state);
  EXPECT_EQ(blocks.variables(), variables_of(state));
  EXPECT_EQ(blocks.keyframes(), 4u);
  for (std::size_t k = 0; k < blocks.variables().size(); ++k) {
    const WindowVariable& variable = blocks.variables()[k];
    EXPECT_EQ(blocks.at(variable), blocks.variable(k));
    Variable value = value_of(state, variable);
    load_block(blocks.variable(k), value);
    EXPECT_LT(minus(value, value_of(state, variable)).norm(), 1e-12) << to_string(variable);
  }
  EXPECT_EQ(blocks.position(KeyframeId(2)), 2u);
  EXPECT_EQ((Eigen::Vector3d(Eigen::Map<Eigen::Vector3d>(blocks.point(0)))),
            Eigen::Vector3d(-1, 0, 7));
  EXPECT_EQ((Eigen::Vector3d(Eigen::Map<Eigen::Vector3d>(blocks.point(1)))),
            Eigen::Vector3d(1, 2, 9));
  EXPECT_LT(
      VariableBlock<Line3>::load(blocks.line(1)).minus(state.lines.at(LineId(8)).line_map).norm(),
      1e-12);
}

TEST(WindowBlocks, LieInOneArrayWhoseAddressesDecideTheOrderOfElimination) {
  const SlidingWindow window = window_with_landmarks();
  WindowBlocks blocks(window.state());
  for (int k = 0; k < 3; ++k)
    EXPECT_EQ(blocks.at(keyframe_variable(KeyframeId(k))) + 7,
              blocks.at(keyframe_variable(KeyframeId(k + 1))));
  EXPECT_EQ(blocks.at(keyframe_variable(KeyframeId(3))) + 7,
            blocks.at(manhattan_variable(ManhattanFrameId(3))));
  EXPECT_EQ(blocks.at(manhattan_variable(ManhattanFrameId(3))) + 4,
            blocks.at(manhattan_variable(FactorScene::kManhattanFrame)));
  EXPECT_EQ(blocks.at(manhattan_variable(FactorScene::kManhattanFrame)) + 4, blocks.line(0));
  EXPECT_EQ(blocks.line(1) + 5, blocks.at(plane_variable(FactorScene::kPlane)));
}

TEST(WindowBlocks, AreFiniteUnlessANumberIsNot) {
  const SlidingWindow window = window_with_landmarks();
  WindowBlocks blocks(window.state());
  EXPECT_TRUE(blocks.finite());
  *blocks.point(1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(blocks.finite());
  *blocks.point(1) = 0;
  blocks.at(manhattan_variable(ManhattanFrameId(3)))[2] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(blocks.finite());
}

}  // namespace window_blocks_test
}  // namespace placegraph
