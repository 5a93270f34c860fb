#include <fmt/format.h>
#include <placegraph/eval/internal/plots/plot_canvas.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/internal/image/png_codec.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

std::string css(Colour c) { return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue); }

std::string xml_text(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '>')
      escaped += "&gt;";
    else
      escaped += c;
  }
  return escaped;
}

class SvgCanvas : public PlotCanvas {
 public:
  SvgCanvas(int width_px, int height_px) {
    out_ = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
        "viewBox=\"0 0 {0} {1}\" font-family=\"Helvetica, Arial, sans-serif\">\n"
        "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
        width_px, height_px);
  }
  void line(const std::vector<Eigen::Vector2d>& points, Colour colour, double width_px) override {
    out_ += fmt::format(
        "<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"{:.4g}\" stroke-linejoin=\"round\" "
        "stroke-linecap=\"round\" points=\"",
        css(colour), width_px);
    for (const Eigen::Vector2d& p : points) out_ += fmt::format("{:.2f},{:.2f} ", p[0], p[1]);
    out_ += "\"/>\n";
  }
  void rectangle(const Eigen::Vector2d& corner, const Eigen::Vector2d& size, Colour fill,
                 Colour stroke) override {
    out_ += fmt::format(
        "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\" "
        "stroke=\"{}\"/>\n",
        corner[0], corner[1], size[0], size[1], css(fill), css(stroke));
  }
  void disc(const Eigen::Vector2d& centre, double radius_px, Colour fill, Colour stroke) override {
    out_ += fmt::format(
        "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" fill=\"{}\" stroke=\"{}\" "
        "stroke-width=\"2\"/>\n",
        centre[0], centre[1], radius_px, css(fill), css(stroke));
  }
  void text(const Eigen::Vector2d& at, const std::string& text, double size_px, Colour colour,
            TextAnchor anchor) override {
    const char* anchors[] = {"start", "middle", "end"};
    out_ += fmt::format(
        "<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.4g}\" fill=\"{}\" "
        "text-anchor=\"{}\">{}</text>\n",
        at[0], at[1], size_px, css(colour), anchors[static_cast<int>(anchor)], xml_text(text));
  }
  void begin_clip(const Eigen::Vector2d& corner, const Eigen::Vector2d& size) override {
    ++clips_;
    out_ += fmt::format(
        "<clipPath id=\"panel{0}\"><rect x=\"{1:.2f}\" y=\"{2:.2f}\" width=\"{3:.2f}\" "
        "height=\"{4:.2f}\"/></clipPath>\n<g clip-path=\"url(#panel{0})\">\n",
        clips_, corner[0], corner[1], size[0], size[1]);
  }
  void end_clip() override { out_ += "</g>\n"; }
  double text_width(const std::string& text, double size_px) const override {
    return 0.55 * size_px * static_cast<double>(text.size());
  }
  std::string encode() override { return out_ + "</svg>\n"; }

 private:
  std::string out_;
  int clips_ = 0;
};

// Draws at twice the size and averages down: lines are smooth, and thin ones stay thin.
class PngCanvas : public PlotCanvas {
 public:
  PngCanvas(int width_px, int height_px)
      : whole_(height_px * kOversampling, width_px * kOversampling, CV_8UC3, cv::Scalar::all(255)),
        view_(whole_) {}
  void line(const std::vector<Eigen::Vector2d>& points, Colour colour, double width_px) override {
    std::vector<cv::Point> fixed;
    for (const Eigen::Vector2d& p : points) fixed.push_back(fixed_point(p));
    const int thickness = std::max(1, static_cast<int>(std::lround(width_px * kOversampling)));
    cv::polylines(view_, fixed, false, bgr(colour), thickness, cv::LINE_AA, kShift);
  }
  void rectangle(const Eigen::Vector2d& corner, const Eigen::Vector2d& size, Colour fill,
                 Colour stroke) override {
    const cv::Point a = fixed_point(corner), b = fixed_point(corner + size);
    cv::rectangle(view_, a, b, bgr(fill), cv::FILLED, cv::LINE_8, kShift);
    cv::rectangle(view_, a, b, bgr(stroke), kOversampling, cv::LINE_8, kShift);
  }
  void disc(const Eigen::Vector2d& centre, double radius_px, Colour fill, Colour stroke) override {
    const int radius = static_cast<int>(std::lround(radius_px * kScale));
    cv::circle(view_, fixed_point(centre), radius, bgr(fill), cv::FILLED, cv::LINE_AA, kShift);
    cv::circle(view_, fixed_point(centre), radius, bgr(stroke), 2 * kOversampling, cv::LINE_AA,
               kShift);
  }
  void text(const Eigen::Vector2d& at, const std::string& text, double size_px, Colour colour,
            TextAnchor anchor) override {
    const double share = anchor == TextAnchor::kLeft ? 0 : anchor == TextAnchor::kMiddle ? 0.5 : 1;
    const Eigen::Vector2d left(at[0] - share * text_width(text, size_px), at[1]);
    const cv::Point origin(static_cast<int>(std::lround(left[0] * kOversampling)) + offset_.x,
                           static_cast<int>(std::lround(left[1] * kOversampling)) + offset_.y);
    cv::putText(view_, text, origin, kFont, font_scale(size_px), bgr(colour), kTextThickness,
                cv::LINE_AA);
  }
  void begin_clip(const Eigen::Vector2d& corner, const Eigen::Vector2d& size) override {
    const Eigen::Vector2i a = (corner * kOversampling).array().round().cast<int>();
    const Eigen::Vector2i s = (size * kOversampling).array().round().cast<int>();
    const cv::Rect panel = cv::Rect(a[0], a[1], s[0], s[1]) & cv::Rect({}, whole_.size());
    view_ = whole_(panel);
    offset_ = -panel.tl();
  }
  void end_clip() override {
    view_ = whole_;
    offset_ = {};
  }
  double text_width(const std::string& text, double size_px) const override {
    int baseline = 0;
    return static_cast<double>(
               cv::getTextSize(text, kFont, font_scale(size_px), kTextThickness, &baseline).width) /
           kOversampling;
  }
  std::string encode() override {
    cv::Mat picture;
    cv::resize(whole_, picture, whole_.size() / kOversampling, 0, 0, cv::INTER_AREA);
    return encode_png(picture);
  }

 private:
  static constexpr int kOversampling = 2, kShift = 4, kTextThickness = 2;
  static constexpr double kScale = kOversampling * (1 << kShift);
  static constexpr int kFont = cv::FONT_HERSHEY_DUPLEX;

  static cv::Scalar bgr(Colour c) { return cv::Scalar(c.blue, c.green, c.red); }
  // Capitals of this font are 21 units high at scale 1, and 0.72 of the nominal size in print.
  static double font_scale(double size_px) { return 0.72 * size_px * kOversampling / 21.0; }
  cv::Point fixed_point(const Eigen::Vector2d& p) const {
    return {static_cast<int>(std::lround(p[0] * kScale)) + offset_.x * (1 << kShift),
            static_cast<int>(std::lround(p[1] * kScale)) + offset_.y * (1 << kShift)};
  }

  cv::Mat whole_, view_;
  cv::Point offset_;
};

}  // namespace

std::unique_ptr<PlotCanvas> svg_canvas(int width_px, int height_px) {
  return std::make_unique<SvgCanvas>(width_px, height_px);
}

std::unique_ptr<PlotCanvas> png_canvas(int width_px, int height_px) {
  return std::make_unique<PngCanvas>(width_px, height_px);
}

}  // namespace placegraph
