// The module libplacegraph_opencv_plugin.so, see picture_plugin.h. It depends on OpenCV alone.
#include <placegraph/graph/image/picture_plugin.h>

#include <cstdlib>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <opencv2/ximgproc/slic.hpp>

namespace placegraph {
namespace {

int imread_flags(DecodedPixels pixels) {
  if (pixels == DecodedPixels::kAsStored) return cv::IMREAD_UNCHANGED;
  const int flags = cv::IMREAD_ANYCOLOR | cv::IMREAD_IGNORE_ORIENTATION;
  return pixels == DecodedPixels::kEightBits ? flags : flags | cv::IMREAD_ANYDEPTH;
}

class CaptureReader : public VideoReader {
 public:
  explicit CaptureReader(cv::VideoCapture capture) : capture_(std::move(capture)) {}
  bool grab() override {
    try {
      return capture_.grab();
    } catch (const cv::Exception&) {
      return false;
    }
  }
  bool read(Image& frame) override {
    try {
      return capture_.read(frame);
    } catch (const cv::Exception&) {
      return false;
    }
  }
  double time_ms() const override { return capture_.get(cv::CAP_PROP_POS_MSEC); }
  double rate_hz() const override { return capture_.get(cv::CAP_PROP_FPS); }
  double announced_frames() const override { return capture_.get(cv::CAP_PROP_FRAME_COUNT); }

 private:
  cv::VideoCapture capture_;
};

class FileWriter : public VideoWriter {
 public:
  FileWriter(const std::string& path, int codec, cv::Size size, double rate_hz)
      : writer_(path, cv::CAP_FFMPEG, codec, rate_hz, size), path_(path), size_(size) {}
  bool opened() const { return writer_.isOpened(); }
  bool write(const Image& frame) override {
    if (frame.size() != size_ || frame.type() != CV_8UC3) return false;
    try {
      writer_.write(frame);
      ++frames_;
      return true;
    } catch (const cv::Exception&) {
      return false;
    }
  }
  /// The library does not report a full disk: the file is read again.
  bool finish() override {
    try {
      writer_.release();
      cv::VideoCapture written(path_, cv::CAP_FFMPEG);
      return written.isOpened() &&
             static_cast<int>(written.get(cv::CAP_PROP_FRAME_COUNT)) == frames_;
    } catch (const cv::Exception&) {
      return false;
    }
  }

 private:
  cv::VideoWriter writer_;
  std::string path_;
  cv::Size size_;
  int frames_ = 0;
};

/// Damaged files are reported by the caller, which knows their names.
void silence_libraries() {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  constexpr const char* kQuiet = "-8";  // AV_LOG_QUIET
  setenv("OPENCV_FFMPEG_LOGLEVEL", kQuiet, 0);
}

struct OpenCvPlugin : PicturePlugin {
  OpenCvPlugin() { silence_libraries(); }

  Image decode(std::string_view bytes, DecodedPixels pixels) const override {
    try {
      // imdecode() only reads the buffer.
      const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8UC1,
                           const_cast<char*>(bytes.data()));
      return cv::imdecode(buffer, imread_flags(pixels));
    } catch (const cv::Exception&) {
      return {};
    }
  }

  std::string encode(const std::string& extension, const Image& image,
                     const std::vector<int>& settings) const override {
    try {
      std::vector<unsigned char> bytes;
      if (!cv::imencode(extension, image, bytes, settings)) return {};
      return {bytes.begin(), bytes.end()};
    } catch (const cv::Exception&) {
      return {};
    }
  }

  /// Tries the two readers that decode the same bits everywhere and print nothing about bad files.
  std::unique_ptr<VideoReader> open_video(const std::string& path) const override {
    for (const int reader : {cv::CAP_FFMPEG, cv::CAP_OPENCV_MJPEG}) {
      try {
        cv::VideoCapture capture(path, reader);
        if (capture.isOpened()) return std::make_unique<CaptureReader>(std::move(capture));
      } catch (const cv::Exception&) {  // this reader is missing or cannot read the file
      }
    }
    return nullptr;
  }

  bool write_video(const std::string& path, const std::vector<Image>& frames,
                   double rate_hz) const override {
    try {
      if (frames.empty()) return false;
      cv::VideoWriter writer(path, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), rate_hz,
                             frames.front().size());
      if (!writer.isOpened()) return false;
      for (const Image& frame : frames) writer.write(frame);
      return true;
    } catch (const cv::Exception&) {
      return false;
    }
  }

  std::unique_ptr<VideoWriter> create_video(const std::string& path, int width, int height,
                                            double rate_hz) const override {
    const bool mp4 = path.ends_with(".mp4");
    if (!mp4 && !path.ends_with(".avi")) return nullptr;
    const int codec = mp4 ? cv::VideoWriter::fourcc('a', 'v', 'c', '1')
                          : cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
    try {
      auto writer = std::make_unique<FileWriter>(path, codec, cv::Size(width, height), rate_hz);
      return writer->opened() ? std::move(writer) : nullptr;
    } catch (const cv::Exception&) {
      return nullptr;
    }
  }

  int cut_superpixels(const Image& lab, int side_px, float ruler, int iterations,
                      Image& index) const override {
    try {
      const auto slic = cv::ximgproc::createSuperpixelSLIC(lab, cv::ximgproc::SLIC, side_px, ruler);
      slic->iterate(iterations);
      slic->enforceLabelConnectivity(25);
      slic->getLabels(index);
      return slic->getNumberOfSuperpixels();
    } catch (const cv::Exception&) {
      return 0;
    }
  }
};

}  // namespace
}  // namespace placegraph

extern "C" __attribute__((visibility("default"))) std::int64_t placegraph_picture_plugin_version() {
  return placegraph::kPicturePluginVersion;
}

extern "C" __attribute__((visibility("default"))) const void* placegraph_picture_plugin() {
  static const placegraph::OpenCvPlugin plugin;
  return static_cast<const placegraph::PicturePlugin*>(&plugin);
}
