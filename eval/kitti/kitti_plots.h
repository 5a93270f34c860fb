#pragma once
#include <placegraph/eval/drawing/figure.h>
#include <placegraph/eval/kitti/kitti_result.h>

#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// What the benchmark of KITTI draws.
enum class KittiPlot {
  kPath,                   ///< the true and the estimated path from above
  kTranslationOverLength,  ///< mean error in translation over the length of segments
  kRotationOverLength,     ///< mean error in rotation over the length of segments
  kTranslationOverSpeed,   ///< mean error in translation over the speed
  kRotationOverSpeed       ///< mean error in rotation over the speed
};

/// Their names, in the order of KittiPlot.
/// They are path, tl, rl, ts and rs: the latter four end the devkit's names of files.
const std::vector<std::string>& kitti_plot_names();

/// The name under which the means over all sequences are drawn, as the devkit calls them.
inline constexpr const char* kKittiAverage = "avg";

/// A figure of a sequence, or of the means (`kKittiAverage`), with a curve for each system.
///
/// Paths are drawn as they are given, not aligned. Nothing if no system has what is drawn: a path
/// of the means, an estimate with faults, a drive without three segments of one length or speed.
std::optional<Figure> figure_of(const KittiBenchmark& benchmark, const std::string& sequence,
                                KittiPlot plot);

}  // namespace placegraph
