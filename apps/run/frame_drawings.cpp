#include "apps/run/frame_drawings.h"

#include <fmt/format.h>
#include <placegraph/eval/drawing/picture_bytes.h>
#include <placegraph/eval/drawing/picture_legend.h>
#include <placegraph/io/files/picture_file.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "apps/run/draw_frame.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;

bool is_video(const std::string& path) {
  const std::string extension = extension_of(path);
  return extension == ".avi" || extension == ".mp4";
}

/// Frames with the legend below, which is drawn once.
class Legended {
 public:
  explicit Legended(std::string wanted) : wanted_(std::move(wanted)) {}
  Image operator()(const Image& drawing) {
    if (strip_.empty()) strip_ = legend_strip(frame_legend(), {}, drawing.cols, wanted_);
    return stacked(drawing, strip_);
  }

 private:
  std::string wanted_;
  Image strip_;
};

class FolderDrawings : public FrameDrawings {
 public:
  explicit FolderDrawings(const std::string& path) : path_(path), folder_(path), legended_(path) {}
  void add(const Frame& frame, const FrameResult& result, const FrameView& view) override {
    const auto file = fs::path(path_) / fmt::format("{:06d}.png", frame.id.value());
    write_png(file.string(), legended_(draw_frame(frame, result, view)), 3);
  }
  void finish() override {}

 private:
  std::string path_;
  OutputFolder folder_;
  Legended legended_;
};

class VideoDrawings : public FrameDrawings {
 public:
  explicit VideoDrawings(const std::string& path) : file_(path), legended_(path) {}
  void add(const Frame& frame, const FrameResult& result, const FrameView& view) override {
    Image drawing = legended_(draw_frame(frame, result, view));
    // H.264 has a colour for every second pixel.
    cv::copyMakeBorder(drawing, drawing, 0, drawing.rows % 2, 0, drawing.cols % 2,
                       cv::BORDER_CONSTANT, cv::Scalar::all(255));
    file_.write(drawing);
  }
  void finish() override { file_.finish(); }

 private:
  VideoFile file_;
  Legended legended_;
};

class SheetDrawings : public FrameDrawings {
 public:
  SheetDrawings(std::string path, std::int64_t frames) : path_(std::move(path)), frames_(frames) {}
  void add(const Frame& frame, const FrameResult& result, const FrameView& view) override {
    // The k-th picture is the frame nearest to the share k / (count - 1) of the frames.
    const std::int64_t count = std::min(kPictures, frames_), next = std::ssize(pictures_);
    const std::int64_t wanted =
        count > 1 ? (next * (frames_ - 1) + (count - 1) / 2) / (count - 1) : 0;
    if (seen_++ != wanted || next == count) return;
    const Image drawing = draw_frame(frame, result, view);
    const double scale = std::min(1.0, kWidth_px / drawing.cols);
    pictures_.emplace_back();
    Image& picture = pictures_.back();
    cv::resize(drawing, picture, {}, scale, scale, cv::INTER_AREA);
    // The caption may be too small to be read now.
    for (const auto& [grey, width] : {std::pair(0, 4), std::pair(255, 1)})
      cv::putText(picture, fmt::format("frame {}", frame.id.value()), {8, picture.rows - 9},
                  cv::FONT_HERSHEY_SIMPLEX, 0.5, cv::Scalar::all(grey), width, cv::LINE_AA);
  }
  void finish() override {
    if (pictures_.empty()) return;
    const int width = pictures_.front().cols, height = pictures_.front().rows;
    const int columns = std::min<int>(kColumns, static_cast<int>(pictures_.size()));
    const int rows = (static_cast<int>(pictures_.size()) + columns - 1) / columns;
    Image sheet(rows * (height + kGap) - kGap, columns * (width + kGap) - kGap, CV_8UC3,
                cv::Scalar::all(255));
    for (int i = 0; i < static_cast<int>(pictures_.size()); ++i)
      pictures_[static_cast<std::size_t>(i)].copyTo(sheet(
          cv::Rect(i % columns * (width + kGap), i / columns * (height + kGap), width, height)));
    sheet = with_legend(sheet, frame_legend(), path_);
    constexpr int kQuality = 90;
    if (extension_of(path_) == ".png")
      write_png(path_, sheet, 6);
    else
      write_jpeg(path_, sheet, kQuality);
  }

 private:
  static constexpr std::int64_t kPictures = 24;
  static constexpr int kColumns = 4, kGap = 4;
  static constexpr double kWidth_px = 480;

  std::string path_;
  std::int64_t frames_ = 0, seen_ = 0;
  std::vector<Image> pictures_;
};

}  // namespace

bool is_drawing_file(const std::string& path) {
  const std::string extension = extension_of(path);
  return is_video(path) || extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

void require_free_drawings(const std::string& path, bool force) {
  for (const char* other :
       {".gif", ".mkv", ".webm", ".mov", ".mpg", ".pdf", ".svg", ".bmp", ".tif"})
    require(extension_of(path) != other,
            "--draw " + path + ": a folder, or a file .mp4, .avi, .jpg or .png");
  if (is_drawing_file(path))
    require_free(path, force);
  else
    require_free_folder(path, force);
  require_drawings(path);
  if (is_video(path)) require_videos(path);
}

std::unique_ptr<FrameDrawings> frame_drawings(const std::string& path, std::int64_t frames) {
  if (is_video(path)) return std::make_unique<VideoDrawings>(path);
  if (is_drawing_file(path)) return std::make_unique<SheetDrawings>(path, frames);
  return std::make_unique<FolderDrawings>(path);
}

}  // namespace placegraph::apps
