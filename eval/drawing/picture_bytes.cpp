#include <placegraph/eval/drawing/picture_bytes.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/drawing_plugin.h>
#include <placegraph/graph/image/png_codec.h>

#include <opencv2/imgproc.hpp>

namespace placegraph {

Image svg_pixels(const std::string& svg, double scale, const std::string& wanted) {
  DrawingPixels pixels = drawing_plugin(wanted).rasterize(svg, scale);
  require(!pixels.bgra.empty(), wanted + ": the drawing has no pixels");
  Image bgr;
  cv::cvtColor(Image(pixels.height, pixels.width, CV_8UC4, pixels.bgra.data()), bgr,
               cv::COLOR_BGRA2BGR);
  return bgr;
}

void require_drawings(const std::string& wanted) { drawing_plugin(wanted); }

bool is_plot_name(const std::string& path) {
  return path.ends_with(".png") || path.ends_with(".svg") || path.ends_with(".pdf");
}

std::string picture_bytes(const std::string& svg, const std::string& path) {
  require(is_plot_name(path), path + ": a plot ends in .png, .svg or .pdf");
  if (path.ends_with(".svg")) return svg;
  if (path.ends_with(".png")) return encode_png(svg_pixels(svg, 1, path), {.level = 6});
  const std::string pdf = drawing_plugin(path).pdf(svg);
  require(!pdf.empty(), path + ": the drawing has no page");
  return pdf;
}

}  // namespace placegraph
