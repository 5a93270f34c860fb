#pragma once
#include <placegraph/graph/image/image.h>

#include <array>
#include <vector>

namespace placegraph {

/// Rooms on a grid of cells that are partly seen: which cells belong to which room (0: none), and
/// what parts them.
struct RoomGrid {
  cv::Mat1i rooms;            ///< number of the room of each cell, from 1 on
  cv::Mat1b blocked;          ///< 255: in a wall or a door
  std::vector<char> entered;  ///< by number of the room: whether the camera was in it
};

/// Gives a room what furniture hides of it. That lies between cells of the room along a row or a
/// column, with no wall and no other entered room in between, is wide enough for `neck` (a
/// structuring element) to fit in, and borders mostly on cells of the room; where walls take more
/// than `walled_share` of its border it is another room's.
void fill_shadows(RoomGrid& grid, int room, const Image& neck, double walled_share);

/// Boxes between the lines of walls become an entered room's own, as far as they are no room's, if
/// it has more than `completed_share` of their cells. `cuts`: columns and rows of the lines; what
/// lies outside of all lines is in no box.
void fill_boxes(RoomGrid& grid, const std::array<std::vector<int>, 2>& cuts,
                double completed_share);

/// The cells that share a side with a cell, from it.
inline const std::array<cv::Point, 4> kSideBySide{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

}  // namespace placegraph
