#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/log_message.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/pipeline/exports/keyframe_image_paths.h>

#include <filesystem>

namespace placegraph {

namespace fs = std::filesystem;

KeyframeImagePaths::KeyframeImagePaths(const MapOrigin& origin, std::string undistorted,
                                       const LogSink& log_sink)
    : sequence_(origin.sequence),
      undistorted_(std::move(undistorted)),
      dataset_(open_dataset(origin.sequence)) {
  if (origin.lens_k1 != 0 && undistorted_.empty())
    log(log_sink, LogLevel::kWarning,
        "{}: the exported camera is that of images without the lens distortion that the run "
        "removed "
        "(k1 = {:.4f}); the images still have it, --undistorted writes them without it",
        sequence_, origin.lens_k1);
}

std::string KeyframeImagePaths::sequence_path(FrameId frame) const {
  const std::int64_t index = frame.value();
  if (index < 0 || index >= static_cast<std::int64_t>(dataset_->size()))
    throw ArgumentError(
        fmt::format("{}: it has no frame {}, which is a keyframe of the map", sequence_, index));
  const std::string path = dataset_->image_path(static_cast<std::size_t>(index));
  if (!path.empty()) return path;
  const fs::path folder =
      fs::is_directory(sequence_) ? fs::path(sequence_) : fs::path(sequence_).parent_path();
  return (folder / fmt::format("frame_{:06}.png", index)).string();
}

std::string KeyframeImagePaths::path(FrameId frame) const {
  return undistorted_.empty() ? sequence_path(frame)
                              : (fs::path(undistorted_) / name(frame)).string();
}

std::string KeyframeImagePaths::name(FrameId frame) const {
  const fs::path image(sequence_path(frame));
  const fs::path folder =
      fs::is_directory(sequence_) ? fs::path(sequence_) : fs::path(sequence_).parent_path();
  const fs::path inside = fs::absolute(image).lexically_normal().lexically_relative(
      fs::absolute(folder / "").lexically_normal());
  fs::path name = inside.empty() || *inside.begin() == ".." ? image.filename() : inside;
  if (!undistorted_.empty()) name.replace_extension(".png");
  return name.string();
}

}  // namespace placegraph
