#include "apps/shell/spellings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace placegraph::apps {
namespace spellings_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(PresentSpelling, KeepsWhatItDoesNotKnow) {
  const CommandWords line = present_spelling({"map", "info", "out/town", "--json"});
  EXPECT_THAT(line.words, ElementsAre("map", "info", "out/town", "--json"));
  EXPECT_THAT(line.notes, IsEmpty());
  EXPECT_THAT(present_spelling({}).words, IsEmpty());
  EXPECT_THAT(present_spelling({"rnu", "flow"}).words, ElementsAre("rnu", "flow"));
}

TEST(PresentSpelling, ExpandsShortFormsWithoutANote) {
  const CommandWords line = present_spelling({"optimize", "a.g2o"});
  EXPECT_THAT(line.words, ElementsAre("graph", "optimize", "a.g2o"));
  EXPECT_THAT(line.notes, IsEmpty());
  EXPECT_THAT(present_spelling({"eval", "t.txt", "e.txt"}).words,
              ElementsAre("eval", "trajectory", "t.txt", "e.txt"));
  EXPECT_THAT(present_spelling({"eval", "edges", "t.txt"}).words,
              ElementsAre("eval", "edges", "t.txt"));
  EXPECT_THAT(present_spelling({"eval", "--help"}).words, ElementsAre("eval", "--help"));
}

TEST(PresentSpelling, ReplacesOldCommandsWithANote) {
  const CommandWords line = present_spelling({"hover", "flight", "--out", "o"});
  EXPECT_THAT(line.words, ElementsAre("flight", "run", "flight", "--out", "o"));
  EXPECT_THAT(line.notes, ElementsAre("'hover' is an old spelling of 'flight run'"));
  EXPECT_THAT(present_spelling({"planes", "two-view", "m.txt"}).words,
              ElementsAre("image", "two-view-planes", "m.txt"));
  EXPECT_THAT(present_spelling({"planes", "c.ply"}).words, ElementsAre("image", "planes", "c.ply"));
  EXPECT_THAT(present_spelling({"synth", "town-loop"}).words,
              ElementsAre("synth", "sequence", "town-loop"));
  EXPECT_THAT(present_spelling({"synth", "graph"}).notes, IsEmpty());
}

TEST(PresentSpelling, ReplacesOldFlagsOfTheirCommandAlone) {
  const CommandWords line = present_spelling({"loops", "--gt=g.txt", "--gt", "h.txt"});
  EXPECT_THAT(line.words, ElementsAre("eval", "loops", "--truth=g.txt", "--truth", "h.txt"));
  EXPECT_EQ(line.notes.size(), 2U);
  EXPECT_THAT(present_spelling({"run", "--gt"}).words, ElementsAre("run", "--gt"));
}

TEST(PresentSpelling, MakesFlagsOfHelpAndVersion) {
  EXPECT_THAT(present_spelling({"help"}).words, ElementsAre("--help"));
  EXPECT_THAT(present_spelling({"help", "map", "info"}).words, ElementsAre("map", "info", "--help"));
  EXPECT_THAT(present_spelling({"help", "optimize"}).words,
              ElementsAre("graph", "optimize", "--help"));
  EXPECT_THAT(present_spelling({"version"}).words, ElementsAre("--version"));
}

}  // namespace spellings_test
}  // namespace placegraph::apps
