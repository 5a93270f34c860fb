#pragma once
#include <placegraph/graph/image/image.h>

#include <array>
#include <vector>

namespace placegraph {

/// Rooms on a grid of partly visible cells: the room of each cell (0: none), and the barriers
/// between rooms.
struct RoomGrid {
  cv::Mat1i rooms;            ///< number of the room of each cell, from 1 on
  cv::Mat1b blocked;          ///< 255: in a wall or a door
  std::vector<char> entered;  ///< whether the camera was in the room, by its number
};

/// Fills the parts of a room that furniture hides.
///
/// Such a part is between cells of the room along a row or a column, with no wall and no other
/// entered room in between, is wide enough for `neck` (a structuring element), and borders mostly
/// on cells of the room; if walls are more than `walled_share` of its border it belongs to another
/// room.
void fill_shadows(RoomGrid& grid, int room, const Image& neck, double walled_share);

/// Adds whole boxes between the lines of walls to an entered room.
///
/// The free cells of a box are added if the room has more than `completed_share` of the box's
/// cells. `cuts`: columns and rows of the lines; cells outside of all lines are in no box.
void fill_boxes(RoomGrid& grid, const std::array<std::vector<int>, 2>& cuts,
                double completed_share);

/// Offsets to the cells that share a side with a cell.
inline const std::array<cv::Point, 4> kSideBySide{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

}  // namespace placegraph
