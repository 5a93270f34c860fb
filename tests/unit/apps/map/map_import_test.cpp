#include "apps/map/map_import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/map/map_database.h>

#include <filesystem>
#include <opencv2/core.hpp>

#include "tests/support/message_of.h"
#include "tests/support/pictures.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace map_import_test {

namespace fs = std::filesystem;

/// A sequence of three images, and a model of two of them that both see one point.
class MapImport : public testing::Test {
 protected:
  MapImport() {
    fs::create_directories(dir / "seq/image_0");
    for (int i = 0; i < 3; ++i)
      test::write_picture(dir / "seq/image_0/00000" + std::to_string(i) + ".png",
                          cv::Mat(48, 64, CV_8UC1, cv::Scalar(50 + 20 * i)));
    dir.write("seq/calib.txt", "P0: 50 0 32 0 0 50 24 0 0 0 1 0\n");
    dir.write("model/cameras.txt", "1 PINHOLE 64 48 50 50 32 24\n");
    dir.write("model/images.txt",
              "1 1 0 0 0 0 0 0 1 000000.png\n2 3 9\n2 1 0 0 0 0 0 -2 1 000002.png\n4 5 9\n");
    dir.write("model/points3D.txt", "9 1 2 3 4 5 6 0.1 1 0 2 0\n");
  }
  MapImportResult import() {
    return map_import({dir / "model", dir / "seq", dir / "imported.db", false, false});
  }
  test::TemporaryFolder dir;
};

TEST_F(MapImport, WritesTheMapAndSaysWhatItHolds) {
  const MapImportResult result = import();
  EXPECT_EQ(to_text(result), dir /
                                 "imported.db: 2 keyframes of 3 frames, 1 landmarks, "
                                 "2 observations\n");
  EXPECT_EQ(read_map(dir / "imported.db").map.keyframes.size(), 2u);
  EXPECT_THROW(import(), ArgumentError);  // it is there
}

TEST_F(MapImport, PassesOverCamerasThatNoImageHas) {
  dir.write("model/cameras.txt",
            "4 FOV 640 480 50 50 32 24 1\n1 PINHOLE 64 48 50 50 32 24\n2 EUCM 9 9 1 1 4 4 1 1\n");
  std::string said;
  map_import({dir / "model", dir / "seq", dir / "imported.db", false, false},
             [&](LogLevel, const std::string& text) { said += text; });
  EXPECT_THAT(said, testing::EndsWith("model: without 2 cameras that no image has: 4, 2"));
  EXPECT_EQ(read_map(dir / "imported.db").map.keyframes.size(), 2u);
}

TEST_F(MapImport, OfAModelWithoutImagesLeavesNothingBehind) {
  dir.write("model/images.txt", "");
  EXPECT_THAT(test::message_of<NoResult>([&] { import(); }), testing::HasSubstr("has no image"));
  EXPECT_FALSE(fs::exists(dir / "imported.db"));
}

}  // namespace map_import_test
}  // namespace placegraph::apps
