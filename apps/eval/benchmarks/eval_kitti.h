#pragma once
#include <placegraph/eval/kitti/kitti_result.h>

#include <string>
#include <vector>

namespace placegraph::apps {

struct EvalKittiArguments {
  std::string truth;                   ///< folder of true poses
  std::vector<std::string> estimates;  ///< a folder of estimates for each system
  std::vector<std::string> sequences;  ///< those to judge; empty: all of `truth`
  std::string out;                     ///< folder for tables and plots; empty: none
  std::string format = "png";          ///< of the plots, one of kitti_plot_formats()
  bool force = false;                  ///< write into a folder that holds files
};

/// Judges submissions to KITTI's odometry benchmark: `placegraph eval kitti`.
/// Writes the tables and plots if no submission has a fault. Throws ArgumentError, FileError.
KittiBenchmark eval_kitti(const EvalKittiArguments& arguments);

}  // namespace placegraph::apps
