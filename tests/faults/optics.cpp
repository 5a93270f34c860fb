// Faults of the image: exposure, sharpness, noise, colour, transmission.
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tests/faults/changes.h"
#include "tests/faults/fault.h"

namespace placegraph::faults {
namespace {

constexpr auto kAll = "mono stereo rgbd";
constexpr auto kUnusable = "images_unusable|few_posed|lost_frames|components";
constexpr auto kDegraded = "images_unusable|drift_large|jump|scale_questionable|few_posed";

Image black(const Image& image, std::size_t) { return Image::zeros(image.size(), image.type()); }

Image with_gain(const Image& image, double gain, double offset = 0) {
  Image out;
  image.convertTo(out, -1, gain, offset);
  return out;
}

Image with_noise(const Image& image, double sigma, std::uint32_t seed, std::size_t index) {
  cv::RNG random = random_of(seed, index);
  Image noise(image.size(), CV_16SC1), out;
  random.fill(noise, cv::RNG::NORMAL, 0, sigma);
  cv::add(image, noise, out, cv::noArray(), CV_8U);
  return out;
}

/// Horizontal motion during the exposure, by a fraction of the image's width.
Image with_motion_blur(const Image& image, double fraction) {
  const int length = std::max(3, static_cast<int>(std::lround(image.cols * fraction)));
  Image out;
  cv::blur(image, out, {length, 1});
  return out;
}

Image defocused(const Image& image, double fraction) {
  Image out;
  cv::GaussianBlur(image, out, {}, image.cols * fraction);
  return out;
}

Image coloured(const Image& image, std::size_t) {
  Image out;
  cv::merge(std::vector<Image>{with_gain(image, 0.3), with_gain(image, 0.6), with_gain(image, 1.5)},
            out);
  return out;
}

/// Darkens the image away from its middle, down to a tenth in the corners.
Image with_vignette(const Image& image, std::size_t) {
  Image out = image.clone();
  const double mid_u = 0.5 * (image.cols - 1), mid_v = 0.5 * (image.rows - 1);
  for (int v = 0; v < out.rows; ++v) {
    for (int u = 0; u < out.cols; ++u) {
      const double du = (u - mid_u) / mid_u, dv = (v - mid_v) / mid_v,
                   r2 = 0.5 * (du * du + dv * dv);
      out.at<uchar>(v, u) = static_cast<uchar>(image.at<uchar>(v, u) * (1 - 0.9 * r2));
    }
  }
  return out;
}

/// Rows that were not transmitted repeat the last one that was.
Image with_lost_rows(const Image& image, std::uint32_t seed, std::size_t index) {
  cv::RNG random = random_of(seed, index);
  Image out = image.clone();
  for (int v = 1; v < out.rows; ++v)
    if (random.uniform(0.0, 1.0) < 0.25) out.row(v - 1).copyTo(out.row(v));
  return out;
}

/// Every row is read later than the one above it, the last a whole frame later: it shows the
/// scene after the rotation that the camera has done by then. Translations are left out.
Recording with_rolling_shutter(const Recording& recording) {
  if (recording.T_world_cam.empty()) return recording;
  const std::vector<Eigen::Isometry3d>& T = recording.T_world_cam;
  const Camera& camera = recording.calibration.camera;
  return with_images(recording, whole(recording), [&](const Image& image, std::size_t index) {
    const std::size_t begin = index + 1 < T.size() ? index : index - (index > 0);
    const std::size_t end = std::min(begin + 1, T.size() - 1);
    const Eigen::Matrix3d R = T[begin].linear().transpose() * T[end].linear();
    const double yaw = 0.5 * (R(0, 2) - R(2, 0)), pitch = 0.5 * (R(2, 1) - R(1, 2));
    Image u_of(image.size(), CV_32FC1), v_of(image.size(), CV_32FC1), out;
    for (int v = 0; v < image.rows; ++v) {
      const double time = static_cast<double>(v) / image.rows;
      for (int u = 0; u < image.cols; ++u) {
        u_of.at<float>(v, u) = static_cast<float>(u + camera.fx * yaw * time);
        v_of.at<float>(v, u) = static_cast<float>(v - camera.fy * pitch * time);
      }
    }
    cv::remap(image, out, u_of, v_of, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    return out;
  });
}

/// A gain for each frame.
Recording with_gains(const Recording& recording, const std::function<double(std::size_t)>& gain) {
  return with_images(recording, whole(recording), [&](const Image& image, std::size_t index) {
    return with_gain(image, gain(index));
  });
}

Recording flickering(const Recording& recording, std::uint32_t seed) {
  return with_gains(recording, [seed](std::size_t index) {
    cv::RNG random = random_of(seed, index);
    return random.uniform(0.6, 1.4);
  });
}

std::vector<Fault> exposure_faults() {
  return {
      {"black_few", kAll, "five black images in the middle", kUnusable,
       [](const Recording& r, std::uint32_t) { return with_images(r, middle(r, 5), black); }},
      {"black_many", kAll, "three tenths of the images are black", kUnusable,
       [](const Recording& r, std::uint32_t) { return with_images(r, part(r, 0.4, 0.7), black); }},
      {"black_begin", kAll, "the first tenth of the images is black", kUnusable,
       [](const Recording& r, std::uint32_t) { return with_images(r, part(r, 0, 0.1), black); }},
      {"exposure_steps", kAll, "gain 0.4 and 1.6 in turn, for 20 images each", kDegraded,
       [](const Recording& r, std::uint32_t) {
         return with_gains(r, [](std::size_t i) { return i / 20 % 2 == 0 ? 0.4 : 1.6; });
       }},
      {"gain_drift", kAll, "the gain falls from 1.5 to 0.15", kDegraded,
       [](const Recording& r, std::uint32_t) {
         const double size = static_cast<double>(r.size());
         return with_gains(r, [size](std::size_t i) {
           return 1.5 * std::pow(0.1, static_cast<double>(i) / size);
         });
       }},
      {"flicker", kAll, "the gain varies by 40 % from image to image", kDegraded, flickering},
      {"saturation", kAll, "gain 4: bright surfaces are white", kDegraded,
       [](const Recording& r, std::uint32_t) {
         return with_gains(r, [](std::size_t) { return 4; });
       }},
      {"low_contrast", kAll, "all grey levels lie within 20 of each other", kDegraded,
       [](const Recording& r, std::uint32_t) {
         return with_images(r, whole(r), [](const Image& image, std::size_t) {
           return with_gain(image, 20.0 / 255, 100);
         });
       }},
      {"night", kAll, "a tenth of the light, with noise", kDegraded,
       [](const Recording& r, std::uint32_t seed) {
         return with_images(r, whole(r), [seed](const Image& image, std::size_t i) {
           return with_noise(with_gain(image, 0.1), 4, seed, i);
         });
       }},
  };
}

std::vector<Fault> sharpness_faults() {
  return {
      {"motion_blur", kAll, "horizontal blur over 3 % of the width", kDegraded,
       [](const Recording& r, std::uint32_t) {
         return with_images(r, whole(r),
                            [](const Image& i, std::size_t) { return with_motion_blur(i, 0.03); });
       }},
      {"motion_blur_burst", kAll,
       "horizontal blur over 10 % of the width for a sixth of the images", kDegraded,
       [](const Recording& r, std::uint32_t) {
         return with_images(r, part(r, 0.5, 0.67),
                            [](const Image& i, std::size_t) { return with_motion_blur(i, 0.1); });
       }},
      {"defocus", kAll, "Gaussian blur, sigma 0.8 % of the width", kDegraded,
       [](const Recording& r, std::uint32_t) {
         return with_images(r, whole(r),
                            [](const Image& i, std::size_t) { return defocused(i, 0.008); });
       }},
      {"defocus_later", kAll, "Gaussian blur, sigma 2 % of the width, in the second half",
       kDegraded,
       [](const Recording& r, std::uint32_t) {
         return with_images(r, part(r, 0.5, 1),
                            [](const Image& i, std::size_t) { return defocused(i, 0.02); });
       }},
      {"vignette", kAll, "the corners get a tenth of the light", "-",
       [](const Recording& r, std::uint32_t) { return with_images(r, whole(r), with_vignette); }},
      {"rolling_shutter", kAll, "rows are read during a whole frame", kDegraded,
       [](const Recording& r, std::uint32_t) { return with_rolling_shutter(r); }},
  };
}

std::vector<Fault> signal_faults() {
  return {
      {"noise_20", kAll, "noise of 20 grey levels", kDegraded,
       [](const Recording& r, std::uint32_t seed) {
         return with_images(r, whole(r), [seed](const Image& image, std::size_t i) {
           return with_noise(image, 20, seed, i);
         });
       }},
      {"noise_60", kAll, "noise of 60 grey levels", kDegraded,
       [](const Recording& r, std::uint32_t seed) {
         return with_images(r, whole(r), [seed](const Image& image, std::size_t i) {
           return with_noise(image, 60, seed, i);
         });
       }},
      {"noise_alone", kAll, "the images show noise alone", kUnusable,
       [](const Recording& r, std::uint32_t seed) {
         return with_images(r, whole(r), [seed](const Image& image, std::size_t i) {
           return with_noise(with_gain(image, 0, 128), 50, seed, i);
         });
       }},
      {"colour_cast", kAll, "colour images with five times as much red as blue", "-",
       [](const Recording& r, std::uint32_t) { return with_images(r, whole(r), coloured); }},
      {"lost_rows", kAll, "a quarter of the rows repeats the row above", kDegraded,
       [](const Recording& r, std::uint32_t seed) {
         return with_images(r, whole(r), [seed](const Image& image, std::size_t i) {
           return with_lost_rows(image, seed, i);
         });
       }},
  };
}

}  // namespace

std::vector<Fault> optics_faults() {
  std::vector<Fault> faults = exposure_faults();
  for (const auto& more : {sharpness_faults(), signal_faults()})
    faults.insert(faults.end(), more.begin(), more.end());
  return faults;
}

}  // namespace placegraph::faults
