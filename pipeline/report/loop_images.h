#pragma once
#include <placegraph/graph/core/log.h>
#include <placegraph/pipeline/report/loops_page.h>

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace placegraph::report {

/// A judged loop of a page.
struct PageLoop {
  FrameId query, match;
  double score = 0;     ///< not a number for a missed one
  int rank = 0;         ///< rank of the first true candidate; 0: none
  std::string verdict;  ///< "right", "wrong" or "missed"
  std::string reason;   ///< test that decided, or why nothing was proposed; may be empty
};

/// The best candidate of every query, right or wrong, and for a query with a true match and no
/// candidate the middle one of its true matches, as missed; by query.
std::vector<PageLoop> page_loops(const LoopBenchmark& benchmark, const LoopTruth& truth);

/// Thumbnails of the images of judged loops, as keyframes of a report; without any, no keyframes.
///
/// They are those of a map.db beside the predictions, else the images of the KITTI sequence in
/// whose folder the true poses are, if it has `images` frames. The wrong loops come first, then the
/// missed ones: a page has at most 1,000 images. `log` takes a warning if they cannot be read.
nlohmann::json describe_loop_images(const std::vector<PageLoop>& loops,
                                    const std::string& predictions_file,
                                    const std::string& poses_file, std::int64_t images,
                                    const LogSink& log);

}  // namespace placegraph::report
