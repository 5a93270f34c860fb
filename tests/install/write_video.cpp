// Writes a folder of pictures as a video, by OpenCV alone: something to read for the installed
// program.
#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: write_video FOLDER VIDEO.avi\n");
    return 2;
  }
  std::vector<cv::String> names;
  cv::glob(std::string(argv[1]) + "/*.bmp", names);
  cv::VideoWriter video;
  for (const cv::String& name : names) {
    const cv::Mat picture = cv::imread(name);
    if (!video.isOpened())
      video.open(argv[2], cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10, picture.size());
    video.write(picture);
  }
  return video.isOpened() ? 0 : 1;
}
