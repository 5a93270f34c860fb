#pragma once
#include <placegraph/graph/image/image.h>

#include <memory>
#include <optional>
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Writes a PNG file atomically, for any extension of `path`.
///
/// The image is CV_8U or CV_16U, grey, BGR or BGRA. `level` of zlib, 0 to 9; without one the file
/// is written fast: differences to the left neighbour, runs of equal bytes. Throws ArgumentError
/// for another type or an empty image, and FileError.
void write_png(const std::string& path, const Image& image, std::optional<int> level = {});

/// Writes a baseline JPEG file atomically, for any extension of `path`.
/// The image is CV_8UC1 or CV_8UC3 BGR; `quality` from 1 to 100. Throws as write_png().
void write_jpeg(const std::string& path, const Image& image, int quality);

/// Throws FileError, which names what is wanted, if the module that writes videos is missing.
void require_videos(const std::string& wanted);

/// A video file that is written frame by frame: Motion JPEG in .avi, H.264 in .mp4.
/// It appears under its path when it is finished, and not at all if it is not.
class VideoFile {
 public:
  /// Throws FileError if nothing can be written to `path`.
  explicit VideoFile(const std::string& path);
  ~VideoFile();
  VideoFile(const VideoFile&) = delete;
  VideoFile& operator=(const VideoFile&) = delete;
  /// Appends a frame, CV_8UC3 BGR of even sides, all of one size.
  /// The first one begins the video, 10 frames per second. Throws FileError if it cannot be
  /// written, or if the module that writes videos is missing.
  void write(const Image& frame);
  /// Completes the file, if it has a frame. Throws FileError.
  void finish();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace placegraph
