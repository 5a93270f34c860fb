#include "apps/eval/benchmarks/eval_kitti.h"

#include <placegraph/io/files/output_file.h>
#include <placegraph/pipeline/kitti/kitti_benchmark.h>
#include <placegraph/pipeline/kitti/kitti_files.h>

namespace placegraph::apps {

KittiBenchmark eval_kitti(const EvalKittiArguments& arguments) {
  if (!arguments.out.empty()) require_free_folder(arguments.out, arguments.force);
  KittiBenchmark benchmark =
      evaluate_kitti(arguments.truth, arguments.estimates, arguments.sequences);
  if (!arguments.out.empty() && benchmark.faults() == 0)
    write_kitti_files(benchmark, arguments.out, arguments.format, arguments.force);
  return benchmark;
}

}  // namespace placegraph::apps
