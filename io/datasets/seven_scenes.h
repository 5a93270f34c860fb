#pragma once
#include <placegraph/io/datasets/dataset.h>

namespace placegraph {

/// Whether a folder contains `frame-000000.color.png`: a sequence of 7-Scenes.
bool is_seven_scenes(const std::string& folder);

/// A sequence of 7-Scenes (Shotton et al. 2013), `seq-01`: `frame-NNNNNN.color.png`, `.depth.png`
/// [mm] and `.pose.txt` (T_world_cam, 4x4), at 30 Hz by the frames' numbers. The data include no
/// calibration: `calibration.yaml` in the folder or the one above it is used, else focal lengths of
/// 525 px for colour and 585 px for depth at 640 x 480 with the principal point in the middle of
/// the image, and a note is added; depth is not registered to colour. Frames without a colour or
/// depth image are skipped and counted. Throws FileError.
std::unique_ptr<Dataset> open_seven_scenes(const std::string& folder);

}  // namespace placegraph
