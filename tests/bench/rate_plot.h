#pragma once
#include <string>
#include <vector>

namespace placegraph::bench {

/// A share in [0, 1] over some quantity.
struct RateCurve {
  std::string name;
  std::vector<double> at, rate;  ///< as many
};

struct RatePanel {
  std::string heading;
  std::vector<RateCurve> curves;
};

/// Panels in rows of `columns`, all with the axes of the first: from nothing to the greatest `at`,
/// from 0 to 100 %. PNG, SVG or PDF, as the path ends.
void write_rate_plot(const std::string& path, const std::string& title, const std::string& label,
                     const std::vector<RatePanel>& panels, int columns);

}  // namespace placegraph::bench
