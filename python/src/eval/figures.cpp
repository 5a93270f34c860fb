#include <placegraph/eval/drawing/figure.h>

#include <algorithm>
#include <limits>

#include "python/src/frontend/functions.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

nb::tuple tuple_of(Colour colour) { return nb::make_tuple(colour.red, colour.green, colour.blue); }

nb::tuple tuple_of(const Eigen::Vector2d& v) { return nb::make_tuple(v.x(), v.y()); }

nb::object array_of(const std::vector<Eigen::Vector2d>& points) {
  std::vector<double> values;
  for (const Eigen::Vector2d& point : points) append_rows(point, values);
  return nb::cast(owned_array(std::move(values), {points.size(), 2}));
}

void add_stroke(const Stroke& stroke, Table& row) {
  row["colour"] = tuple_of(stroke.colour);
  row["width_px"] = stroke.width_px;
  row["opacity"] = stroke.opacity;
  row["dash"] = stroke.dash;
}

Table row_of(const FigureLine& line) {
  constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
  std::vector<Eigen::Vector2d> points;
  for (const auto& point : line.points)
    points.push_back(point.value_or(Eigen::Vector2d(kGap, kGap)));
  Table row;
  row["kind"] = "line";
  row["points"] = array_of(points);
  add_stroke(line.stroke, row);
  std::vector<std::uint8_t> colours;
  for (const double share : line.shares) {
    const Colour colour = scale_colour(std::clamp(share, 0.0, 1.0));
    for (const int part : {colour.red, colour.green, colour.blue})
      colours.push_back(static_cast<std::uint8_t>(part));
  }
  row["colours"] = line.shares.empty()
                       ? nb::none()
                       : nb::cast(owned_array(std::move(colours), {line.shares.size(), 3}));
  return row;
}

Table row_of(const FigureDots& dots) {
  Table row;
  row["kind"] = "dots";
  row["points"] = array_of(dots.points);
  row["radius_px"] = dots.radius_px;
  row["fill"] = tuple_of(dots.fill);
  row["edge"] = tuple_of(dots.edge);
  return row;
}

Table row_of(const FigureArea& area) {
  Table row;
  row["kind"] = "area";
  nb::list rings;
  for (const auto& ring : area.rings) rings.append(array_of(ring));
  row["rings"] = rings;
  row["fill"] = tuple_of(area.fill);
  row["opacity"] = area.opacity;
  return row;
}

Table row_of(const FigureText& text) {
  Table row;
  row["kind"] = "text";
  row["at"] = tuple_of(text.at);
  row["text"] = text.text;
  return row;
}

Table row_of(const FigurePicture& picture) {
  Table row;
  row["kind"] = "picture";
  row["source"] = picture.source;
  row["pixels"] = tuple_of(picture.pixels);
  row["corner"] = tuple_of(picture.corner);
  row["right"] = tuple_of(picture.right);
  row["down"] = tuple_of(picture.down);
  row["opacity"] = picture.opacity;
  return row;
}

Table row_of(const FigureAxis& axis) {
  Table row;
  row["label"] = axis.label;
  row["range"] = nb::make_tuple(axis.range.min, axis.range.max);
  row["logarithmic"] = axis.logarithmic;
  row["categories"] = axis.categories;
  return row;
}

Table row_of(const FigurePanel& panel) {
  Table row;
  row["corner_px"] = tuple_of(panel.corner);
  row["size_px"] = tuple_of(panel.size);
  row["heading"] = panel.heading;
  row["x"] = row_of(panel.x);
  row["y"] = row_of(panel.y);
  nb::list shapes;
  for (const FigureShape& shape : panel.shapes)
    std::visit([&](const auto& each) { shapes.append(row_of(each)); }, shape);
  for (const FigureText& label : panel.labels) shapes.append(row_of(label));
  row["shapes"] = shapes;
  row["scale"] = nb::none();
  if (panel.scale) {
    Table scale;
    scale["label"] = panel.scale->label;
    scale["range"] = nb::make_tuple(panel.scale->range.min, panel.scale->range.max);
    row["scale"] = scale;
  }
  return row;
}

Table row_of(const LegendEntry& entry) {
  static constexpr const char* kMarks[] = {"line", "ring", "disc", "area", "scale"};
  Table row;
  row["text"] = entry.text;
  row["mark"] = kMarks[static_cast<std::size_t>(entry.mark)];
  add_stroke(entry.stroke, row);
  return row;
}

template <class Item>
TableList rows_of(const std::vector<Item>& items) {
  TableList rows;
  for (const Item& item : items) rows.append(row_of(item));
  return rows;
}

}  // namespace

void bind_figures(nb::module_& m) {
  m.def(
      "scale_colours",
      [](int count) {
        std::vector<std::uint8_t> colours;
        for (int i = 0; i < count; ++i) {
          const Colour colour = scale_colour(i / std::max(1.0, count - 1.0));
          for (const int part : {colour.red, colour.green, colour.blue})
            colours.push_back(static_cast<std::uint8_t>(part));
        }
        const std::size_t rows = colours.size() / 3;
        return owned_array(std::move(colours), {rows, 3});
      },
      "count"_a, "The colours of a scale from its least value to its greatest, N x 3 uint8 (RGB).");
  nb::class_<Figure>(m, "Figure", doc("Figure"))
      .def_ro("title", &Figure::title, "The title.")
      .def_prop_ro("notes", as_tuple(&Figure::notes), doc("Figure::notes"))
      .def_prop_ro(
          "size_px", [](const Figure& f) { return std::pair(f.width_px, f.height_px); },
          "Width and height of the area of the panels [px].")
      .def_prop_ro(
          "panels", [](const Figure& f) { return rows_of(f.panels); },
          "The panels, a dictionary each: corner_px, size_px, heading, axes x and y, "
          "shapes, scale.")
      .def_prop_ro(
          "legend", [](const Figure& f) { return rows_of(f.legend); },
          "The entries of the legend, a dictionary each: text, mark, colour ...")
      .def(
          "to_svg", [](const Figure& f) { return to_svg(f); }, nb::call_guard<WithoutGil>(),
          "The picture as SVG text.")
      .def("_repr_svg_", [](const Figure& f) { return to_svg(f); });
}

}  // namespace placegraph::python
