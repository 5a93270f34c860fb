#include <placegraph/frontend/places/cues/gabor_statistics.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

constexpr int kFinestWidth = 80, kFinestHeight = 60;  // pixels at the finest scale
constexpr double kFloor = 0.5;  // grey levels: excludes the noise of blank walls

/// A Gaussian times cosine and sine of `frequency` [rad/px] along one axis.
struct Wave {
  cv::Mat cosine, sine;
  Wave(double frequency, double sigma) {
    const int half = static_cast<int>(std::ceil(2.5 * sigma));
    cosine = cv::Mat(1, 2 * half + 1, CV_32F);
    sine = cosine.clone();
    double sum = 0;
    for (int i = -half; i <= half; ++i) sum += std::exp(-0.5 * i * i / (sigma * sigma));
    for (int i = -half; i <= half; ++i) {
      const double envelope = std::exp(-0.5 * i * i / (sigma * sigma)) / sum;
      cosine.at<float>(i + half) = static_cast<float>(envelope * std::cos(frequency * i));
      sine.at<float>(i + half) = static_cast<float>(envelope * std::sin(frequency * i));
    }
  }
};

/// |image * exp(i (u x + v y)) * envelope|, the complex product of rows and columns.
cv::Mat magnitude_of(const cv::Mat& image, const Wave& across, const Wave& down) {
  const auto filtered = [&](const cv::Mat& row, const cv::Mat& column) {
    cv::Mat result;
    cv::sepFilter2D(image, result, CV_32F, row, column, {-1, -1}, 0, cv::BORDER_REFLECT_101);
    return result;
  };
  cv::Mat magnitude;
  cv::magnitude(filtered(across.cosine, down.cosine) - filtered(across.sine, down.sine),
                filtered(across.sine, down.cosine) + filtered(across.cosine, down.sine), magnitude);
  return magnitude;
}

}  // namespace

CueGrid gabor_cue(const Image& grey, const GaborOptions& o) {
  require(!grey.empty() && grey.type() == CV_8UC1, "gabor_cue: grey image needed");
  require(o.cells > 0 && o.scales > 0 && o.orientations > 0 && o.wavelength_px >= 2,
          "gabor_cue: cells, scales, orientations > 0 and a wavelength of two pixels needed");
  const int cells = o.cells * o.cells, channels = 2 * o.scales * o.orientations;
  std::vector<float> values(static_cast<std::size_t>(cells * channels));
  const auto at = [&](int cell, int channel) -> float& {
    return values[static_cast<std::size_t>(cell * channels + channel)];
  };
  constexpr double kSigma = 0.56;  // wavelengths: a bandwidth of one octave
  const double frequency = 2 * std::numbers::pi / o.wavelength_px, sigma = kSigma * o.wavelength_px;
  for (int scale = 0; scale < o.scales; ++scale) {
    const double shrink = std::pow(2.0, -0.5 * scale);
    const int step = o.cells;  // whole pixels per cell
    const auto whole = [&](int px) {
      return std::max(1, static_cast<int>(std::lround(px * shrink / step))) * step;
    };
    cv::Mat image;
    cv::resize(grey, image, {whole(kFinestWidth), whole(kFinestHeight)}, 0, 0, cv::INTER_AREA);
    image.convertTo(image, CV_32F, 1, -cv::mean(image)[0]);
    for (int k = 0; k < o.orientations; ++k) {
      const double angle = std::numbers::pi * k / o.orientations;
      const cv::Mat magnitude = magnitude_of(image, Wave(frequency * std::cos(angle), sigma),
                                             Wave(frequency * std::sin(angle), sigma));
      cv::Mat mean, square;
      cv::resize(magnitude, mean, {o.cells, o.cells}, 0, 0, cv::INTER_AREA);
      cv::resize(magnitude.mul(magnitude), square, {o.cells, o.cells}, 0, 0, cv::INTER_AREA);
      for (int cell = 0; cell < cells; ++cell) {
        const double m = mean.at<float>(cell / o.cells, cell % o.cells);
        const double s = square.at<float>(cell / o.cells, cell % o.cells);
        const int channel = scale * o.orientations + k;
        at(cell, channel) = static_cast<float>(std::log(m + kFloor));
        at(cell, channel + channels / 2) =
            static_cast<float>(std::log(std::sqrt(std::max(0.0, s - m * m)) + kFloor));
      }
    }
  }
  for (int first = 0; first < channels; first += o.orientations) {
    double sum = 0;
    for (int cell = 0; cell < cells; ++cell)
      for (int k = 0; k < o.orientations; ++k) sum += static_cast<double>(at(cell, first + k));
    const auto mean = static_cast<float>(sum / (cells * o.orientations));
    for (int cell = 0; cell < cells; ++cell)
      for (int k = 0; k < o.orientations; ++k) at(cell, first + k) -= mean;
  }
  return make_cue_grid(o.cells, o.cells, channels, values);
}

}  // namespace placegraph
