#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "tests/support/command.h"

namespace placegraph::test {

/// Tests of the command line, each in a folder of its own.
class CliTest : public ::testing::Test {
 protected:
  CommandResult run(const std::string& arguments) { return run_placegraph(arguments, dir.path()); }
  /// This exit code, nothing on stdout, one line on stderr that says `message`.
  void expect_failure(const std::string& arguments, int code, const std::string& message) {
    SCOPED_TRACE(arguments);
    const CommandResult result = run(arguments);
    EXPECT_EQ(result.code, code);
    EXPECT_THAT(result.out, ::testing::IsEmpty());
    EXPECT_THAT(result.err, ::testing::StartsWith("placegraph: "));
    EXPECT_THAT(result.err, ::testing::HasSubstr(message));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
  void expect_usage_error(const std::string& arguments, const std::string& message) {
    expect_failure(arguments, 2, message);
  }
  TemporaryFolder dir;
};

}  // namespace placegraph::test
