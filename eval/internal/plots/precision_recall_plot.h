#pragma once
#include <placegraph/eval/loops/precision_recall.h>

#include <string>
#include <vector>

namespace placegraph {

struct PrecisionRecallCurve {
  std::string name;  ///< in the legend
  PrecisionRecall figures;
};

/// Precision over recall, both from 0 to 1: a curve per system, a disc at the last threshold
/// without a false prediction. Recall increases in steps, one per threshold.
struct PrecisionRecallPlot {
  std::string title;
  std::vector<PrecisionRecallCurve> curves;
};

/// A picture of 900x800. Throws ArgumentError if there is no curve.
std::string to_svg(const PrecisionRecallPlot& plot);
std::string to_png(const PrecisionRecallPlot& plot);

}  // namespace placegraph
