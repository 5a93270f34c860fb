#include <placegraph/io/files/atomic_file.h>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace atomic_file_test {

using test::message_of;
using test::read_file;
using test::TemporaryFolder;
using testing::HasSubstr;
namespace fs = std::filesystem;

std::ptrdiff_t entries_in(const std::string& folder) {
  return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

TEST(AtomicFile, LeavesTheOldFileUntilCommit) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.txt", "old");
  AtomicFile file(path);
  file.stream() << "new";
  file.stream().flush();
  EXPECT_EQ(read_file(path), "old");
  file.commit();
  EXPECT_EQ(read_file(path), "new");
  EXPECT_EQ(entries_in(folder.path()), 1);
}

TEST(AtomicFile, LeavesNothingBehindWithoutCommit) {
  const TemporaryFolder folder;
  { AtomicFile(folder / "a.txt").stream() << "half"; }
  EXPECT_EQ(entries_in(folder.path()), 0);
}

TEST(AtomicFile, KeepsTheExtensionForLibrariesThatGoByIt) {
  const TemporaryFolder folder;
  const AtomicFile file(folder / "plot.png");
  EXPECT_EQ(fs::path(file.temporary_path()).extension(), ".png");
}

TEST(AtomicFile, GivesTwoWritersDifferentTemporaries) {
  const TemporaryFolder folder;
  AtomicFile a(folder / "a.txt"), b(folder / "a.txt");
  EXPECT_NE(a.temporary_path(), b.temporary_path());
  a.stream() << "a";
  b.stream() << "b";
  a.commit();
  b.commit();
  EXPECT_EQ(read_file(folder / "a.txt"), "b");
}

TEST(AtomicFile, SaysWhichFileCannotBeWritten) {
  const TemporaryFolder folder;
  EXPECT_THAT(message_of([&] { AtomicFile(folder / "none/a.txt"); }), HasSubstr("none/a.txt: "));
  EXPECT_THAT(message_of([&] { AtomicFile{folder.path()}; }), HasSubstr("is a folder"));
  EXPECT_THROW(AtomicFile(""), ArgumentError);
}

TEST(AtomicFile, ReplacesTheFileThatALinkPointsTo) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a/file.txt", "old");
  fs::create_symlink("a/file.txt", folder / "link.txt");
  AtomicFile file(folder / "link.txt");
  file.stream() << "new";
  file.commit();
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  EXPECT_EQ(read_file(path), "new");
  EXPECT_EQ(entries_in(folder / "a"), 1);
}

TEST(AtomicFile, WritesIntoADeviceAndReplacesNone) {
  AtomicFile nowhere("/dev/null");
  nowhere.stream() << "gone";
  nowhere.commit();
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  AtomicFile full("/dev/full");
  full.stream() << "too much";
  EXPECT_THAT(message_of([&] { full.commit(); }), HasSubstr("/dev/full: cannot be written"));
}

TEST(OutputFolder, IsMadeWithItsParentsAndKeepsWhatItHolds) {
  const TemporaryFolder folder;
  make_output_folder(folder / "a/b");
  EXPECT_TRUE(fs::is_directory(folder / "a/b"));
  folder.write("a/b/x", "1");
  make_output_folder(folder / "a/b/");
  EXPECT_EQ(read_file(folder / "a/b/x"), "1");
  EXPECT_THAT(message_of([&] { make_output_folder(folder / "a/b/x"); }), HasSubstr("a/b/x: "));
  EXPECT_THROW(make_output_folder(folder / "a/b/x/y"), FileError);
  EXPECT_THROW(make_output_folder(""), ArgumentError);
}

}  // namespace atomic_file_test
}  // namespace placegraph
