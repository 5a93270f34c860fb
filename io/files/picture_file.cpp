#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/jpeg_codec.h>
#include <placegraph/graph/image/picture_plugin.h>
#include <placegraph/graph/image/png_codec.h>
#include <placegraph/io/files/atomic_file.h>
#include <placegraph/io/files/output_file.h>
#include <placegraph/io/files/picture_file.h>

namespace placegraph {

void write_png(const std::string& path, const Image& image, std::optional<int> level) {
  write_file(path, encode_png(image, {.level = level}));
}

void write_jpeg(const std::string& path, const Image& image, int quality) {
  write_file(path, encode_jpeg(image, quality));
}

void require_videos(const std::string& wanted) { (void)picture_plugin(wanted); }

struct VideoFile::Parts {
  explicit Parts(const std::string& path_of_video) : path(path_of_video), file(path_of_video) {}
  std::string path;
  AtomicFile file;  ///< closed after the video
  std::unique_ptr<VideoWriter> video;
};

VideoFile::VideoFile(const std::string& path) : parts_(std::make_unique<Parts>(path)) {}
VideoFile::~VideoFile() = default;

void VideoFile::write(const Image& frame) {
  constexpr double kRate_hz = 10;
  auto& [path, file, video] = *parts_;
  if (!video)
    video =
        picture_plugin(path).create_video(file.temporary_path(), frame.cols, frame.rows, kRate_hz);
  if (!video) throw FileError(path, "no video can be written there");
  if (!video->write(frame)) throw FileError(path, "a frame of the video cannot be written");
}

void VideoFile::finish() {
  auto& [path, file, video] = *parts_;
  if (!video) return;
  if (!video->finish()) throw FileError(path, "the video cannot be written");
  video.reset();
  file.commit();
}

}  // namespace placegraph
