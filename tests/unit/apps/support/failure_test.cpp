#include "apps/support/output.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <placegraph/graph/core/error.h>

#include <filesystem>
#include <new>
#include <optional>
#include <regex>
#include <system_error>
#include <vector>

namespace placegraph::apps {
namespace failure_test {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// The failure that main() sees when this function throws.
template <class Function>
Failure failure_by(const Function& function) {
  try {
    function();
  } catch (const std::exception& error) {
    return failure_of(error);
  }
  return {ExitCode::kSuccess, ""};
}

TEST(Failure, ErrorsOfUsersKeepTheirMessage) {
  const std::string text = "walk.yaml:3: fx: 0 is too small";
  for (const auto& [failure, code] :
       {std::pair(failure_of(Error(text)), ExitCode::kUsage),
        std::pair(failure_of(ArgumentError(text)), ExitCode::kUsage),
        std::pair(failure_of(FileError("walk.yaml", 3, "fx: 0 is too small")), ExitCode::kUsage),
        std::pair(failure_of(NoResult(text)), ExitCode::kNoResult),
        std::pair(failure_of(Interrupted(text)), ExitCode::kInterrupted)}) {
    EXPECT_EQ(failure.code, code);
    EXPECT_EQ(failure.message, text);
  }
  const Failure failure =
      failure_by([] { (void)std::filesystem::directory_iterator("/none/of/these"); });
  EXPECT_EQ(failure.code, ExitCode::kUsage);
  EXPECT_THAT(failure.message, HasSubstr("/none/of/these"));
}

TEST(Failure, WhatNoUserCanMendIsInternalAndSaysSo) {
  const std::vector<Failure> failures = {
      failure_by([] { (void)std::vector<int>(3).at(7); }),
      failure_by([] { (void)std::optional<int>().value(); }),
      failure_by([] { (void)std::string(std::string().max_size() + 1, 'x'); }),
      failure_by([] { (void)std::stoi("seven"); }),
      failure_by([] { (void)std::regex("("); }),
      failure_by([] { throw std::system_error(EAGAIN, std::generic_category()); }),
      failure_by([] { throw std::runtime_error("a library's own"); })};
  for (const Failure& failure : failures) {
    EXPECT_EQ(failure.code, ExitCode::kInternal) << failure.message;
    EXPECT_THAT(failure.message, StartsWith("internal error, please report it"));
  }
  EXPECT_THAT(failures.back().message, HasSubstr("a library's own"));
}

TEST(Failure, NoMemoryIsSaidInWords) {
  const Failure failure = failure_of(std::bad_alloc());
  EXPECT_EQ(failure.code, ExitCode::kInternal);
  EXPECT_EQ(failure.message, "there is not enough memory");
  EXPECT_EQ(failure_of(std::bad_array_new_length()).message, failure.message);
  const auto of_images = [](int code) { return failure_of(cv::Exception(code, "", "", "", 0)); };
  EXPECT_EQ(of_images(cv::Error::StsNoMem).message, failure.message);
  EXPECT_NE(of_images(cv::Error::StsBadArg).message, failure.message);
}

TEST(Failure, EveryExitCodeIsInTheTextForUsers) {
  for (const ExitCode code : {ExitCode::kSuccess, ExitCode::kNoResult, ExitCode::kUsage,
                              ExitCode::kInternal, ExitCode::kInterrupted}) {
    const std::regex number("(^|, )" + std::to_string(static_cast<int>(code)) + " ");
    EXPECT_TRUE(std::regex_search(kExitCodesText, number));
  }
}

}  // namespace failure_test
}  // namespace placegraph::apps
