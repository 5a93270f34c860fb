#include <placegraph/graph/core/error.h>
#include <placegraph/io/calibration/camera_file.h>
#include <placegraph/io/files/text_file.h>

namespace placegraph {

Camera read_camera_file(const std::string& path) {
  TextFile file(path);
  std::string_view line;
  std::vector<std::string_view> fields;
  if (!file.next_data(line)) throw FileError(path, "no camera in it: fx fy cx cy width height");
  split_blank(line, fields);
  if (fields.size() != 6)
    file.fail("a camera has 6 numbers, fx fy cx cy width height, not " +
              std::to_string(fields.size()));
  constexpr std::int64_t kMaxSide = 1'000'000;
  Camera camera;
  camera.fx = file.number(fields[0], "fx");
  camera.fy = file.number(fields[1], "fy");
  camera.cx = file.number(fields[2], "cx");
  camera.cy = file.number(fields[3], "cy");
  const std::int64_t width = file.integer(fields[4], "width");
  const std::int64_t height = file.integer(fields[5], "height");
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide)
    file.fail("width and height: no image has " + std::to_string(width) + " by " +
              std::to_string(height) + " pixels");
  camera.width = static_cast<int>(width);
  camera.height = static_cast<int>(height);
  try {
    camera.check();
  } catch (const ArgumentError& error) {
    file.fail(error.what());
  }
  if (file.next_data(line)) file.fail("one camera expected");
  return camera;
}

}  // namespace placegraph
