#pragma once
#include <placegraph/eval/loops/precision_recall.h>

#include <string>
#include <vector>

namespace placegraph {

/// The curve of a system.
struct PrecisionRecallCurve {
  std::string name;  ///< in the legend
  PrecisionRecall figures;
};

/// Precision over recall, both from 0 to 1.
/// A curve per system, a disc at the last threshold without a false prediction. Recall increases in
/// steps, one per threshold.
struct PrecisionRecallPlot {
  std::vector<PrecisionRecallCurve> curves;
  std::string protocol;  ///< how predictions were judged
};

/// Throws ArgumentError if there is no curve.
std::string to_svg(const PrecisionRecallPlot& plot);

}  // namespace placegraph
