#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/picture.h>
#include <placegraph/io/exports/base64.h>
#include <placegraph/io/exports/occupancy_file.h>
#include <placegraph/io/files/picture_file.h>
#include <placegraph/io/scene/ground_picture_file.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace ground_picture_file_test {

using ::testing::HasSubstr;

const std::string kGrid =
    "image: m.png\nresolution: 0.5\norigin: [-2, 3, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
    "free_thresh: 0.196\n";

/// Eight columns and six rows: free, but for an occupied row at the top and an unknown corner.
Image grid() {
  Image image(6, 8, CV_8UC1, cv::Scalar(254));
  image.row(0).setTo(0);
  image.at<uchar>(5, 7) = 205;
  return image;
}

Image pixels_of(const GroundPicture& picture) {
  const std::string head = "data:image/png;base64,";
  EXPECT_TRUE(picture.source.starts_with(head));
  return decode_picture(from_base64(picture.source.substr(head.size())), DecodedPixels::kEightBits,
                        "picture");
}

Eigen::Vector2d at(const GroundPicture& picture, double column, double row) {
  return picture.corner_m + column * picture.right_m + row * picture.down_m;
}

TEST(GroundPictureFile, AnOccupancyGridStandsAtItsOrigin) {
  const test::TemporaryFolder folder;
  write_png(folder / "m.png", grid());
  const GroundPicture picture = read_ground_picture(folder.write("m.yaml", kGrid));
  EXPECT_EQ(picture.name, "m.yaml");
  EXPECT_EQ(picture.columns, 8);
  EXPECT_EQ(picture.rows, 6);
  EXPECT_EQ(at(picture, 0, 6), Eigen::Vector2d(-2, 3));  // the lower left corner
  EXPECT_EQ(at(picture, 8, 0), Eigen::Vector2d(2, 6));
  Image pixels = pixels_of(picture);
  if (pixels.channels() == 3) cv::extractChannel(pixels, pixels, 0);
  EXPECT_EQ(pixels.at<uchar>(0, 3), 70);
  EXPECT_EQ(pixels.at<uchar>(3, 3), 255);
  EXPECT_EQ(pixels.at<uchar>(5, 7), 215);
}

TEST(GroundPictureFile, TheOriginTurnsTheGrid) {
  const test::TemporaryFolder folder;
  write_png(folder / "m.png", grid());
  std::string text = kGrid;
  text.replace(text.find("3, 0]"), 5, "3, 1.5707963267948966]");
  const GroundPicture picture = read_ground_picture(folder.write("m.yaml", text));
  // Columns go up, rows from the bottom to the left.
  EXPECT_LT((at(picture, 0, 6) - Eigen::Vector2d(-2, 3)).norm(), 1e-12);
  EXPECT_LT((at(picture, 8, 6) - Eigen::Vector2d(-2, 7)).norm(), 1e-12);
  EXPECT_LT((at(picture, 0, 0) - Eigen::Vector2d(-5, 3)).norm(), 1e-12);
}

/// What this program writes for robots is read back.
TEST(GroundPictureFile, GridsOfTheExportAreRead) {
  const test::TemporaryFolder folder;
  OccupancyGrid grid;
  grid.cell_m = 0.1;
  grid.low = {1, -2};
  grid.columns = 5;
  grid.rows = 4;
  grid.cells.assign(20, CellState::kFree);
  grid.cells[0] = CellState::kOccupied;  // least x and y
  // As PNG, which the library reads without its picture plug-in.
  const std::string pgm = to_pgm(grid);
  const std::string pixels_of_pgm = pgm.substr(pgm.size() - 20);
  Image picture_of_grid(4, 5, CV_8UC1);
  std::copy(pixels_of_pgm.begin(), pixels_of_pgm.end(), picture_of_grid.data);
  write_png(folder / "g.png", picture_of_grid);
  const GroundPicture picture =
      read_ground_picture(folder.write("g.yaml", to_map_server_yaml(grid, "g.png")));
  EXPECT_LT((at(picture, 0, 4) - Eigen::Vector2d(1, -2)).norm(), 1e-12);
  EXPECT_LT((at(picture, 5, 0) - Eigen::Vector2d(1.5, -1.6)).norm(), 1e-12);
  Image pixels = pixels_of(picture);
  if (pixels.channels() == 3) cv::extractChannel(pixels, pixels, 0);
  EXPECT_EQ(pixels.at<uchar>(3, 0), 70);
  EXPECT_EQ(pixels.at<uchar>(0, 0), 255);
}

TEST(GroundPictureFile, NegatedGridsAndModesAreObeyed) {
  const test::TemporaryFolder folder;
  write_png(folder / "m.png", grid());
  const auto grey = [&](const std::string& text, int row, int column) {
    Image pixels = pixels_of(read_ground_picture(folder.write("m.yaml", text)));
    if (pixels.channels() == 3) cv::extractChannel(pixels, pixels, 0);
    return static_cast<int>(pixels.at<uchar>(row, column));
  };
  std::string negated = kGrid;
  negated.replace(negated.find("negate: 0"), 9, "negate: true");
  EXPECT_EQ(grey(negated, 0, 0), 255);
  EXPECT_EQ(grey(negated, 3, 3), 70);
  // (255 - 205) / 255 is just above the threshold of free cells.
  EXPECT_EQ(grey(kGrid + "mode: scale\n", 5, 7), 255);
  EXPECT_EQ(grey(kGrid + "mode: raw\n", 0, 0), 255);
  EXPECT_EQ(grey(kGrid + "mode: raw\n", 5, 7), 215);
}

/// The example of the format: the last two numbers are the centre of the first pixel.
TEST(GroundPictureFile, AWorldFileNamesTheCentreOfTheFirstPixel) {
  const test::TemporaryFolder folder;
  write_png(folder / "tile.png", Image(10, 20, CV_8UC3, cv::Scalar(10, 20, 30)));
  for (const char* name : {"tile.pgw", "tile.pngw", "tile.wld"}) {
    folder.write(name, "0.5\n0\n0\n-0.5\n100.25\n49.75\n");
    const GroundPicture picture = read_ground_picture(folder / "tile.png");
    EXPECT_EQ(at(picture, 0, 0), Eigen::Vector2d(100, 50)) << name;
    EXPECT_EQ(at(picture, 20, 10), Eigen::Vector2d(110, 45)) << name;
    std::filesystem::remove(folder / name);
  }
  EXPECT_EQ(pixels_of(read_ground_picture(folder / "tile.png", {0, 0, 1, 1})).channels(), 3);
}

TEST(GroundPictureFile, CornersPlaceAPictureWithoutAFile) {
  const test::TemporaryFolder folder;
  write_png(folder / "tile.png", Image(10, 20, CV_8UC1, cv::Scalar(10)));
  const GroundPicture picture = read_ground_picture(folder / "tile.png", {-5, 1, 5, 4});
  EXPECT_EQ(at(picture, 0, 0), Eigen::Vector2d(-5, 4));
  EXPECT_LT((at(picture, 20, 10) - Eigen::Vector2d(5, 1)).norm(), 1e-12);
}

TEST(GroundPictureFile, LargePicturesBecomeSmallerAndStayWhereTheyAre) {
  const test::TemporaryFolder folder;
  write_png(folder / "tile.png", Image(100, 4000, CV_8UC1, cv::Scalar(10)));
  const GroundPicture picture = read_ground_picture(folder / "tile.png", {0, 0, 400, 10});
  EXPECT_EQ(picture.columns, 1600);
  EXPECT_EQ(picture.rows, 40);
  EXPECT_LT((at(picture, 1600, 40) - Eigen::Vector2d(400, 0)).norm(), 1e-9);
}

TEST(GroundPictureFile, WhatIsMissingOrWrongIsNamed) {
  const test::TemporaryFolder folder;
  write_png(folder / "m.png", grid());
  const auto message = [&](const std::string& from, const std::string& to) {
    std::string text = kGrid;
    text.replace(text.find(from), from.size(), to);
    const std::string path = folder.write("m.yaml", text);
    return test::message_of<FileError>([&] { (void)read_ground_picture(path); });
  };
  EXPECT_THAT(message("resolution: 0.5", "resolution: 0"),
              HasSubstr("m.yaml:2: resolution: is not above 0"));
  EXPECT_THAT(message("resolution: 0.5\n", ""), HasSubstr("resolution"));
  EXPECT_THAT(message("[-2, 3, 0]", "[-2, 3]"), HasSubstr("origin"));
  EXPECT_THAT(message("negate: 0", "negate: perhaps"), HasSubstr("m.yaml:4: negate"));
  EXPECT_THAT(message("free_thresh: 0.196", "free_thresh: 0.9"), HasSubstr("free_thresh"));
  EXPECT_THAT(message("free_thresh: 0.196", "mode: colour"), HasSubstr("mode"));
  EXPECT_THAT(message("m.png", "none.png"), HasSubstr("none.png"));
  const auto world = [&](const std::string& text) {
    folder.write("m.pgw", text);
    return test::message_of<FileError>([&] { (void)read_ground_picture(folder / "m.png"); });
  };
  EXPECT_THAT(test::message_of<FileError>([&] { (void)read_ground_picture(folder / "m.png"); }),
              HasSubstr("has no world file beside it"));
  EXPECT_THAT(world("1\n2\n"), HasSubstr("fewer than six"));
  EXPECT_THAT(world("1\n0\nx\n1\n0\n0\n"), HasSubstr("m.pgw:3"));
  EXPECT_THAT(world("0\n0\n0\n0\n0\n0\n"), HasSubstr("no extent"));
  EXPECT_THROW((void)read_ground_picture(folder / "m.png", {1, 0, 0, 1}), ArgumentError);
  EXPECT_THROW((void)read_ground_picture(folder.write("m.yaml", kGrid), {0, 0, 1, 1}),
               ArgumentError);
}

}  // namespace ground_picture_file_test
}  // namespace placegraph
