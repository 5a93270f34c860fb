#include <placegraph/frontend/places/place_view.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/map/map_learner.h>

namespace placegraph {

namespace {

/// Similarity of any two views: the median over pairs that are far from each other.
double common_similarity(const std::vector<PlaceView>& views, const PlaceCueOptions& cues) {
  // Pairs: the cost. Chosen.
  constexpr std::size_t kSamples = 100;
  const std::size_t half = views.size() / 2;
  const std::size_t stride = std::max<std::size_t>(1, half / kSamples);
  std::vector<double> sums;
  for (std::size_t i = 0; i + half < views.size(); i += stride)
    sums.push_back(grid_similarity(views[i], views[i + half], cues).sum());
  return median_of(sums);
}

}  // namespace

StoredMap learn_map(std::size_t count, const std::function<Image(std::size_t)>& image,
                    std::int64_t first, const MapLearnerOptions& options) {
  options.check();
  // As for the localization in a map. Chosen.
  constexpr std::size_t kFewest = 10;
  require(count >= kFewest, "a map requires at least ten images: " + std::to_string(count));
  std::vector<PlaceView> views;
  for (std::size_t i = 0; i < count; ++i)
    views.push_back(describe_place(image(i), options.cues, false));

  StoredMap stored;
  const double common = common_similarity(views, options.cues);
  const auto similar = [&](std::size_t a, std::size_t b) {
    return grid_similarity(views[a], views[b], options.cues).sum() - common;
  };
  std::size_t anchor = 0;
  auto& places = stored.map.place_graph.places;
  for (std::size_t i = 0; i < count; ++i) {
    const KeyframeId id(i);
    if (i == 0 || (i > anchor + 1 && similar(i, anchor) < options.similar * similar(i, i - 1))) {
      anchor = i;
      Place& place = places.emplace_back();
      place.id = PlaceId(places.size() - 1);
      place.anchor_keyframe = id;
    }
    places.back().members.push_back({id, SE3(), 1});
    Keyframe keyframe;
    keyframe.id = id;
    keyframe.frame = FrameId(first + id.value());
    keyframe.stamp_ns = first + id.value();
    keyframe.place = places.back().id;
    keyframe.view = views[i];
    stored.map.frames.push_back({keyframe.frame, keyframe.stamp_ns, id, std::nullopt});
    stored.map.trajectory_online.poses.push_back({keyframe.stamp_ns, std::nullopt});
    stored.map.keyframes.push_back(std::move(keyframe));
  }
  return stored;
}

}  // namespace placegraph
