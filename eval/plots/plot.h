#pragma once
#include <placegraph/eval/drawing/figure.h>
#include <placegraph/eval/trajectory/result.h>
#include <placegraph/graph/image/ground_picture.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace placegraph {

/// A trajectory in a top view; a lost frame has no position and leaves a gap in the line.
struct PlotCurve {
  std::string name;  ///< in the legend
  std::vector<std::optional<Eigen::Vector3d>> positions_m;
  bool reference = false;  ///< ground truth: grey, below the others; determines the axes
  double width_px = 2;
  /// Error at each position [m], 0 where there is none, which then colours the line; may be empty.
  std::vector<double> error_m = {};
  std::string series = {};  ///< as FigureLine::series
};

/// A position error over the distance travelled and over time, drawn in the colour of the estimate
/// it belongs to.
struct PlotError {
  int estimate = 0;  ///< index among the curves that are no reference
  std::vector<double> distance_m;
  std::vector<double> time_s;                  ///< since the first frame; empty: not known
  std::vector<std::optional<double>> error_m;  ///< one for each distance
};

using PlotLinks = std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>;

/// Trajectories with what belongs to them.
struct Plot {
  std::string title;
  std::vector<std::string> notes;  ///< lines below the title
  std::string unit = "m";          ///< unit of the positions; "units" if their scale is unknown
  std::vector<PlotCurve> curves;
  std::vector<PlotError> errors;
  std::vector<Eigen::Vector3d> places_m;  ///< nodes of the map
  /// Names of the places, written where there is room, the first ones first; empty: none.
  std::vector<std::string> place_names;
  PlotLinks links_m;                    ///< loop closures
  PlotLinks rejected_links_m;           ///< false ones
  std::optional<GroundPicture> ground;  ///< under the view from above
};

/// Views from above and from the side, and beside them the errors, if there are any.
/// The view from above shows the two axes of largest extent of the first reference (else of the
/// first curve) in equal scale. The view from the side shows the third axis, stretched if it is
/// small, and shares the longer axis of the other view. There is none if all lies in a plane.
/// Throws ArgumentError if there is a picture of the ground, and the view from above does not show
/// x and y, or nothing of the picture.
Figure figure_of(const Plot& plot);
std::string to_svg(const Plot& plot);

/// Views from above of several sequences, each with its title and its own axes.
Figure figure_of(const std::vector<Plot>& sequences, const std::string& title,
                 const std::vector<std::string>& notes);

/// Ground truth, aligned estimates and their errors; failed results are left out. The curve of a
/// single estimate is coloured by its error.
Plot plot_of(const std::vector<EvaluationResult>& results);

/// The two axes (0 = x, 1 = y, 2 = z) of largest extent of the positions, ascending; x and z for a
/// drive along z with a lateral extent of less than a tenth.
std::pair<int, int> top_view_axes(const std::vector<std::optional<Eigen::Vector3d>>& positions_m);

}  // namespace placegraph
