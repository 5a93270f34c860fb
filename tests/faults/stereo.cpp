// Faults of the right image.
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tests/faults/changes.h"
#include "tests/faults/fault.h"

namespace placegraph::faults {
namespace {

constexpr auto kStereo = "stereo";
constexpr auto kUnusable = "right_image_unusable|calibration_questionable";

/// The right images of other frames; those that would lie outside the sequence are of its ends.
Recording with_right_of(const Recording& recording, Span span, int offset) {
  return with_right(recording, span, [&](const Image&, std::size_t index) {
    const auto last = static_cast<int>(recording.size()) - 1;
    const int number = std::clamp(static_cast<int>(index) + offset, 0, last);
    return recording.frames[static_cast<std::size_t>(number)].right;
  });
}

/// The left image is that of the right camera, whose pose is the truth then.
Recording exchanged(const Recording& recording) {
  Recording out = recording;
  out.faulty = whole(recording);
  for (Frame& frame : out.frames) std::swap(frame.image, frame.right);
  for (Eigen::Isometry3d& T : out.T_world_cam)
    T.translate(Eigen::Vector3d(recording.calibration.baseline_m, 0, 0));
  return out;
}

Recording with_right_rows(const Recording& recording, double rows) {
  return with_right(recording, whole(recording), [rows](const Image& image, std::size_t) {
    return shifted(image, 0, rows, cv::INTER_LINEAR);
  });
}

Recording with_right_rotated(const Recording& recording, double angle_deg) {
  return with_right(recording, whole(recording), [angle_deg](const Image& image, std::size_t) {
    const double angle = angle_deg * CV_PI / 180, c = std::cos(angle), s = std::sin(angle);
    const double mid_u = 0.5 * image.cols, mid_v = 0.5 * image.rows;
    Eigen::Matrix3d H;
    H << c, -s, mid_u - c * mid_u + s * mid_v, s, c, mid_v - s * mid_u - c * mid_v, 0, 0, 1;
    return warped(image, H, cv::INTER_LINEAR);
  });
}

Recording with_right_gain(const Recording& recording, double gain) {
  return with_right(recording, whole(recording), [gain](const Image& image, std::size_t) {
    Image out;
    image.convertTo(out, -1, gain);
    return out;
  });
}

}  // namespace

std::vector<Fault> stereo_faults() {
  return {
      {"cameras_swapped", kStereo, "left and right images are exchanged", "cameras_swapped",
       [](const Recording& r, std::uint32_t) { return exchanged(r); }},
      {"right_late", kStereo, "the right image is a frame late", "right_image_late",
       [](const Recording& r, std::uint32_t) { return with_right_of(r, whole(r), -1); }},
      {"right_early", kStereo, "the right image is a frame early",
       "right_image_late|right_image_unusable",
       [](const Recording& r, std::uint32_t) { return with_right_of(r, whole(r), 1); }},
      {"right_late_later", kStereo, "the right image is a frame late in the second half",
       "right_image_late",
       [](const Recording& r, std::uint32_t) { return with_right_of(r, part(r, 0.5, 1), -1); }},
      {"right_rows_3", kStereo, "the right image is 3 rows lower", kUnusable,
       [](const Recording& r, std::uint32_t) { return with_right_rows(r, 3); }},
      {"right_rows_6", kStereo, "the right image is 6 rows lower", kUnusable,
       [](const Recording& r, std::uint32_t) { return with_right_rows(r, 6); }},
      {"right_rotated", kStereo, "the right image is rotated by 1 degree", kUnusable,
       [](const Recording& r, std::uint32_t) { return with_right_rotated(r, 1); }},
      {"right_black", kStereo, "the right image is black", "right_image_unusable|images_unusable",
       [](const Recording& r, std::uint32_t) { return with_right_gain(r, 0); }},
      {"right_black_later", kStereo, "the right image is black in the second half",
       "right_image_unusable|images_unusable",
       [](const Recording& r, std::uint32_t) {
         return with_right(r, part(r, 0.5, 1), [](const Image& image, std::size_t) {
           return Image(Image::zeros(image.size(), image.type()));
         });
       }},
      {"right_is_left", kStereo, "the right image is the left one", "right_image_unusable",
       [](const Recording& r, std::uint32_t) {
         return with_right(r, whole(r),
                           [&r](const Image&, std::size_t index) { return r.frames[index].image; });
       }},
      {"right_exposure", kStereo, "the right image gets a third of the light", "-",
       [](const Recording& r, std::uint32_t) { return with_right_gain(r, 0.33); }},
      {"right_blurred", kStereo, "the right image is out of focus", "right_image_unusable",
       [](const Recording& r, std::uint32_t) {
         return with_right(r, whole(r), [](const Image& image, std::size_t) {
           Image out;
           cv::GaussianBlur(image, out, {}, image.cols / 150.0);
           return out;
         });
       }},
  };
}

}  // namespace placegraph::faults
