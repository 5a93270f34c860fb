#include "apps/support/match_file.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/command.h"

namespace placegraph::apps {
namespace match_file_test {

using test::TemporaryFolder;
using test::write_file;
using ::testing::HasSubstr;

TEST(MatchFile, ReadsTheFirstFourColumnsOnly) {
  const TemporaryFolder dir;
  write_file(dir / "m.txt", "# header\n1 2.5 3 -4 7 score\n\n 1e1 0 0 0\n");
  const MatchFile matches = read_matches(dir / "m.txt");
  ASSERT_EQ(matches.px_a.size(), 2u);
  ASSERT_EQ(matches.px_b.size(), 2u);
  EXPECT_EQ(matches.px_a[0], Eigen::Vector2d(1, 2.5));
  EXPECT_EQ(matches.px_b[0], Eigen::Vector2d(3, -4));
  EXPECT_EQ(matches.px_a[1], Eigen::Vector2d(10, 0));
}

TEST(MatchFile, ReadsPointsOfKnownPlaceInOneViewOrBoth) {
  const TemporaryFolder dir;
  write_file(dir / "p.txt", "1 2 3 4 5 6 7\n");
  const PointPairFile pairs = read_point_pairs(dir / "p.txt");
  ASSERT_EQ(pairs.points_a.size(), 1u);
  EXPECT_EQ(pairs.points_a[0], Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(pairs.points_b[0], Eigen::Vector3d(4, 5, 6));
  const SeenPointFile seen = read_seen_points(dir / "p.txt");
  ASSERT_EQ(seen.px.size(), 1u);
  EXPECT_EQ(seen.points[0], Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(seen.px[0], Eigen::Vector2d(4, 5));
  write_file(dir / "p.txt", "1 2 3 4 5\n");
  EXPECT_EQ(read_seen_points(dir / "p.txt").px.size(), 1u);
  try {
    (void)read_point_pairs(dir / "p.txt");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_THAT(error.what(), HasSubstr("p.txt:1: 5 columns, at least 6 expected: xA yA zA"));
  }
}

TEST(MatchFile, NamesTheLineThatIsBroken) {
  const TemporaryFolder dir;
  const auto message = [&](const std::string& text) {
    write_file(dir / "m.txt", text);
    try {
      (void)read_matches(dir / "m.txt");
    } catch (const FileError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message("1 2 3 4\n1 2 3\n"), HasSubstr("m.txt:2: 3 columns"));
  EXPECT_THAT(message("1 2 x 4\n"), HasSubstr("m.txt:1: xB"));
  EXPECT_THAT(message("1 nan 3 4\n"), HasSubstr("m.txt:1: yA"));
  EXPECT_THAT(message("1 2 3 4\n1 2 3 1e300\n"), HasSubstr("m.txt:2: yB"));
  EXPECT_THAT(message("# nothing\n"), HasSubstr("m.txt: no match"));
  EXPECT_THROW((void)read_matches(dir / "none.txt"), FileError);
}

}  // namespace match_file_test
}  // namespace placegraph::apps
