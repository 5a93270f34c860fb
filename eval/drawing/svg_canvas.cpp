#include <fmt/format.h>
#include <placegraph/eval/drawing/svg_canvas.h>
#include <placegraph/eval/drawing/text_width.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

using Eigen::Vector2d;

std::string css(Colour c) { return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue); }

std::string points_of(const std::vector<Vector2d>& points) {
  std::string text;
  for (const Vector2d& p : points)
    if (p.allFinite()) text += fmt::format("{:.1f},{:.1f} ", p[0] + 0.0, p[1] + 0.0);
  return text;
}

std::string style_of(const Stroke& stroke) {
  std::string style = fmt::format(
      "fill=\"none\" stroke=\"{}\" stroke-width=\"{:.4g}\" stroke-linejoin=\"round\" "
      "stroke-linecap=\"{}\"",
      css(stroke.colour), stroke.width_px, stroke.dash.empty() ? "round" : "butt");
  if (stroke.opacity < 1) style += fmt::format(" stroke-opacity=\"{:.3g}\"", stroke.opacity);
  if (!stroke.dash.empty()) style += fmt::format(" stroke-dasharray=\"{}\"", stroke.dash);
  return style;
}

/// The text without what XML does not allow in one.
std::string xml_text(const std::string& text) {
  std::string escaped;
  for (const char32_t c : code_points(text)) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '>')
      escaped += "&gt;";
    else
      escaped += utf8(c < 0x20 ? U' ' : c);
  }
  return escaped;
}

}  // namespace

std::string path_in_tenths(const std::vector<std::vector<Vector2d>>& lines) {
  const auto tenths = [](double px) { return std::lround(10 * std::clamp(px, -1e8, 1e8)); };
  std::string path;
  for (const std::vector<Vector2d>& line : lines) {
    long x = 0, y = 0;
    bool begun = false;
    for (const Vector2d& p : line) {
      if (!p.allFinite()) continue;
      const long next_x = tenths(p[0]), next_y = tenths(p[1]);
      // A minus sign parts numbers too.
      path +=
          fmt::format("{}{}{}{}", begun ? "l" : "M", next_x - x, next_y < y ? "" : " ", next_y - y);
      x = next_x;
      y = next_y;
      begun = true;
    }
  }
  return path;
}

SvgCanvas::SvgCanvas(double width_px, double height_px, double scale)
    : out_(fmt::format(
          "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{2:.0f}\" height=\"{3:.0f}\" "
          "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"DejaVu Sans, Verdana, Helvetica, Arial, "
          "sans-serif\">\n<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"#ffffff\"/>\n",
          width_px, height_px, scale * width_px, scale * height_px)) {}

void SvgCanvas::line(const std::vector<Vector2d>& points, const Stroke& stroke) {
  if (const std::string path = points_of(points); !path.empty())
    out_ += fmt::format("<polyline {} points=\"{}\"/>\n", style_of(stroke), path);
}

void SvgCanvas::lines(const std::vector<std::vector<Vector2d>>& lines, const Stroke& stroke) {
  const std::string path = path_in_tenths(lines);
  if (path.empty()) return;
  Stroke tenths = stroke;
  tenths.width_px *= 10;
  out_ += fmt::format("<path transform=\"scale(.1)\" {} d=\"{}\"/>\n", style_of(tenths), path);
}

void SvgCanvas::area(const std::vector<std::vector<Vector2d>>& rings, Colour fill, double opacity) {
  std::string path;
  for (const std::vector<Vector2d>& ring : rings)
    if (const std::string points = points_of(ring); !points.empty()) path += "M" + points + "Z ";
  if (path.empty()) return;
  out_ +=
      fmt::format("<path fill=\"{}\" fill-opacity=\"{:.3g}\" fill-rule=\"evenodd\" d=\"{}\"/>\n",
                  css(fill), opacity, path);
}

void SvgCanvas::rectangle(const Vector2d& corner, const Vector2d& size, Colour fill, Colour edge) {
  out_ += fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\" "
      "stroke=\"{}\"/>\n",
      corner[0], corner[1], size[0], size[1], css(fill), css(edge));
}

void SvgCanvas::disc(const Vector2d& centre, double radius_px, Colour fill, Colour edge,
                     double edge_px) {
  if (!centre.allFinite()) return;
  out_ += fmt::format(
      "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.3g}\" fill=\"{}\" stroke=\"{}\" "
      "stroke-width=\"{:.3g}\"/>\n",
      centre[0], centre[1], radius_px, css(fill), css(edge), edge_px);
}

void SvgCanvas::discs(const std::vector<Vector2d>& centres, double radius_px, Colour fill,
                      Colour edge, double edge_px) {
  out_ += fmt::format("<g fill=\"{}\" stroke=\"{}\" stroke-width=\"{:.3g}\">\n", css(fill),
                      css(edge), edge_px);
  for (const Vector2d& centre : centres)
    if (centre.allFinite())
      out_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.3g}\"/>\n", centre[0],
                          centre[1], radius_px);
  out_ += "</g>\n";
}

void SvgCanvas::text(const Vector2d& at, const std::string& text, double size_px, Colour colour,
                     TextAnchor anchor, bool rotated) {
  if (text.empty() || !at.allFinite()) return;
  const char* anchors[] = {"start", "middle", "end"};
  out_ += fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:.4g}\" fill=\"{}\" text-anchor=\"{}\"", at[0],
      at[1], size_px, css(colour), anchors[static_cast<int>(anchor)]);
  if (rotated) out_ += fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", at[0], at[1]);
  out_ += '>';
  out_ += xml_text(text);
  out_ += "</text>\n";
}

void SvgCanvas::picture(const std::string& source, const Vector2d& pixels, const Vector2d& corner,
                        const Vector2d& right, const Vector2d& down, double opacity) {
  if (!corner.allFinite() || !right.allFinite() || !down.allFinite()) return;
  out_ += fmt::format(
      "<image width=\"{:.0f}\" height=\"{:.0f}\" preserveAspectRatio=\"none\" "
      "opacity=\"{:.3g}\" transform=\"matrix({:.8g} {:.8g} {:.8g} {:.8g} {:.3f} {:.3f})\" "
      "href=\"{}\"/>\n",
      pixels[0], pixels[1], opacity, right[0], right[1], down[0], down[1], corner[0], corner[1],
      source);
}

void SvgCanvas::begin_clip(const Vector2d& corner, const Vector2d& size) {
  // Pictures that stand in one page share their names: equal names have equal rectangles.
  const auto tenths = [](double px) { return std::lround(10 * px); };
  out_ += fmt::format(
      "<clipPath id=\"{0}\"><rect x=\"{1:.1f}\" y=\"{2:.1f}\" width=\"{3:.1f}\" "
      "height=\"{4:.1f}\"/></clipPath>\n<g clip-path=\"url(#{0})\">\n",
      fmt::format("clip_{}_{}_{}_{}", tenths(corner[0]), tenths(corner[1]), tenths(size[0]),
                  tenths(size[1])),
      corner[0], corner[1], size[0], size[1]);
}

void SvgCanvas::end_clip() { out_ += "</g>\n"; }

std::string SvgCanvas::finish() const { return out_ + "</svg>\n"; }

}  // namespace placegraph
