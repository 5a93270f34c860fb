#pragma once
#include <placegraph/io/exports/colmap_model.h>
#include <placegraph/io/exports/colmap_reader.h>
#include <placegraph/io/files/text_file.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace placegraph {

/// A model of cameras of COLMAP.
struct ColmapLens {
  const char* name;
  int id;                  ///< number in binary files
  std::size_t parameters;  ///< number of parameters
  std::size_t focal;       ///< number of focal lengths, before cx and cy; 0: images are not read
  Distortion distortion;   ///< what the parameters after cx and cy are
};

/// The model with a name; null if there is none.
const ColmapLens* find_colmap_lens(std::string_view name);

/// The cameras in a file, at least one, in its order.
/// Throws FileError, with the line in text, if the file is missing, truncated or malformed, has no
/// camera, an id twice, or in the binary form a model whose number of parameters is unknown.
std::vector<ColmapModel::RawCamera> read_binary_cameras(const std::string& path);
std::vector<ColmapModel::RawCamera> read_text_cameras(const std::string& path);

/// The id of a camera in a field of a text. Throws FileError if it is no id.
std::uint32_t colmap_camera_id(const TextFile& file, std::string_view field);

/// The camera of images. Throws FileError, with `path`, for a model that is not among the allowed
/// ones, an impossible size, and a focal length that is not positive.
Camera camera_of_colmap(const std::string& path, const ColmapModel::RawCamera& raw,
                        ColmapLenses lenses);

}  // namespace placegraph
