#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/log.h>
#include <placegraph/io/datasets/dataset.h>
#include <placegraph/io/map/stored_map.h>

#include <memory>
#include <string>

namespace placegraph {

/// Where the images of a map's keyframes are.
class KeyframeImagePaths {
 public:
  /// Opens the sequence of the map. `undistorted` is the folder of the images without distortion
  /// (write_undistorted); if it is empty, warns if the run removed a lens distortion that the
  /// images still have. Throws FileError if the sequence is no longer there.
  explicit KeyframeImagePaths(const MapOrigin& origin, std::string undistorted = "",
                              const LogSink& log_sink = {});

  /// The image of a frame; frame_NUMBER.png in the folder of the sequence for a video. In the
  /// folder of the undistorted images it has the same name, and the extension .png.
  /// Throws ArgumentError for a frame beyond the end of the sequence.
  std::string path(FrameId frame) const;
  /// The same from the folder of the sequence, or from that of the undistorted images.
  std::string name(FrameId frame) const;
  const Dataset& dataset() const { return *dataset_; }

 private:
  std::string sequence_path(FrameId frame) const;

  std::string sequence_, undistorted_;
  std::unique_ptr<Dataset> dataset_;
};

}  // namespace placegraph
