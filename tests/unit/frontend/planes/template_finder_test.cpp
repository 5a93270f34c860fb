#include <gtest/gtest.h>
#include <placegraph/frontend/align/warp.h>
#include <placegraph/frontend/planes/template_finder.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/board.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace template_finder_test {

using namespace test;
using Eigen::Matrix3d;

TEST(TemplateFinder, FindsARotatedRegionAnywhere) {
  Random random = seeded_random(121);
  Board board(random);
  board.width = 200, board.height = 160;
  board.corners = {{60, 40}, {140, 40}, {140, 120}, {60, 120}};
  board.texture.wavelength = 16;
  const TemplateFinder finder(board.picture(Matrix3d::Identity()), board.corners, {});
  EXPECT_GT(finder.features(), 8);
  const Matrix3d H = view_of({100, 80}, 1.2, 0.9, {30, -20}, {0, 0});
  Random draws(1);
  const auto places = finder.find(board.picture(H), draws);
  ASSERT_FALSE(places.empty());
  for (const auto& corner : board.corners)
    EXPECT_LT((*map_pixel(places[0].H_cur_ref, corner) - *map_pixel(H, corner)).norm(), 3);
}

TEST(TemplateFinder, ProposesNothingWhereThereIsNothing) {
  const Image blank(100, 100, CV_8UC1, cv::Scalar(80));
  const TemplateFinder finder(blank, {{20, 20}, {60, 20}, {60, 60}, {20, 60}}, {});
  Random draws(1);
  EXPECT_TRUE(finder.find(blank, draws).empty());
  EXPECT_THROW(TemplateFinder(blank, {{20, 20}, {60, 20}}, {}), ArgumentError);
}

}  // namespace template_finder_test
}  // namespace placegraph
