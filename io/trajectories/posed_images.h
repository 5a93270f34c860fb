#pragma once
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/io/files/text_file.h>

namespace placegraph {

/// Whether a file is named as one of bytes, as COLMAP's images.bin is.
bool is_binary_model(const std::string& path);

/// Reads the poses of the images of COLMAP's images.bin: T_world_cam, x right, y down, z forward.
///
/// The frames are in the order of the images' names. Their stamps are the times that the names
/// consist of (nanoseconds, or decimal seconds, since 1970), otherwise the last whole numbers in
/// the names, as numbers of frames, otherwise 0, 1, 2, ... Throws FileError if the file is
/// truncated or malformed, holds no image, or if two images have one number.
Trajectory read_binary_images_poses(const std::string& path);

/// The same from COLMAP's images.txt, or from a transforms.json of radiance fields.
///
/// Cameras of transforms.json have OpenGL's axes (x right, y up, z back), which are changed to
/// those above. Nothing if the text is neither. Throws FileError with the line or the frame.
std::optional<Trajectory> read_posed_images(TextFile& file);

}  // namespace placegraph
