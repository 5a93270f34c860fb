#pragma once
#include <placegraph/frontend/align/plane_tracker.h>

#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

struct TrackPlaneArguments {
  std::string in;       ///< sequence, or folder of images
  std::string corners;  ///< corners of the region in cyclic order, "x1,y1,...,x4,y4" [px]
  std::string image;    ///< image of the corners; empty: the first one of the sequence
  /// Calibration file, or empty for the sequence's own. Without a value no motion is estimated.
  std::optional<std::string> calib;
  std::string
      normal;  ///< normal of the plane in the camera of the template, "nx,ny,nz"; empty: unknown
  PlaneTrackerOptions options;
  std::string out;         ///< file with one line per frame, see track_lines()
  std::string trajectory;  ///< file for the poses of the camera, .tum or KITTI form; empty: none
  std::string draw;        ///< folder for frames with the outline of the region; empty: none
  bool force = false;      ///< overwrite the output files
};

struct TrackPlaneResult {
  std::string in;
  std::vector<PlaneTrack> tracks;  ///< one track per frame
  double least_similarity = 0,
         least_similarity_found =
             0;  ///< smallest similarity to track a region, and to find it again
  double cpu_ms_per_frame = 0;
  std::size_t tracked() const;  ///< number of tracked frames
};

/// Tracks a planar region through a sequence: `placegraph track plane`.
/// Progress goes to stderr. Throws ArgumentError, FileError, and NoResult if the template has too
/// little texture or is in no frame; then nothing is written.
TrackPlaneResult track_plane(const TrackPlaneArguments& arguments);

/// Some lines.
std::string to_text(const TrackPlaneResult& result);
std::string to_json(const TrackPlaneResult& result);

}  // namespace placegraph::apps
