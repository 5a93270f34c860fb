#include <gtest/gtest.h>
#include <placegraph/pipeline/health/contradicted_steps.h>

#include <string>

namespace placegraph {
namespace contradicted_steps_test {

/// Frames 0, 1, ...: 'x' where the images contradict the rotation.
ContradictedSteps after(const std::string& steps) {
  ContradictedSteps contradicted;
  for (std::size_t i = 0; i < steps.size(); ++i)
    contradicted.add(FrameId(static_cast<std::int64_t>(i)), steps[i] == 'x');
  return contradicted;
}

TEST(ContradictedSteps, SingleStepsAndPairsProveNothing) {
  for (const char* steps : {"", ".....", ".x.xx..x.xx.", "xx"}) {
    EXPECT_FALSE(after(steps).row()) << steps;
    EXPECT_FALSE(after(steps).note()) << steps;
  }
}

TEST(ContradictedSteps, ThreeInARowAreARow) {
  EXPECT_EQ(after("..xxx").row(), FrameId(2));
  EXPECT_EQ(after("..xxxxx").row(), FrameId(2));
  EXPECT_FALSE(after("..xxx.").row());  // the newest frame agrees again
}

TEST(ContradictedSteps, ABeginningThatNothingSupportsIsContradictedToo) {
  const ContradictedSteps contradicted = after("......xxx");
  EXPECT_EQ(contradicted.contradicted_from(FrameId(0)), FrameId(6));
  EXPECT_EQ(contradicted.contradicted_from(FrameId(2)), FrameId(6));
  EXPECT_EQ(contradicted.contradicted_from(FrameId(3)), FrameId(3));
  EXPECT_EQ(contradicted.contradicted_from(FrameId(5)), FrameId(5));
  EXPECT_FALSE(after("...xx").contradicted_from(FrameId(3)));
}

TEST(ContradictedSteps, RowsAreReportedAlsoAfterTheyHaveEnded) {
  for (const char* steps : {".xxxx", ".xxxx...xx"}) {
    const auto note = after(steps).note();
    ASSERT_TRUE(note) << steps;
    EXPECT_EQ(note->cause, NoteCause::kScale);
    EXPECT_NE(note->text.find("frames 1 to 4:"), std::string::npos) << note->text;
  }
  EXPECT_NE(after("xxx.xxx.xxxx").note()->text.find("frames 0 to 2, and of 2 later stretches"),
            std::string::npos);
}

TEST(ContradictedSteps, ARowThatIsEndedDoesNotGoOn) {
  ContradictedSteps contradicted = after("xxx");
  contradicted.end_row();
  EXPECT_FALSE(contradicted.row());
  contradicted.add(FrameId(3), true);
  EXPECT_FALSE(contradicted.row());
  EXPECT_TRUE(contradicted.note());
}

}  // namespace contradicted_steps_test
}  // namespace placegraph
