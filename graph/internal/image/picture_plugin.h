#pragma once
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/internal/image/decoded_pixels.h>

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
  /// Goes on to the next frame without converting it; false at the end.
  virtual bool grab() = 0;
  /// Goes on to the next frame and gives its pixels (CV_8UC3 BGR or CV_8UC1); false at the end.
  virtual bool read(Image& frame) = 0;
  /// Of the frame that was reached last, since the begin of the video [ms].
  virtual double time_ms() const = 0;
  virtual double rate_hz() const = 0;           ///< as the container says it; 0: it does not
  virtual double announced_frames() const = 0;  ///< as the container says it, often an estimate
};

/// What the module libplacegraph_opencv_plugin.so does for the library: it alone links OpenCV's
/// imgcodecs, videoio and ximgproc, which bring 200 libraries with them. No function throws.
struct PicturePlugin {
  virtual ~PicturePlugin() = default;
  /// The picture in the bytes, of any format OpenCV knows; empty if it is none.
  virtual Image decode(std::string_view bytes, DecodedPixels pixels) const = 0;
  /// The bytes of a file with this extension (".bmp"); empty if no format has it. `settings` are
  /// pairs of a number of cv::ImwriteFlags and its value.
  virtual std::string encode(const std::string& extension, const Image& image,
                             const std::vector<int>& settings) const = 0;
  /// Null if the file is no video that can be read.
  virtual std::unique_ptr<VideoReader> open_video(const std::string& path) const = 0;
  /// Writes frames (CV_8UC3 of one size) as a Motion JPEG video; false if that fails.
  virtual bool write_video(const std::string& path, const std::vector<Image>& frames,
                           double rate_hz) const = 0;
  /// SLIC superpixels of a CV_8UC3 picture in the Lab space: `index` becomes CV_32SC1, the result
  /// is their number (0: none could be cut).
  virtual int cut_superpixels(const Image& lab, int side_px, float ruler, int iterations,
                              Image& index) const = 0;
};

/// The version of PicturePlugin, and that of the OpenCV whose images it takes. It changes with
/// every change of what stands above.
constexpr std::int64_t kPicturePluginVersion =
    1'000'000 + 1'000 * CV_VERSION_MAJOR + CV_VERSION_MINOR;

constexpr const char* kPicturePluginFile = "libplacegraph_opencv_plugin.so";

/// The module, loaded when it is first asked for. Any thread may call it. `wanted` is what it is
/// needed for, as a rule the path of a file. Throws FileError, which names that, the module and the
/// folders of plugin_folders() if it is in none of them, or cannot be loaded.
const PicturePlugin& picture_plugin(const std::string& wanted);

/// Loads the module from the first of the folders that has it in kPicturePluginVersion. Throws like
/// picture_plugin().
const PicturePlugin& load_picture_plugin(const std::vector<std::string>& folders,
                                         const std::string& wanted);

}  // namespace placegraph
