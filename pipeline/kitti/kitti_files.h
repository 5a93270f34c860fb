#pragma once
#include <placegraph/eval/kitti/kitti_result.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Formats of the plots: none, png, svg and pdf.
const std::vector<std::string>& kitti_plot_formats();

/// Writes the tables and the plots of a benchmark into a folder, under the devkit's names.
///
/// `stats.txt`, `errors/NN.txt`, `plot_path/NN.txt`, `plot_error/NN_tl.txt` (rl, ts, rs) and
/// `plot_error/avg_tl.txt` ... are the devkit's tables, in a folder for each system if there are
/// several; `figures.csv` has the figures of all. Beside the tables of plots are the plots, with a
/// curve for each system. All are made before the first is written. Throws ArgumentError if a
/// submission has faults, for an unknown format, and if the folder holds files and `force` is not
/// set; FileError if something cannot be written.
void write_kitti_files(const KittiBenchmark& benchmark, const std::string& folder,
                       const std::string& format = "png", bool force = false);

}  // namespace placegraph
