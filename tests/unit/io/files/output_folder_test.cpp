#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/output_file.h>

#include <filesystem>
#include <optional>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace output_folder_test {

TEST(OutputFolder, IsLockedWhileTheWorkGoesOn) {
  const test::TemporaryFolder folder;
  const std::string out = folder / "out";
  std::filesystem::create_directory(out);
  std::optional<OutputFolder> first(out);
  EXPECT_THROW(OutputFolder second(out + "/"), FileError);
  EXPECT_EQ(test::message_of([&] { OutputFolder second(out); }),
            out + ": another program is writing into it");
  first.reset();
  EXPECT_NO_THROW(OutputFolder second(out));
  EXPECT_TRUE(std::filesystem::exists(out));
}

TEST(OutputFolder, IsRemovedIfItWasMadeAndNothingWasWritten) {
  const test::TemporaryFolder folder;
  { const OutputFolder made(folder / "a/b"); }
  EXPECT_FALSE(std::filesystem::exists(folder / "a"));
  {
    const OutputFolder made(folder / "a/b");
    write_file(folder / "a/b/result.txt", "1\n");
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "a/b/result.txt"));
}

}  // namespace output_folder_test
}  // namespace placegraph
