#include <gtest/gtest.h>
#include <placegraph/pipeline/scale/scale_check.h>

#include <cmath>
#include <vector>

namespace placegraph {
namespace scale_check_test {

std::optional<DataNote> note_for(const std::vector<double>& factors) {
  ScaleCheck check;
  for (std::size_t i = 0; i < factors.size(); ++i)
    check.add(FrameId(static_cast<std::int64_t>(10 * i)), std::log(factors[i]));
  return check.note();
}

TEST(ScaleCheck, AcceptsTheScatterOfAStreet) {
  EXPECT_FALSE(note_for({}));
  EXPECT_FALSE(note_for({1.02, 0.98, 1.01, 0.97, 1.12, 0.99, 1.03, 0.95}));
}

TEST(ScaleCheck, AcceptsASingleOutlier) {
  EXPECT_FALSE(note_for({1.02, 0.98, 1.9, 0.97, 1.02, 0.99, 1.03, 0.95}));
}

TEST(ScaleCheck, ReportsTwoThatDifferByFar) {
  const auto note = note_for({1.02, 0.98, 0.99, 0.97, 1.02, 1 / 1.9, 1.6, 0.95});
  ASSERT_TRUE(note);
  EXPECT_EQ(note->cause, NoteCause::kScale);
  EXPECT_TRUE(note->doubts_scale);
  EXPECT_NE(note->text.find("2 differ by more than 20 %, the most by a factor of 1.90 at frame 50"),
            std::string::npos)
      << note->text;
  // Two of a hundred are chance.
  std::vector<double> many(100, 1.01);
  many[7] = many[70] = 1.5;
  EXPECT_FALSE(note_for(many));
}

TEST(ScaleCheck, ReportsAWideScatter) {
  EXPECT_FALSE(note_for({1.1, 0.9, 1.1, 0.9}));  // too few
  const auto note = note_for({1.1, 0.9, 1.1, 0.9, 1.1, 0.9, 1.1});
  ASSERT_TRUE(note);
  EXPECT_EQ(note->cause, NoteCause::kScale);
  EXPECT_NE(note->text.find("by 10 % in the median of 7 comparisons"), std::string::npos)
      << note->text;
}

}  // namespace scale_check_test
}  // namespace placegraph
