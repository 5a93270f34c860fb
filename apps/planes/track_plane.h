#pragma once
#include <placegraph/frontend/internal/align/plane_tracker.h>

#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

struct TrackPlaneArguments {
  std::string in;       ///< a sequence, or a folder of images
  std::string corners;  ///< "x1,y1,...,x4,y4": of the region, around it [px]
  std::string image;    ///< image that the corners are of; empty: the first of the sequence
  /// File of the camera, or empty: the sequence's own. Nothing: no motion is sought.
  std::optional<std::string> calib;
  std::string normal;  ///< "nx,ny,nz": the plane's, in the camera of the template; empty: not known
  PlaneTrackerOptions options;
  std::string out;         ///< file with a line a frame, see track_lines()
  std::string trajectory;  ///< poses of the camera, .tum or KITTI's form; empty: none
  std::string draw;        ///< folder for the frames with the region's outline; empty: none
  bool force = false;      ///< overwrite what is written
};

struct TrackPlaneResult {
  std::string in;
  std::vector<PlaneTrack> tracks;                           ///< of each frame
  double least_similarity = 0, least_similarity_found = 0;  ///< to be tracked, to be found again
  double cpu_ms_per_frame = 0;
  std::size_t tracked() const;  ///< frames
};

/// `placegraph track-plane`: follows a planar region through a sequence, with progress on stderr.
/// Throws ArgumentError, FileError, and NoAnswer where the template has too little texture or is in
/// no frame; then nothing is written.
TrackPlaneResult track_plane(const TrackPlaneArguments& arguments);

/// Some lines.
std::string to_text(const TrackPlaneResult& result);
std::string to_json(const TrackPlaneResult& result);

}  // namespace placegraph::apps
