#pragma once
#include <placegraph/graph/image/decoded_pixels.h>
#include <placegraph/graph/image/image.h>

#include <cstdint>
#include <memory>
#include <opencv2/core/version.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace placegraph {

/// The frames of a video in their order.
class VideoReader {
 public:
  virtual ~VideoReader() = default;
  /// Advances to the next frame without converting it; false at the end.
  virtual bool grab() = 0;
  /// Advances to the next frame and returns its pixels (CV_8UC3 BGR or CV_8UC1); false at the end.
  virtual bool read(Image& frame) = 0;
  /// Time of the present frame since the begin of the video [ms].
  virtual double time_ms() const = 0;
  virtual double rate_hz() const = 0;  ///< frame rate stated by the container; 0: not stated
  /// Frame count stated by the container, often an estimate.
  virtual double announced_frames() const = 0;
};

/// A video that is written frame by frame.
class VideoWriter {
 public:
  virtual ~VideoWriter() = default;
  /// Appends a frame (CV_8UC3, of the video's size); false if that fails.
  virtual bool write(const Image& frame) = 0;
  /// Completes the file; false if that fails. The last call.
  virtual bool finish() = 0;
};

/// Interface of the module libplacegraph_opencv_plugin.so. Only the module links OpenCV's
/// imgcodecs, videoio and ximgproc, which depend on 200 libraries. No function throws.
struct PicturePlugin {
  virtual ~PicturePlugin() = default;
  /// The picture in the bytes, in any format of OpenCV; empty if they are not a picture.
  virtual Image decode(std::string_view bytes, DecodedPixels pixels) const = 0;
  /// The bytes of a file with this extension (".bmp"); empty if no format has it. `settings` are
  /// pairs of a number of cv::ImwriteFlags and its value.
  virtual std::string encode(const std::string& extension, const Image& image,
                             const std::vector<int>& settings) const = 0;
  /// Opens a video file; null if the file is not a readable video.
  virtual std::unique_ptr<VideoReader> open_video(const std::string& path) const = 0;
  /// Writes frames (CV_8UC3 of one size) as a Motion JPEG video; false if that fails.
  virtual bool write_video(const std::string& path, const std::vector<Image>& frames,
                           double rate_hz) const = 0;
  /// Begins a video of frames of this size: Motion JPEG in .avi, H.264 in .mp4, of which both sides
  /// are even. Null if the file cannot be opened or has another extension.
  virtual std::unique_ptr<VideoWriter> create_video(const std::string& path, int width, int height,
                                                    double rate_hz) const = 0;
  /// SLIC superpixels of a CV_8UC3 picture in the Lab space: `index` becomes CV_32SC1, the result
  /// is their number (0: failure).
  virtual int cut_superpixels(const Image& lab, int side_px, float ruler, int iterations,
                              Image& index) const = 0;
};

/// The version of PicturePlugin, and that of the OpenCV whose images it takes. It changes with
/// every change of the declarations above.
constexpr std::int64_t kPicturePluginVersion =
    2'000'000 + 1'000 * CV_VERSION_MAJOR + CV_VERSION_MINOR;

constexpr const char* kPicturePluginFile = "libplacegraph_opencv_plugin.so";

/// The module, loaded by the first call. Any thread may call this function. `wanted` names the
/// purpose, usually the path of a file. Throws FileError, which names `wanted`, the module and the
/// folders of plugin_folders(), if the module is in none of them or cannot be loaded.
const PicturePlugin& picture_plugin(const std::string& wanted);

/// Loads the module from the first of the folders that has it in kPicturePluginVersion. Throws like
/// picture_plugin().
const PicturePlugin& load_picture_plugin(const std::vector<std::string>& folders,
                                         const std::string& wanted);

}  // namespace placegraph
