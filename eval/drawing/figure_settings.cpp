#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/eval/drawing/figure_settings.h>
#include <placegraph/eval/drawing/plot_style.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace placegraph {
namespace {

using Eigen::Vector2d;

constexpr const char* kTruthSeries = "ground truth";

/// The key of limits, the beginning of the label of their axis, and they.
struct NamedLimits {
  const char* key;
  const char* label;
  const std::vector<double>& range;
};

std::vector<NamedLimits> named_limits(const AxisLimits& l) {
  return {{"x", "x", l.x},
          {"y", "y", l.y},
          {"z", "z", l.z},
          {"roll", "roll", l.roll},
          {"pitch", "pitch", l.pitch},
          {"yaw", "yaw", l.yaw},
          {"time", "time", l.time},
          {"frame", "frame", l.frame},
          {"distance_travelled", "distance travelled", l.distance_travelled},
          {"position_error", "position error", l.position_error},
          {"translation", "translation", l.translation},
          {"rotation", "rotation", l.rotation},
          {"t_rel", "t_rel", l.t_rel},
          {"r_rel", "r_rel", l.r_rel},
          {"segment_length", "length of the segments", l.segment_length}};
}

std::optional<Colour> colour_of(const std::string& text) {
  unsigned value = 0;
  const char* end = text.data() + text.size();
  if (text.size() != 7 || text.front() != '#' ||
      std::from_chars(text.data() + 1, end, value, 16).ptr != end)
    return std::nullopt;
  return Colour{static_cast<int>(value >> 16), static_cast<int>(value >> 8 & 255),
                static_cast<int>(value & 255)};
}

/// Names with their colours: in each part between commas the last word is the colour.
std::map<std::string, Colour> named_colours(const std::string& text) {
  std::map<std::string, Colour> colours;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    std::string part = text.substr(begin, comma - begin);
    part.erase(0, part.find_first_not_of(' '));
    part.erase(part.find_last_not_of(' ') + 1);
    const std::size_t blank = part.rfind(' ');
    const auto colour =
        blank == std::string::npos ? std::nullopt : colour_of(part.substr(blank + 1));
    require(colour.has_value(),
            fmt::format("colours: '{}' is not the name of a curve and a colour #rrggbb", part));
    const std::string name = part.substr(0, part.find_last_not_of(' ', blank) + 1);
    require(colours.emplace(name, *colour).second, fmt::format("colours: '{}' stands twice", name));
    begin = comma + 1;
  }
  return colours;
}

/// Calls with every point of a shape.
template <typename Take>
void each_point(FigureShape& shape, const Take& take) {
  if (auto* line = std::get_if<FigureLine>(&shape)) {
    for (auto& point : line->points)
      if (point) take(*point);
  } else if (auto* dots = std::get_if<FigureDots>(&shape)) {
    for (Vector2d& point : dots->points) take(point);
  } else if (auto* area = std::get_if<FigureArea>(&shape)) {
    for (auto& ring : area->rings)
      for (Vector2d& point : ring) take(point);
  } else if (auto* text = std::get_if<FigureText>(&shape)) {
    take(text->at);
  } else if (auto* picture = std::get_if<FigurePicture>(&shape)) {
    for (Vector2d* point : {&picture->corner, &picture->right, &picture->down}) take(*point);
  }
}

/// Names the unit in place of metres; the factor of the numbers, 1 for other axes.
double change_unit(std::string& label, const char* unit, double per_metre) {
  const std::size_t at = label.find("[m]");
  if (at == std::string::npos) return 1;
  label.replace(at, 3, fmt::format("[{}]", unit));
  return per_metre;
}

void set_length_unit(Figure& figure, LengthUnit unit) {
  if (unit == LengthUnit::kM) return;
  constexpr std::pair<const char*, double> kUnits[] = {
      {"m", 1}, {"km", 1e-3}, {"cm", 100}, {"mm", 1000}};
  const auto [name, per_metre] = kUnits[static_cast<int>(unit)];
  for (FigurePanel& panel : figure.panels) {
    const Vector2d factor(change_unit(panel.x.label, name, per_metre),
                          change_unit(panel.y.label, name, per_metre));
    for (FigureShape& shape : panel.shapes)
      each_point(shape, [&](Vector2d& point) { point = point.cwiseProduct(factor); });
    for (FigureText& label : panel.labels) label.at = label.at.cwiseProduct(factor);
    panel.x.range = {factor[0] * panel.x.range.min, factor[0] * panel.x.range.max};
    panel.y.range = {factor[1] * panel.y.range.min, factor[1] * panel.y.range.max};
    if (!panel.scale) continue;
    const double of_scale = change_unit(panel.scale->label, name, per_metre);
    panel.scale->range = {of_scale * panel.scale->range.min, of_scale * panel.scale->range.max};
  }
}

/// A map of one coordinate that stretches what any panel covers, but no panel's margins.
class PanelStretch {
 public:
  PanelStretch(const Figure& figure, int axis, double wanted_px, double own_px) {
    const double before = axis == 0 ? kLeftMargin : kTopMargin,
                 after = axis == 0 ? kRightMargin : kBottomMargin;
    std::set<double> ends = {0};
    for (const FigurePanel& panel : figure.panels) {
      const double begin = panel.corner[axis], end = begin + panel.size[axis];
      ends.insert({std::max(begin - before, 0.0), begin, end, end + after});
    }
    ends_.assign(ends.begin(), ends.end());
    double covered_px = 0;
    for (std::size_t i = 0; i + 1 < ends_.size(); ++i) {
      const double middle = 0.5 * (ends_[i] + ends_[i + 1]);
      const auto within = [&](double around_before, double around_after) {
        return [=](const FigurePanel& panel) {
          const double begin = panel.corner[axis], end = begin + panel.size[axis];
          return middle > begin - around_before && middle < end + around_after;
        };
      };
      // Beside one panel may stand the inside of another: the margin stays.
      const auto with_margins = std::ranges::count_if(figure.panels, within(before, after)),
                 inside = std::ranges::count_if(figure.panels, within(0, 0));
      covered_.push_back(inside > 0 && inside == with_margins);
      if (covered_.back()) covered_px += ends_[i + 1] - ends_[i];
    }
    factor_ = covered_px > 0 ? 1 + (wanted_px - own_px) / covered_px : 1;
  }
  double factor() const { return factor_; }
  double operator()(double at) const {
    double result = at;
    for (std::size_t i = 0; i < covered_.size(); ++i)
      if (covered_[i])
        result += (factor_ - 1) * (std::clamp(at, ends_[i], ends_[i + 1]) - ends_[i]);
    return result;
  }

 private:
  std::vector<double> ends_;
  std::vector<bool> covered_;
  double factor_ = 1;
};

/// Panels of one scale keep it, and those beside or below them that share an axis follow.
void keep_equal(Figure& figure) {
  for (FigurePanel& panel : figure.panels) {
    const double along = panel.x.range.size() / panel.size[0],
                 up = panel.y.range.size() / panel.size[1];
    if (!panel.equal || std::abs(along - up) <= 1e-9 * along) continue;  // but for rounding
    make_equal(panel);
    for (FigurePanel& other : figure.panels) {
      if (other.equal) continue;
      if (other.x.label == panel.x.label && other.corner[0] == panel.corner[0])
        other.x.range = panel.x.range;
      if (other.y.label == panel.y.label && other.corner[1] == panel.corner[1])
        other.y.range = panel.y.range;
    }
  }
}

void set_size(Figure& figure, const FigureSettings& settings) {
  figure.scale = settings.font_px / kTextPx;
  double width_px = settings.width_px / figure.scale, height_px = settings.height_px / figure.scale;
  if (width_px == 0 && height_px == 0) return;
  if (width_px == 0) width_px = figure.width_px * height_px / figure.height_px;
  if (height_px == 0) height_px = figure.height_px * width_px / figure.width_px;
  const PanelStretch x(figure, 0, width_px, figure.width_px),
      y(figure, 1, height_px, figure.height_px);
  constexpr double kLeast = 0.1;  // chosen: what is smaller shows nothing
  require(x.factor() >= kLeast && y.factor() >= kLeast,
          fmt::format("width_px, height_px: {:.0f} x {:.0f} px are too few for axes and texts",
                      figure.scale * width_px, figure.scale * height_px));
  for (FigurePanel& panel : figure.panels) {
    const Vector2d end = panel.corner + panel.size;
    panel.corner = {x(panel.corner[0]), y(panel.corner[1])};
    panel.size = Vector2d(x(end[0]), y(end[1])) - panel.corner;
  }
  figure.width_px = width_px;
  figure.height_px = height_px;
}

void set_colour(FigureShape& shape, const std::string& series, Colour colour) {
  if (auto* line = std::get_if<FigureLine>(&shape); line && line->series == series) {
    line->stroke.colour = colour;
    line->shares.clear();
  } else if (auto* dots = std::get_if<FigureDots>(&shape); dots && dots->series == series) {
    if (!(dots->fill == kWhite)) dots->fill = colour;
    dots->edge = colour;
  } else if (auto* area = std::get_if<FigureArea>(&shape); area && area->series == series) {
    area->fill = colour;
  }
}

std::set<std::string> series_of(const Figure& figure) {
  std::set<std::string> all;
  for (const FigurePanel& panel : figure.panels)
    for (const FigureShape& shape : panel.shapes)
      std::visit(
          [&](const auto& each) {
            if constexpr (requires { each.series; })
              if (!each.series.empty()) all.insert(each.series);
          },
          shape);
  return all;
}

void set_colours(Figure& figure, const std::map<std::string, Colour>& colours) {
  const std::set<std::string> known = series_of(figure);
  for (const auto& [series, colour] : colours) {
    require(known.contains(series) || series == kTruthSeries,
            fmt::format("colours: the figure has no curve '{}'; it has {}", series,
                        fmt::join(known, ", ")));
    for (LegendEntry& entry : figure.legend)
      if (entry.series == series) {
        entry.stroke.colour = colour;
        if (entry.mark == LegendMark::kScale) entry.mark = LegendMark::kLine;
      }
    for (FigurePanel& panel : figure.panels) {
      for (FigureShape& shape : panel.shapes) set_colour(shape, series, colour);
      if (std::ranges::none_of(panel.shapes, [](const FigureShape& shape) {
            const auto* line = std::get_if<FigureLine>(&shape);
            return line != nullptr && !line->shares.empty();
          }))
        panel.scale.reset();
    }
  }
}

void set_limits(Figure& figure, const AxisLimits& limits) {
  const auto set = [&](FigureAxis& axis) {
    for (const auto& [key, label, range] : named_limits(limits))
      if (!range.empty() && axis.categories.empty() &&
          (axis.label == label || axis.label.starts_with(std::string(label) + " [")))
        axis.range = {range[0], range[1]};
  };
  for (FigurePanel& panel : figure.panels) {
    set(panel.x);
    set(panel.y);
  }
}

}  // namespace

void AxisLimits::check() const {
  for (const auto& [key, label, range] : named_limits(*this))
    require(range.empty() || (range.size() == 2 && std::isfinite(range[0]) &&
                              std::isfinite(range[1]) && range[0] < range[1]),
            fmt::format("{}: is not [least, greatest]", key));
}

void visit(OptionVisitor& field, AxisLimits& o) {
  field("x", o.x, "coordinate x");
  field("y", o.y, "coordinate y");
  field("z", o.z, "coordinate z");
  field("roll", o.roll, "roll [deg]");
  field("pitch", o.pitch, "pitch [deg]");
  field("yaw", o.yaw, "yaw [deg]");
  field("time", o.time, "time [s]");
  field("frame", o.frame, "number of a frame, without times");
  field("distance_travelled", o.distance_travelled, "distance along the true path");
  field("position_error", o.position_error, "distance to the true position");
  field("translation", o.translation, "relative error of translation");
  field("rotation", o.rotation, "relative error of rotation [deg]");
  field("t_rel", o.t_rel, "t_rel [%]");
  field("r_rel", o.r_rel, "r_rel [deg/100 m]");
  field("segment_length", o.segment_length, "length of the segments of t_rel and r_rel");
}

void FigureSettings::check() const {
  check_ranges(*this);
  (void)named_colours(colours);
}

void visit(OptionVisitor& field, FigureSettings& o) {
  field.basic()("title", o.title, "title in place of the figure's own; empty: its own");
  field.basic()("width_px", o.width_px, "width of the picture; 0: its own", {0, 20000});
  field.basic()("height_px", o.height_px,
                "height of the panels with their axes; 0: their own, or in proportion to the width",
                {0, 20000});
  field.basic()("font_px", o.font_px, "height of the font of legends and notes", {4, 100});
  field("line_width", o.line_width, "factor of the width of curves", {0.1, 20});
  field.choice("legend", o.legend, {"top", "bottom", "none"}, "where the legend stands");
  field.choice("length_unit", o.length_unit, {"m", "km", "cm", "mm"}, "unit of axes of lengths");
  field("grid", o.grid, "lines at the numbers of the axes");
  field("notes", o.notes, "lines below the title, which name the alignment");
  field("colours", o.colours, "curves with their colours, \"ours #d55e00, theirs #0072b2\"");
  field.group("limits", o.limits, "[least, greatest] of axes, in the units shown; []: by the data");
}

Figure with_settings(Figure figure, const FigureSettings& settings) {
  settings.check();
  if (!settings.title.empty()) figure.title = settings.title;
  if (!settings.notes) figure.notes.clear();
  figure.legend_place = settings.legend;
  set_colours(figure, named_colours(settings.colours));
  for (LegendEntry& entry : figure.legend)
    if (entry.mark == LegendMark::kLine || entry.mark == LegendMark::kScale)
      entry.stroke.width_px *= settings.line_width;
  for (FigurePanel& panel : figure.panels) {
    panel.grid = settings.grid;
    for (FigureShape& shape : panel.shapes)
      if (auto* line = std::get_if<FigureLine>(&shape))
        line->stroke.width_px *= settings.line_width;
  }
  set_length_unit(figure, settings.length_unit);
  set_limits(figure, settings.limits);
  set_size(figure, settings);
  keep_equal(figure);
  return figure;
}

}  // namespace placegraph
