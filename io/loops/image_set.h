#pragma once
#include <placegraph/graph/geometry/geodesy.h>
#include <placegraph/graph/geometry/trajectory.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The images of a set: their names, and where they were taken.
struct ImageSet {
  std::vector<std::string> names;  ///< files, in the order of the images; empty if unknown
  /// One pose per image [m]; x is east and y north where positions are geographic, and a heading
  /// turns about z. Empty if unknown.
  Trajectory poses;
  /// Positions on the ellipsoid, one per image; empty unless the source gives latitudes and
  /// longitudes, or UTM coordinates with their zones.
  std::vector<GeodeticPosition> positions;
  std::string zone;  ///< "32 N", the zone of all `poses` if they are UTM coordinates; else empty
  std::string form;  ///< what was read: "positions (t x y z)" and so on

  /// Number of images.
  std::size_t size() const { return names.empty() ? poses.size() : names.size(); }
};

/// Reads where the images of a set were taken, or how they are called.
///
/// `path` is a trajectory (read_trajectory, positions alone too); a table under a header that names
/// latitude and longitude, easting and northing, or x and y, and may name heading [deg, clockwise from
/// north], height and image; two columns without a header; a list of names, one a line; or a folder
/// of images. Names have positions in the convention of visual geo-localization (Berton et al. 2022):
/// `@ east @ north @ zone @ letter @ latitude @ longitude @ ... @ heading @ ...`, fields may be empty.
/// Throws FileError with the line.
ImageSet read_image_set(const std::string& path);

/// Puts the poses of two sets into one frame, so that distances between them are in metres.
///
/// UTM coordinates of one zone stay; positions in several zones, and latitudes and longitudes,
/// become east, north and up about the first position of `a`. Throws ArgumentError if only one of
/// the two is geographic, or a set has no positions.
void put_in_one_frame(ImageSet& a, ImageSet& b);

}  // namespace placegraph
