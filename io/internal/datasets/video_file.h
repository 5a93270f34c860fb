#pragma once
#include <placegraph/io/datasets/dataset.h>

namespace placegraph {

/// Whether `path` is a file with a video's extension (avi mkv mov mp4 m4v mpg webm).
bool is_video_file(const std::string& path);

/// A video with its calibration in `VIDEO.EXT.yaml` or `VIDEO.yaml` beside it (schema in
/// docs/datasets.md; no right eye, no depth). All frames are decoded once to count them: what a
/// container claims is not trusted. Frames read in order cost one decoding each, a step back
/// decodes from the start. Stamps come from `fps`, of the yaml or else of the container, else 10
/// Hz. Throws FileError.
std::unique_ptr<Dataset> open_video_file(const std::string& path);

}  // namespace placegraph
