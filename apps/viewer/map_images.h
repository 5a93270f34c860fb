#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/io/datasets/dataset.h>
#include <placegraph/io/map/stored_map.h>
#include <placegraph/pipeline/lens_correction.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace placegraph::apps {

/// The images of a map, as its run used them, from the recording where that is still at its place.
class MapImages {
 public:
  explicit MapImages(const MapOrigin& origin);

  /// The (left) image of a frame as a JPEG file; nothing if the recording does not have the frame,
  /// or is not at its place any more. Any thread may call this function.
  ///
  /// Throws Error if the recording or the image cannot be read.
  std::optional<std::string> jpeg(FrameId frame);

 private:
  std::string sequence_;
  Sensor sensor_;
  double lens_k1_;
  std::mutex mutex_;  // guards the recording
  std::unique_ptr<Dataset> dataset_;
  std::optional<LensCorrection> lens_;
};

}  // namespace placegraph::apps
