#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/png_codec.h>
#include <placegraph/io/synthetic/writers/sequence_folder.h>

#include <opencv2/core.hpp>

#include "tests/support/message_of.h"
#include "tests/support/seed.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::synthetic {
namespace sequence_folder_test {

namespace fs = std::filesystem;
using test::message_of;
using test::read_file;
using test::TemporaryFolder;
using testing::HasSubstr;

std::size_t entries(const std::string& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(SequenceFolder, AppearsWithAllItsFilesOrNotAtAll) {
  const TemporaryFolder around;
  const std::string target = around / "drive/";  // as a shell completes it
  {
    SequenceFolder folder(target, false);
    folder.make("image_0");
    folder.write("image_0/a.txt", "one");
    EXPECT_FALSE(fs::exists(target));
    folder.put_in_place({"image_0"});
    EXPECT_EQ(read_file(around / "drive/image_0/a.txt"), "one");
  }
  {
    SequenceFolder given_up(around / "other", false);
    given_up.write("a.txt", "one");
  }
  EXPECT_EQ(entries(around.path()), 1u);  // neither that nor anything temporary
}

TEST(SequenceFolder, ReplacesAnEmptyFolderAndWhatAnInterruptedRunLeft) {
  const TemporaryFolder around;
  fs::create_directory(around / "drive");
  around.write(".drive.partial/old.txt", "old");
  SequenceFolder folder(around / "drive", false);
  folder.write("new.txt", "new");
  folder.put_in_place({"new.txt"});
  EXPECT_EQ(entries(around / "drive"), 1u);
  EXPECT_EQ(entries(around.path()), 1u);
}

TEST(SequenceFolder, TakesAFolderWithContentOnlyByForceAndReplacesItsPartsOnly) {
  const TemporaryFolder around;
  around.write("drive/image_0/old.png", "old");
  around.write("drive/depth_0/old.png", "old");
  around.write("drive/notes.txt", "mine");
  EXPECT_THAT(message_of<ArgumentError>([&] { SequenceFolder(around / "drive", false); }),
              HasSubstr("drive: is not empty; --force"));
  EXPECT_EQ(read_file(around / "drive/image_0/old.png"), "old");
  SequenceFolder folder(around / "drive", true);
  folder.make("image_0");
  folder.write("image_0/new.png", "new");
  folder.put_in_place({"image_0", "depth_0"});
  EXPECT_FALSE(fs::exists(around / "drive/image_0/old.png"));
  EXPECT_EQ(read_file(around / "drive/image_0/new.png"), "new");
  EXPECT_FALSE(fs::exists(around / "drive/depth_0"));  // a part that there is no more
  EXPECT_EQ(read_file(around / "drive/notes.txt"), "mine");
}

TEST(SequenceFolder, RefusesAFileInItsPlaceAndNamesWhatItCannotWrite) {
  const TemporaryFolder around;
  around.write("drive", "a file");
  for (const bool force : {false, true})
    EXPECT_THAT(message_of<ArgumentError>([&] { SequenceFolder(around / "drive", force); }),
                HasSubstr("drive: is a file"));
  EXPECT_THAT(message_of([&] { SequenceFolder(around / "drive/below", false); }),
              HasSubstr("cannot be created"));
  const SequenceFolder folder(around / "other", false);
  EXPECT_THAT(message_of([&] { folder.write("missing/a.txt", "one"); }),
              HasSubstr("missing/a.txt"));
}

TEST(SequenceFolder, WritesImagesWithoutLoss) {
  Random random = test::seeded_random(51);
  const TemporaryFolder around;
  SequenceFolder folder(around / "drive", false);
  for (const int type : {CV_8UC1, CV_16UC1, CV_8UC3}) {
    Image image(17, 23, type);
    for (int v = 0; v < image.rows; ++v)
      for (std::size_t i = 0; i < 23 * image.elemSize(); ++i)
        image.ptr<std::uint8_t>(v)[i] = static_cast<std::uint8_t>(random.index(256));
    folder.write("a.png", image);
    const Image read = decode_png(read_file((folder.path() / "a.png").string()),
                                  DecodedPixels::kAsStored);
    ASSERT_EQ(read.type(), type);
    EXPECT_EQ(cv::norm(read, image, cv::NORM_INF), 0);
  }
}

}  // namespace sequence_folder_test
}  // namespace placegraph::synthetic
