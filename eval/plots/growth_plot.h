#pragma once
#include <string>
#include <vector>

namespace placegraph {

/// Costs at several sizes; both positive, sizes ascending.
struct GrowthCurve {
  std::string name;
  std::vector<double> sizes, values;
};

struct GrowthPanel {
  std::string heading;  ///< quantity and unit
  std::vector<GrowthCurve> curves;
};

/// Panels beside each other, both axes logarithmic in the same scale, so that a slope of one is
/// growth in proportion; a grey line of that slope runs through the first point of the first curve.
struct GrowthPlot {
  std::string title, size_label;
  std::vector<GrowthPanel> panels;
};

/// Throws ArgumentError for a curve that is empty, not positive or of unequal lengths.
std::string to_svg(const GrowthPlot& plot);

}  // namespace placegraph
