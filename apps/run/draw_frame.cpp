#include "apps/run/draw_frame.h"
#include <placegraph/pipeline/cues/frame_view.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "apps/support/subpixel.h"

namespace placegraph::apps {
namespace {

std::string directions(const FrameView& view) {
  if (view.directed.empty()) return "";
  std::optional<ManhattanFrameId> manhattan_frame;
  for (const FrameView::DirectedLine& line : view.directed)
    manhattan_frame = std::max(manhattan_frame, line.manhattan_frame);
  return manhattan_frame ? ", Manhattan frame " + to_string(*manhattan_frame)
                         : ", no Manhattan frame";
}

cv::Scalar colour_of(std::optional<double> off_px) {
  if (!off_px) return {255, 255, 255};
  constexpr double kRedAtPx = 3;
  const double off = std::min(1.0, *off_px / kRedAtPx);
  return {0, 255 * std::min(1.0, 2 - 2 * off), 255 * std::min(1.0, 2 * off)};
}

/// Red, green and blue along the axes of a Manhattan frame, grey for other directions.
cv::Scalar colour_of(const FrameView::DirectedLine& line) {
  static const cv::Scalar kColours[] = {{64, 64, 255}, {64, 224, 64}, {255, 96, 64}};
  return line.axis ? kColours[*line.axis] : cv::Scalar(128, 128, 128);
}

std::string caption(const FrameResult& result, const FrameView& view) {
  const char* state = result.state == TrackingState::kTracking ? "tracking"
                      : result.state == TrackingState::kLost   ? "lost"
                                                               : "initializing";
  const auto mapped = std::count_if(view.tracks.begin(), view.tracks.end(),
                                    [](const auto& track) { return track.px_projected; });
  return to_string(result.frame) + " " + state + (result.keyframe ? ", keyframe" : "") + ", " +
         std::to_string(view.tracks.size()) + " tracks, " + std::to_string(mapped) + " landmarks" +
         (view.lines.empty() ? "" : ", " + std::to_string(view.lines.size()) + " lines") +
         directions(view) + (result.loops_accepted > 0 ? ", loop" : "");
}

}  // namespace

Image draw_frame(const Frame& frame, const FrameResult& result, const FrameView& view) {
  Image canvas;
  cv::cvtColor(frame.image, canvas, cv::COLOR_GRAY2BGR);
  if (view.ground_px.size() > 2) {
    std::vector<cv::Point> outline;
    for (const Eigen::Vector2d& px : view.ground_px) outline.push_back(sixteenths(px));
    cv::polylines(canvas, outline, true, {255, 128, 0}, 1, cv::LINE_AA, kShift);
  }
  for (const FrameView::DirectedLine& line : view.directed)
    cv::line(canvas, sixteenths(line.segment.start), sixteenths(line.segment.end), colour_of(line),
             line.axis < 0 ? 1 : 2, cv::LINE_AA, kShift);
  for (const FrameView::SurfacePixel& pixel : view.surfaces)
    cv::circle(canvas, sixteenths(pixel.px), 1 << kShift,
               colour_of(std::abs(pixel.residual_sigmas)), cv::FILLED, cv::LINE_AA, kShift);
  for (const FrameView::Line& line : view.lines)
    cv::line(canvas, sixteenths(line.segment.start), sixteenths(line.segment.end),
             colour_of(line.off_px), 2, cv::LINE_AA, kShift);
  for (const FrameView::Track& track : view.tracks) {
    std::optional<double> off_px;
    if (track.px_projected) off_px = (*track.px_projected - track.px).norm();
    const cv::Scalar colour = colour_of(off_px);
    cv::line(canvas, sixteenths(track.px_previous), sixteenths(track.px), colour, 1, cv::LINE_AA,
             kShift);
    cv::circle(canvas, sixteenths(track.px), 2 << kShift, colour, 1, cv::LINE_AA, kShift);
  }
  for (const auto& [colour, width] :
       {std::pair(cv::Scalar(0, 0, 0), 3), std::pair(cv::Scalar(255, 255, 255), 1)})
    cv::putText(canvas, caption(result, view), {6, 16}, cv::FONT_HERSHEY_SIMPLEX, 0.45, colour,
                width, cv::LINE_AA);
  return canvas;
}

std::vector<LegendEntry> frame_legend() {
  const auto line = [](const char* text, Colour colour) {
    return LegendEntry{text, {colour, 2.5}, LegendMark::kLine};
  };
  return {line("landmark, as predicted", {0, 255, 0}),
          line("1.5 px off", {255, 255, 0}),
          line("3 px off or more", {255, 0, 0}),
          area_entry("white: track without a landmark", {255, 255, 255}),
          line("ground", {0, 128, 255}),
          line("aligned surfaces: green 0, red 3 sigma", {170, 220, 0}),
          line("Manhattan axes: red, green, blue; grey: none", {128, 128, 128})};
}

}  // namespace placegraph::apps
