#pragma once
#include <placegraph/eval/trajectory/result.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace placegraph {

/// A trajectory in a top view; a lost frame has no position and leaves a gap in the line.
struct PlotCurve {
  std::string name;  ///< in the legend; curves of the same name share a line of it
  std::vector<std::optional<Eigen::Vector3d>> positions_m;
  bool reference = false;  ///< ground truth: grey, below the others; determines the axes
};

/// A position error over the distance travelled, drawn in the colour of the estimate it belongs to.
struct PlotError {
  int estimate = 0;  ///< index among the curves that are no reference
  std::vector<double> distance_m;
  std::vector<std::optional<double>> error_m;  ///< one for each distance
};

/// The content of a figure. Left: the top view, on the two axes of largest extent of the first
/// reference (else of the first curve), in equal scale. Right: the errors, if there are any.
struct Plot {
  std::string title;
  std::string unit = "m";  ///< unit of the positions; "units" if their scale is unknown
  std::vector<PlotCurve> curves;
  std::vector<PlotError> errors;
  std::string error_label = "position error";
  std::vector<Eigen::Vector3d> places_m;  ///< nodes of the map
  /// Names of the places, written where there is room, the first ones first; empty: none.
  std::vector<std::string> place_names;
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> links_m;           ///< loop closures
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> rejected_links_m;  ///< false ones
};

/// Ground truth, aligned estimates and their errors; failed results are left out.
Plot plot_of(const std::vector<EvaluationResult>& results);

/// A picture of 1600x800 (1000x800 without errors) as SVG text or PNG bytes.
std::string to_svg(const Plot& plot);
std::string to_png(const Plot& plot);

/// The two axes (0 = x, 1 = y, 2 = z) of largest extent of the positions, ascending; x and z for a
/// drive along z with a lateral extent of less than a tenth.
std::pair<int, int> top_view_axes(const std::vector<std::optional<Eigen::Vector3d>>& positions_m);

}  // namespace placegraph
