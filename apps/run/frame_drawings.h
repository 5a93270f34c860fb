#pragma once
#include <placegraph/graph/image/frame.h>
#include <placegraph/pipeline/cues/frame_view.h>
#include <placegraph/pipeline/slam.h>

#include <cstdint>
#include <memory>
#include <string>

namespace placegraph::apps {

/// Where the frames of a run are drawn: pictures in a folder, a video or a contact sheet.
class FrameDrawings {
 public:
  virtual ~FrameDrawings() = default;
  virtual void add(const Frame& frame, const FrameResult& result, const FrameView& view) = 0;
  /// Completes a file. Without this call there is none.
  virtual void finish() = 0;
};

/// Whether a name is that of a file: .avi or .mp4 for a video, .jpg, .jpeg or .png for a sheet.
bool is_drawing_file(const std::string& path);

/// Checks a name before any work. Throws ArgumentError, FileError if a module is missing.
void require_free_drawings(const std::string& path, bool force);

/// Drawings of `frames` frames with a legend of their colours.
/// A folder gets NNNNNN.png by the number of the frame. A video shows ten frames a second (.avi:
/// Motion JPEG, .mp4: H.264). A contact sheet shows 24 frames at equal distances, four in a row.
/// Throws FileError.
std::unique_ptr<FrameDrawings> frame_drawings(const std::string& path, std::int64_t frames);

}  // namespace placegraph::apps
