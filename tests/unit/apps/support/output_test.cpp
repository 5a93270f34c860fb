#include "apps/support/output.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <csignal>
#include <filesystem>

#include "apps/support/interruption.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace output_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

TEST(Output, AFileMustBeFreeUnlessItIsForced) {
  const test::TemporaryFolder dir;
  const std::string taken = dir.write("taken.txt", "mine");
  const auto refusal = [](const std::string& path, bool force) {
    return test::message_of<ArgumentError>([&] { require_free(path, force); });
  };
  EXPECT_EQ(refusal(taken, false), taken + ": exists already; --force overwrites it");
  EXPECT_NO_THROW(require_free(taken, true));
  EXPECT_NO_THROW(require_free(dir / "free.txt", false));
  for (const bool force : {false, true}) {
    EXPECT_THAT(refusal(dir.path(), force), HasSubstr("is a folder"));
    EXPECT_THAT(refusal(dir / "none/free.txt", force), HasSubstr("there is no folder"));
  }
  // The question leaves no traces.
  EXPECT_EQ(test::read_file(taken), "mine");
  EXPECT_EQ(std::distance(fs::directory_iterator(dir.path()), {}), 1);
}

TEST(Output, AFolderMustBeEmptyUnlessItIsForced) {
  const test::TemporaryFolder dir;
  EXPECT_NO_THROW(require_free_folder(dir / "none", false));
  EXPECT_NO_THROW(require_free_folder(dir.path(), false));
  const std::string file = dir.write("a.txt", "");
  EXPECT_THAT(test::message_of<ArgumentError>([&] { require_free_folder(dir.path(), false); }),
              HasSubstr("is not empty; --force"));
  EXPECT_NO_THROW(require_free_folder(dir.path(), true));
  for (const bool force : {false, true})
    EXPECT_THAT(test::message_of<ArgumentError>([&] { require_free_folder(file, force); }),
                HasSubstr("is a file"));
}

TEST(Output, AnExtensionIsThatOfTheFile) {
  EXPECT_EQ(extension_of("a.b/c.tar.gz"), ".gz");
  EXPECT_EQ(extension_of("a.b/c"), "");
}

TEST(Output, AFileIsWrittenWithItsBytesAsTheyAre) {
  const test::TemporaryFolder dir;
  const std::string bytes("\0a\r\n\xff\n\n", 7);
  write_file(dir / "a.bin", bytes);
  EXPECT_EQ(test::read_file(dir / "a.bin"), bytes);
  write_file(dir / "a.bin", "");
  EXPECT_EQ(test::read_file(dir / "a.bin"), "");
  EXPECT_THROW(write_file(dir / "none/a.bin", "x"), FileError);
}

TEST(OneLine, HasNeitherBreaksNorControlCharacters) {
  EXPECT_EQ(one_line("  a \r\n\tb  c \n"), "a b c");
  EXPECT_EQ(one_line(""), "");
  EXPECT_EQ(one_line("\x1b[31mred\x7f"), "\\x1b[31mred\\x7f");
  EXPECT_EQ(one_line(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(one_line("\xc3\xa4 \xe2\x82\xac"), "\xc3\xa4 \xe2\x82\xac");  // letters stay
  EXPECT_EQ(one_line("\xc2\x9b[\xc2\xa0"), "\\xc2\\x9b[\xc2\xa0");        // U+009B begins a command
  for (int c = 1; c < 32; ++c)
    for (const char byte : one_line("x" + std::string(1, static_cast<char>(c)) + "y"))
      EXPECT_GE(static_cast<unsigned char>(byte), 0x20) << c;
}

TEST(OneLine, LosesItsMiddleIfItIsLongButNoPartOfACharacter) {
  EXPECT_EQ(one_line(std::string(1000, 'a')), std::string(1000, 'a'));
  EXPECT_EQ(one_line(std::string(1001, 'a')),
            std::string(600, 'a') + " ... " + std::string(300, 'a'));
  for (std::size_t i = 0; i < 9; ++i) {
    const std::size_t before = i % 3, behind = i / 3;
    std::string text(before, 'a');
    for (int k = 0; k < 500; ++k) text += "\xe2\x82\xac";  // of three bytes
    text += std::string(behind, 'b');
    const std::string line = one_line(text);
    const std::size_t cut = line.find(" ... ");
    ASSERT_NE(cut, std::string::npos);
    EXPECT_EQ((cut - before) % 3, 0U) << i;
    EXPECT_EQ((line.size() - cut - 5 - behind) % 3, 0U) << i;
    EXPECT_TRUE(text.starts_with(line.substr(0, cut)) && text.ends_with(line.substr(cut + 5)));
    EXPECT_LE(line.size(), 1000U);
  }
}

TEST(OutputMessages, GoToStderrInOneLineEach) {
  testing::internal::CaptureStderr();
  note("read\n3 files");
  warn("one\tis broken");
  option_notes()(LogLevel::kWarning, "an old spelling");
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "read 3 files\nwarning: one is broken\nan old spelling\n");
}

TEST(Interruption, NotesASignalAndGivesItsHandlerBack) {
  const auto hangup = std::signal(SIGHUP, SIG_IGN);
  for (const int signal : {SIGINT, SIGTERM}) {
    const auto given = std::signal(signal, SIG_DFL);  // a process may be begun with it ignored
    {
      const Interruption interruption;
      EXPECT_FALSE(interruption.requested());
      std::raise(SIGHUP);  // is ignored, and stays so
      EXPECT_FALSE(interruption.requested());
      std::raise(signal);
      EXPECT_TRUE(interruption.requested());
    }
    EXPECT_EQ(std::signal(signal, given), SIG_DFL);
  }
  EXPECT_EQ(std::signal(SIGHUP, hangup), SIG_IGN);
}

}  // namespace output_test
}  // namespace placegraph::apps
