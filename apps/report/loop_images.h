#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace placegraph::apps {

struct PageLoop;

/// Thumbnails of the images of judged loops, as keyframes of a report; without any, no keyframes.
///
/// They are those of a map.db beside the predictions, else the images of the KITTI sequence in
/// whose folder the true poses are, if it has `images` frames. The wrong loops come first, then the
/// missed ones: a page has at most 1,000 images.
nlohmann::json describe_loop_images(const std::vector<PageLoop>& loops,
                                    const std::string& predictions_file,
                                    const std::string& poses_file, std::int64_t images);

}  // namespace placegraph::apps
