#pragma once
#include <placegraph/io/datasets/dataset.h>

namespace placegraph {

/// Whether a folder contains `calibration.yaml`.
bool is_image_folder(const std::string& folder);

/// A folder of images, in natural order of their names, with a `calibration.yaml` (schema in
/// docs/datasets.md); images of the right camera in `right/`, 16-bit depth images in `depth/`,
/// `times.txt` [s], ground truth in `poses.txt` (KITTI format, T_world_cam). Throws FileError.
std::unique_ptr<Dataset> open_image_folder(const std::string& folder);

}  // namespace placegraph
