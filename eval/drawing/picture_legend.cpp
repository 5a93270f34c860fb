#include <placegraph/eval/drawing/figure.h>
#include <placegraph/eval/drawing/picture_bytes.h>
#include <placegraph/eval/drawing/picture_legend.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

constexpr int kLeastWidth_px = 320;

}  // namespace

Image legend_strip(const std::vector<LegendEntry>& entries, const std::vector<std::string>& notes,
                   int width_px, const std::string& wanted) {
  Figure figure;
  figure.notes = notes;
  figure.legend = entries;
  figure.width_px = std::max(width_px, kLeastWidth_px);
  return svg_pixels(to_svg(figure), 1, wanted);
}

LegendEntry area_entry(const std::string& text, Colour colour) {
  return {text, {colour}, LegendMark::kArea};
}

Image stacked(const Image& bgr, const Image& strip) {
  Image whole(bgr.rows + strip.rows, std::max(bgr.cols, strip.cols), CV_8UC3, cv::Scalar::all(255));
  bgr.copyTo(whole(cv::Rect(0, 0, bgr.cols, bgr.rows)));
  strip.copyTo(whole(cv::Rect(0, bgr.rows, strip.cols, strip.rows)));
  return whole;
}

Image with_legend(const Image& bgr, const std::vector<LegendEntry>& entries,
                  const std::string& wanted) {
  return stacked(bgr, legend_strip(entries, {}, bgr.cols, wanted));
}

Colour area_colour(std::size_t number) {
  // Hues in steps of the golden ratio stay apart for any count; the value alternates too.
  const double hue = std::fmod(0.58 + 0.61803398875 * static_cast<double>(number), 1.0);
  constexpr double kSaturation = 0.62;
  const double value = number % 2 == 0 ? 0.92 : 0.72;
  const auto channel = [&](double phase) {
    const double distance = std::abs(std::fmod(hue + phase, 1.0) * 6 - 3) - 1;
    return static_cast<int>(
        std::lround(255 * value * (1 - kSaturation * (1 - std::clamp(distance, 0.0, 1.0)))));
  };
  return {channel(0), channel(2.0 / 3), channel(1.0 / 3)};
}

}  // namespace placegraph
