#include <gtest/gtest.h>
#include <placegraph/frontend/vanishing/vanishing_options.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/message_of.h"

namespace placegraph {
namespace vanishing_options_test {

TEST(VanishingOptions, AValueOutOfRangeIsNamedWithItsGroup) {
  SceneDirectionOptions options;
  EXPECT_NO_THROW(options.check());
  options.points.noise.end_px = 0;
  EXPECT_NE(test::message_of<ArgumentError>([&] { options.check(); }).find("points.noise.end_px"),
            std::string::npos);
  options = {};
  options.manhattan.min_segments = 1;
  EXPECT_NE(
      test::message_of<ArgumentError>([&] { options.check(); }).find("manhattan.min_segments"),
      std::string::npos);
}

}  // namespace vanishing_options_test
}  // namespace placegraph
