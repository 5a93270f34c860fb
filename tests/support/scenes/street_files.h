#pragma once
#include <iomanip>
#include <sstream>

#include "tests/support/scenes/street.h"
#include "tests/unit/io/datasets/tiny_images.h"

namespace placegraph::test {

/// The first frames of the street as pictures for a folder on disk.
class StreetFiles {
 public:
  StreetFiles(const TemporaryFolder& folder, int frames) : folder_(folder), frames_(frames) {
    for (int i = 0; i < frames; ++i)
      left_.push_back(render(street_camera(), street_T_world_cam(i), street(), 2));
  }

  const Image& left(int i) const { return left_[static_cast<std::size_t>(i)].grey; }
  Image right(int i) const {
    const SE3 T_left_right = pose({0, 0, 0}, {kStreetBaseline_m, 0, 0});
    return render(street_camera(), street_T_world_cam(i) * T_left_right, street(), 2).grey;
  }
  /// 16 bits, so many steps a metre.
  Image depth(int i, double steps_per_m) const {
    Image steps;
    left_[static_cast<std::size_t>(i)].depth.convertTo(steps, CV_16UC1, steps_per_m);
    return steps;
  }
  static std::string name(int i) { return "00000" + std::to_string(i) + ".png"; }

  /// s/calib.txt, s/image_0 and, for two eyes, s/image_1.
  void write_kitti(bool stereo) const {
    const Camera c = street_camera();
    const auto P = [&](int camera_number) {
      std::ostringstream line;
      line << std::setprecision(12) << "P" << camera_number << ": " << c.fx << " 0 " << c.cx << " "
           << -c.fx * kStreetBaseline_m * camera_number << " 0 " << c.fy << " " << c.cy
           << " 0 0 0 1 0\n";
      return line.str();
    };
    folder_.write("s/calib.txt", P(0) + (stereo ? P(1) : ""));
    for (int i = 0; i < frames_; ++i) {
      write_image(folder_, "s/image_0/" + name(i), left(i));
      if (stereo) write_image(folder_, "s/image_1/" + name(i), right(i));
    }
  }

 private:
  const TemporaryFolder& folder_;
  int frames_;
  std::vector<Picture> left_;
};

}  // namespace placegraph::test
