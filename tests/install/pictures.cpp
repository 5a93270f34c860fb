// Turns a folder of PNG images into the same ones as BMP and as a video: io and image of the
// installed library, and its module.
#include <placegraph/graph/internal/image/picture_plugin.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/internal/files/image_list.h>

#include <cstdio>
#include <filesystem>
#include <opencv2/imgproc.hpp>

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: pictures PNG_FOLDER BMP_FOLDER VIDEO.avi\n");
    return 2;
  }
  std::vector<placegraph::Image> frames;
  try {
    for (const std::string& path : placegraph::list_images(argv[1])) {
      const placegraph::Image grey = placegraph::read_image(path).grey;
      const std::filesystem::path name = std::filesystem::path(path).stem();
      placegraph::write_image((argv[2] / name).string() + ".bmp", grey);
      cv::cvtColor(grey, frames.emplace_back(), cv::COLOR_GRAY2BGR);
    }
    if (!placegraph::picture_plugin(argv[3]).write_video(argv[3], frames, 10)) return 1;
  } catch (const std::exception& error) {
    std::printf("%s\n", error.what());
    return 1;
  }
  std::printf("%zu pictures\n", frames.size());
  return 0;
}
