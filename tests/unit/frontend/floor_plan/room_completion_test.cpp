#include <gtest/gtest.h>
#include <placegraph/frontend/floor_plan/room_completion.h>

#include <opencv2/core.hpp>

namespace placegraph {
namespace room_completion_test {

/// Forty columns and thirty rows with a room over columns 5 to 29 and rows 5 to 19.
RoomGrid one_room() {
  RoomGrid grid;
  grid.rooms = cv::Mat1i(30, 40, 0);
  grid.blocked = cv::Mat1b(30, 40, static_cast<uchar>(0));
  grid.rooms(cv::Rect(5, 5, 25, 15)) = 1;
  grid.entered = {0, 1, 1};
  return grid;
}

const cv::Rect kShadow(12, 9, 7, 6);  // of furniture in the room

RoomGrid with_shadow(int of_room = 0) {
  RoomGrid grid = one_room();
  grid.rooms(kShadow) = of_room;
  return grid;
}

Image neck(int side = 3) { return Image(side, side, CV_8UC1, cv::Scalar(1)); }

int cells_of(const RoomGrid& grid, int room, const cv::Rect& part) {
  return cv::countNonZero(grid.rooms(part) == room);
}

TEST(FillShadows, GivesARoomWhatFurnitureHides) {
  RoomGrid grid = with_shadow();
  fill_shadows(grid, 1, neck(), 0.2);
  EXPECT_EQ(cv::countNonZero(grid.rooms != one_room().rooms), 0);
}

TEST(FillShadows, FillsABayButNoCorner) {
  RoomGrid grid = one_room();
  grid.rooms(cv::Rect(20, 9, 10, 6)) = 0;  // open to one side
  const cv::Mat1i before = grid.rooms.clone();
  fill_shadows(grid, 1, neck(), 0.2);
  EXPECT_EQ(cv::countNonZero(grid.rooms != before), 10 * 6);
  grid = one_room();
  grid.rooms(cv::Rect(20, 9, 20, 30 - 9)) = 0;
  const cv::Mat1i corner = grid.rooms.clone();
  fill_shadows(grid, 1, neck(), 0.2);
  EXPECT_EQ(cv::countNonZero(grid.rooms != corner), 0);
}

TEST(FillShadows, LeavesWhatWallsTakeMuchOfTheBorderOf) {
  RoomGrid grid = with_shadow();
  grid.blocked(cv::Rect(12, 8, 7, 1)) = 255;  // 7 of 26 cells of the border
  grid.rooms(cv::Rect(12, 8, 7, 1)) = 0;
  RoomGrid lenient = grid;
  lenient.rooms = grid.rooms.clone();
  fill_shadows(grid, 1, neck(), 0.2);
  EXPECT_EQ(cells_of(grid, 1, kShadow), 0);
  fill_shadows(lenient, 1, neck(), 0.3);
  EXPECT_EQ(cells_of(lenient, 1, kShadow), kShadow.area());
}

TEST(FillShadows, LeavesRoomsThatTheCameraWasIn) {
  RoomGrid grid = with_shadow(2);
  fill_shadows(grid, 1, neck(), 0.2);
  EXPECT_EQ(cells_of(grid, 2, kShadow), kShadow.area());
  grid.entered = {0, 1, 0};  // seen from afar only
  fill_shadows(grid, 1, neck(), 0.2);
  EXPECT_EQ(cells_of(grid, 1, kShadow), kShadow.area());
}

TEST(FillShadows, JoinsNothingAcrossAWall) {
  RoomGrid grid = with_shadow();
  grid.blocked(cv::Rect(15, 9, 1, 6)) = 255;   // down the middle
  grid.blocked(cv::Rect(12, 12, 7, 1)) = 255;  // and across
  fill_shadows(grid, 1, neck(), 1);
  EXPECT_EQ(cells_of(grid, 1, kShadow), 0);
}

TEST(FillShadows, JoinsNothingThroughANeck) {
  RoomGrid grid = one_room();
  grid.rooms.setTo(0);
  grid.rooms(cv::Rect(5, 5, 8, 10)) = 1;    // two parts of the room,
  grid.rooms(cv::Rect(15, 12, 8, 10)) = 1;  // three rows of which face each other
  const cv::Rect gap(13, 12, 2, 3);
  RoomGrid wide = grid;
  wide.rooms = grid.rooms.clone();
  fill_shadows(grid, 1, neck(5), 0.2);
  EXPECT_EQ(cells_of(grid, 1, gap), 0);
  fill_shadows(wide, 1, neck(3), 0.2);
  EXPECT_EQ(cells_of(wide, 1, gap), gap.area());
}

TEST(FillBoxes, CompletesABoxThatIsMostlyARoom) {
  const std::array<std::vector<int>, 2> cuts{{{20, 4}, {4, 14}}};  // columns 4 to 19, rows 4 to 13
  const cv::Rect box(4, 4, 16, 10);
  const auto filled = [&](int columns, bool entered) {
    RoomGrid grid = one_room();
    grid.rooms.setTo(0);
    grid.rooms(cv::Rect(4, 4, columns, 10)) = 1;
    grid.rooms(cv::Rect(1, 4, 3, 10)) = 1;  // most of what lies outside of all lines stays as it is
    grid.rooms(cv::Rect(22, 4, 17, 10)) = 1;
    grid.blocked(10, 19) = 255;
    grid.entered = {0, static_cast<char>(entered)};
    fill_boxes(grid, cuts, 0.5);
    EXPECT_EQ(cells_of(grid, 1, {0, 0, 40, 30}), cells_of(grid, 1, box) + 30 + 170);
    return cells_of(grid, 1, box);
  };
  EXPECT_EQ(filled(9, true), 159);  // all but the wall
  EXPECT_EQ(filled(7, true), 70);
  EXPECT_EQ(filled(9, false), 90);
}

TEST(FillBoxes, TakesNothingFromOtherRooms) {
  RoomGrid grid = one_room();
  grid.rooms.setTo(0);
  grid.rooms(cv::Rect(4, 4, 10, 10)) = 1;
  grid.rooms(cv::Rect(14, 4, 3, 10)) = 2;
  fill_boxes(grid, {{{4, 20}, {4, 14}}}, 0.5);
  EXPECT_EQ(cells_of(grid, 1, {4, 4, 16, 10}), 130);
  EXPECT_EQ(cells_of(grid, 2, {4, 4, 16, 10}), 30);
}

}  // namespace room_completion_test
}  // namespace placegraph
