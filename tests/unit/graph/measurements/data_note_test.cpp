#include <gtest/gtest.h>
#include <placegraph/graph/measurements/data_note.h>

#include <set>
#include <string>

namespace placegraph {
namespace data_note_test {

// Saved notes are read by their codes.
TEST(DataNote, EveryCauseIsFoundByItsCode) {
  std::set<std::string> codes;
  for (int i = 0; i <= static_cast<int>(NoteCause::kDrift); ++i) {
    const auto cause = static_cast<NoteCause>(i);
    EXPECT_EQ(note_cause_of(to_string(cause)), cause) << to_string(cause);
    EXPECT_TRUE(codes.insert(to_string(cause)).second) << to_string(cause);
  }
  EXPECT_FALSE(note_cause_of("dirt"));
}

TEST(DataNote, EveryVerdictIsFoundByItsName) {
  for (const Verdict verdict : {Verdict::kGood, Verdict::kDoubtful, Verdict::kFailed})
    EXPECT_EQ(verdict_of(to_string(verdict)), verdict);
  EXPECT_FALSE(verdict_of("fair"));
}

}  // namespace data_note_test
}  // namespace placegraph
