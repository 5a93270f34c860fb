#pragma once
#include <placegraph/io/datasets/dataset.h>

namespace placegraph {

/// Whether `path` is a file with a video's extension (avi mkv mov mp4 m4v mpg webm).
bool is_video_file(const std::string& path);

/// A video with its calibration in `VIDEO.EXT.yaml` or `VIDEO.yaml` beside it (schema in
/// docs/datasets.md; no right camera, no depth). All frames are decoded once to count them: the
/// count in the container is not trusted. Reading a frame costs one decoding if frames are read in
/// order; a step back decodes from the start. Stamps come from `fps` of the yaml, or else of the
/// container, or else 10 Hz. Throws FileError.
std::unique_ptr<Dataset> open_video_file(const std::string& path);

}  // namespace placegraph
