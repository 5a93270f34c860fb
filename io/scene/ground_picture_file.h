#pragma once
#include <placegraph/graph/image/ground_picture.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Reads a picture of the ground with its place in the world.
///
/// `path` is the description of an occupancy grid as map_server of ROS reads it (.yaml: image,
/// resolution, origin with its yaw, negate, occupied_thresh, free_thresh, mode), or a picture
/// beside a world file (tile.png and tile.pgw, tile.jpg and tile.jgw, tile.tif and tile.tfw, or
/// .wld). With `corners_m` (x and y of the outer lower left corner, then of the upper right one) a
/// picture needs no world file. Of a grid what is free becomes white, what is occupied dark, and
/// what is unknown light grey. Pictures of more than 1600 pixels a side become smaller. Throws
/// FileError, with the line of a text file, for what is missing, malformed or without extent;
/// ArgumentError for corners that are not four numbers in order, or given for a grid.
GroundPicture read_ground_picture(const std::string& path,
                                  const std::vector<double>& corners_m = {});

}  // namespace placegraph
