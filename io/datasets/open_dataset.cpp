#include <placegraph/io/datasets/euroc.h>
#include <placegraph/io/datasets/image_folder.h>
#include <placegraph/io/datasets/kitti_odometry.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/io/datasets/tum_rgbd.h>
#include <placegraph/io/datasets/video_file.h>
#include <placegraph/io/files/image_list.h>

#include <filesystem>

namespace placegraph {
namespace fs = std::filesystem;

std::unique_ptr<Dataset> open_dataset(const std::string& path) {
  if (!fs::exists(path)) throw FileError(path, "no such file or folder");
  if (is_video_file(path)) return open_video_file(path);
  if (is_euroc(path)) return open_euroc(path);
  if (is_tum_rgbd(path)) return open_tum_rgbd(path);
  if (is_kitti_odometry(path)) return open_kitti_odometry(path);
  if (is_image_folder(path)) return open_image_folder(path);
  const std::string around = fs::is_directory(path) ? images_around(path) : "";
  throw UnknownLayout(
      path,
      "no sequence is recognized here; looked for mav0/cam0 (EuRoC), rgb.txt or associations.txt "
      "(TUM), calib.txt with image_0 or image_2 (KITTI), calibration.yaml (images), or a video "
      "file (avi mkv mov mp4 m4v mpg webm)" +
          (around.empty() ? "" : "; there are " + around));
}

}  // namespace placegraph
