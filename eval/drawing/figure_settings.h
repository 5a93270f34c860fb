#pragma once
#include <placegraph/eval/drawing/figure.h>
#include <placegraph/graph/core/options.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Least and greatest number of each axis, in the unit that it shows.
///
/// [least, greatest]; empty: by the data.
struct AxisLimits {
  std::vector<double> x;                   ///< coordinate x
  std::vector<double> y;                   ///< coordinate y
  std::vector<double> z;                   ///< coordinate z
  std::vector<double> roll;                ///< [deg]
  std::vector<double> pitch;               ///< [deg]
  std::vector<double> yaw;                 ///< [deg]
  std::vector<double> time;                ///< since the first frame [s]
  std::vector<double> frame;               ///< number of a frame
  std::vector<double> distance_travelled;  ///< along the true path
  std::vector<double> position_error;      ///< distance to the true position
  std::vector<double> translation;         ///< of relative errors
  std::vector<double> rotation;            ///< of relative errors [deg]
  std::vector<double> t_rel;               ///< [%]
  std::vector<double> r_rel;               ///< [deg/100 m]
  std::vector<double> segment_length;      ///< length of the segments
  void check() const;
};
void visit(OptionVisitor& field, AxisLimits& options);

/// Units of lengths on axes.
enum class LengthUnit { kM, kKm, kCm, kMm };

/// How the figures of an evaluation look; the defaults change nothing.
struct FigureSettings {
  std::string title;      ///< in place of the figure's own; empty: its own
  double width_px = 0;    ///< of the picture; 0: its own, or in proportion to the height
  double height_px = 0;   ///< of the panels with their axes; 0: its own, or in proportion
  double font_px = 15;    ///< height of the font of legends and notes; others are in proportion
  double line_width = 1;  ///< factor of the width of curves
  LegendPlace legend = LegendPlace::kTop;   ///< where the legend stands
  LengthUnit length_unit = LengthUnit::kM;  ///< of axes of lengths
  bool grid = true;                         ///< lines at the numbers of the axes
  bool notes = true;                        ///< the lines below the title
  std::string colours;  ///< "ours #d55e00, theirs #0072b2": curves with their colours
  AxisLimits limits;    ///< of the axes that a figure has
  void check() const;
};
void visit(OptionVisitor& field, FigureSettings& options);

/// The figure with these settings.
///
/// A curve has the name of its estimate, as the legend shows it without the error; the truth is
/// "ground truth". A curve that is coloured by its error and gets a colour shows no error. Panels
/// grow with the size of the picture, their margins do not. Throws ArgumentError as check(), for a
/// colour of a curve that the figure does not have, and for a picture too small for its margins.
Figure with_settings(Figure figure, const FigureSettings& settings);

}  // namespace placegraph
