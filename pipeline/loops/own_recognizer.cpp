#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/pipeline/loops/own_recognizer.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace placegraph {
namespace {

/// The candidates for one stretch of views.
std::vector<PlaceSimilarity> checked_candidates(PlaceRetrieval& recognizer, const Image& image,
                                                int first, int last) {
  std::vector<PlaceSimilarity> candidates = recognizer.query(image, first, last);
  std::set<int> seen;
  for (const PlaceSimilarity& each : candidates) {
    require(each.view >= first && each.view <= last,
            fmt::format("recognizer: query returned view {}, which is not one of {} to {}",
                        each.view, first, last));
    require(std::isfinite(each.score),
            fmt::format("recognizer: query returned score {} of view {}", each.score, each.view));
    require(seen.insert(each.view).second,
            fmt::format("recognizer: query returned view {} twice", each.view));
  }
  return candidates;
}

}  // namespace

std::vector<PlaceSimilarity> ask_recognizer(PlaceRetrieval& recognizer, const Image& image,
                                            FrameId frame, int views, int count,
                                            const std::function<bool(int)>& allowed) {
  std::vector<PlaceSimilarity> found;
  recognizer.begin_frame(frame);
  for (int first = 0; first < views; ++first) {
    if (!allowed(first)) continue;
    int last = first;
    while (last + 1 < views && allowed(last + 1)) ++last;
    const auto candidates = checked_candidates(recognizer, image, first, last);
    found.insert(found.end(), candidates.begin(), candidates.end());
    first = last;
  }
  std::ranges::stable_sort(found, std::ranges::greater(), &PlaceSimilarity::score);
  if (found.size() > static_cast<std::size_t>(count)) found.resize(static_cast<std::size_t>(count));
  return found;
}

void show_keyframes(PlaceRetrieval* recognizer, const Map& map,
                    const std::function<Frame(FrameId)>& frame_of) {
  if (!recognizer) return;
  require(static_cast<bool>(frame_of), "Slam::resume: the recognizer lacks the images of the map");
  for (const Keyframe& keyframe : map.keyframes) {
    check_interruption();
    recognizer->begin_frame(keyframe.frame);
    recognizer->add(recognizer_image(frame_of(keyframe.frame)));
  }
}

}  // namespace placegraph
