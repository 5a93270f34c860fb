#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/outcome.h>

#include <string>

namespace placegraph {
namespace error_test {

TEST(FileError, NamesPathAndLine) {
  EXPECT_STREQ(FileError("a/b.txt", 12, "not a number").what(), "a/b.txt:12: not a number");
}

TEST(FileError, LeavesOutTheLineWhereThereIsNone) {
  EXPECT_STREQ(FileError("a/b.txt", "missing").what(), "a/b.txt: missing");
}

TEST(Error, EveryKindIsCaughtAsError) {
  EXPECT_THROW(throw FileError("a", "b"), Error);
  EXPECT_THROW(require(false, "x must be positive"), Error);
  EXPECT_THROW(require(false, std::string("x must be positive")), ArgumentError);
  EXPECT_NO_THROW(require(true, "x must be positive"));
}

TEST(Outcome, IsNotAttemptedUntilSomethingWasComputed) {
  const Outcome outcome;
  EXPECT_FALSE(outcome);
  EXPECT_EQ(outcome.code, Outcome::Code::kNotAttempted);
}

TEST(Outcome, FailureKeepsItsReason) {
  const Outcome outcome = Outcome::failure(Outcome::Code::kDegenerate, "points on a line");
  EXPECT_FALSE(outcome);
  EXPECT_EQ(outcome.code, Outcome::Code::kDegenerate);
  EXPECT_EQ(outcome.reason, "points on a line");
  EXPECT_TRUE(Outcome::ok());
}

TEST(Outcome, EveryCodeHasWordsOfItsOwn) {
  using Code = Outcome::Code;
  EXPECT_STREQ(to_string(Code::kOk), "ok");
  EXPECT_STREQ(to_string(Code::kTooFewData), "too few data");
  EXPECT_STREQ(to_string(Code::kNoConsensus), "no consensus");
  EXPECT_STREQ(to_string(Code::kDegenerate), "degenerate");
  EXPECT_STREQ(to_string(Code::kNotConverged), "not converged");
  EXPECT_STREQ(to_string(Code::kInconsistent), "inconsistent");
  EXPECT_STREQ(to_string(Code::kNotAttempted), "not attempted");
}

}  // namespace error_test
}  // namespace placegraph
