#include <fmt/format.h>
#include <placegraph/frontend/places/place_similarity.h>
#include <placegraph/frontend/places/place_view.h>
#include <placegraph/frontend/places/verification/recognition_probability.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/pipeline/loops/loop_closer.h>
#include <placegraph/pipeline/map/map_localizer.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace placegraph {

/// The map, its views for recognition, and the tests of a match.
struct MapLocalizer::Impl {
  Impl(const LocalizerOptions& options, StoredMap stored);
  std::vector<Localization> localize(std::size_t count, const Frames& frames, bool sequence) const;
  std::string why_incomparable(const Frame& frame) const;
  std::string why_no_features(const Image& grey) const;
  std::vector<PlaceSimilarity> similarities(const PlaceView& view) const;
  void learn_near();
  int lag_of_similarity() const;
  bool near(int a, int b) const;
  std::optional<RecognitionProbability> odds(bool sequence) const;
  std::vector<ViewEvidence> evidence(const std::vector<std::vector<PlaceSimilarity>>& lists,
                                     bool sequence) const;
  Localization described(const ViewEstimate& estimate, double probability) const;
  std::optional<LocatedFrame> verify(const Frame& frame,
                                     const std::vector<PlaceSimilarity>& list) const;
  void take_geometry(const LocatedFrame& located, Localization& result) const;
  const Keyframe& keyframe_of(int view) const;

  LocalizerOptions options_;
  StoredMap stored_;
  bool in_colour_ = false;
  PlaceRecognizer recognizer_;
  std::vector<int> keyframes_;  ///< indices of the views' keyframes in the map
  int lag_ = 1;                 ///< distance of views whose similarity is that of any others
  std::set<std::pair<PlaceId, PlaceId>> adjacent_;  ///< pairs of places connected by an edge
  std::optional<LoopCloser> closer_;
};

MapLocalizer::MapLocalizer(const LocalizerOptions& options, StoredMap stored)
    : impl_(std::make_unique<Impl>(options, std::move(stored))) {}
MapLocalizer::~MapLocalizer() = default;
MapLocalizer::MapLocalizer(MapLocalizer&&) noexcept = default;
MapLocalizer& MapLocalizer::operator=(MapLocalizer&&) noexcept = default;

std::vector<Localization> MapLocalizer::localize(std::size_t count, const Frames& frames,
                                                 bool sequence) const {
  return impl_->localize(count, frames, sequence);
}

MapLocalizer::Impl::Impl(const LocalizerOptions& options, StoredMap stored)
    : options_(options), stored_(std::move(stored)), recognizer_(options.recognizer) {
  options_.check();
  std::vector<Keyframe>& all = stored_.map.keyframes;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].view.empty()) continue;
    const PlaceCueOptions& cues = options_.recognizer.cues;
    require((cues.tiny == 0) == all[i].view.tiny.empty() &&
                (cues.gradients == 0) == all[i].view.gradients.empty(),
            "map: its views were described by other cues");
    recognizer_.add(std::move(all[i].view));
    keyframes_.push_back(static_cast<int>(i));
    all[i].view = PlaceView();
  }
  // Views for a distribution of similarities. Chosen.
  constexpr int kFewest = 10;
  require(recognizer_.size() >= kFewest, "map: " + std::to_string(recognizer_.size()) + " views; " +
                                             std::to_string(kFewest) +
                                             " are needed to distinguish places");
  in_colour_ = !recognizer_.view(0).colour.empty();
  learn_near();
  const auto has_depth = [](const Keyframe& keyframe) {
    return std::any_of(keyframe.features.begin(), keyframe.features.end(),
                       [](const Feature& feature) { return feature.point_cam.has_value(); });
  };
  if (options_.geometry && stored_.origin.calibration &&
      std::any_of(all.begin(), all.end(), has_depth))
    closer_.emplace(options_.loops, *stored_.origin.calibration, 0, stored_.map);
}

/// Stage that refuses an image before the comparison; empty if it can be compared.
std::string MapLocalizer::Impl::why_incomparable(const Frame& frame) const {
  if (frame.image.empty()) return "unreadable";
  return in_colour_ && frame.colour.empty() ? "grey" : "";
}

/// Reason why the features of an image cannot be compared with the map's; empty if they can.
std::string MapLocalizer::Impl::why_no_features(const Image& grey) const {
  if (!closer_) return "the map has no camera or no features of known depth, or geometry is off";
  const Camera& camera = stored_.origin.calibration->camera;
  if (grey.cols == camera.width && grey.rows == camera.height) return "";
  return fmt::format("of {} x {} px by an unknown camera, the map's is of {} x {} px", grey.cols,
                     grey.rows, camera.width, camera.height);
}

const Keyframe& MapLocalizer::Impl::keyframe_of(int view) const {
  return stored_.map
      .keyframes[static_cast<std::size_t>(keyframes_[static_cast<std::size_t>(view)])];
}

std::vector<PlaceSimilarity> MapLocalizer::Impl::similarities(const PlaceView& view) const {
  return recognizer_.query(view, 0, recognizer_.size() - 1);
}

void MapLocalizer::Impl::learn_near() {
  for (const RelativePoseConstraint& edge : stored_.map.place_graph.constraints) {
    const PlaceId from = place_of_node(edge.from), to = place_of_node(edge.to);
    adjacent_.emplace(from, to);
    adjacent_.emplace(to, from);
  }
  lag_ = lag_of_similarity();
}

/// Number of views between two whose similarity is that of any two: the distance at which three
/// quarters of the additional similarity of neighbours are lost.
int MapLocalizer::Impl::lag_of_similarity() const {
  // Pairs a distance and longest distance: the cost. Chosen.
  constexpr int kSamples = 40, kLongest = 50;
  // Three quarters are lost, as above.
  constexpr double kRest = 0.25;
  const int views = recognizer_.size();
  const auto mean_at = [&](int lag) {
    double sum = 0;
    int count = 0;
    const int stride = std::max(1, (views - lag) / kSamples);
    for (int i = 0; i + lag < views; i += stride, ++count)
      sum +=
          grid_similarity(recognizer_.view(i), recognizer_.view(i + lag), options_.recognizer.cues)
              .sum();
    return sum / std::max(1, count);
  };
  const double any = 0.5 * (mean_at(views / 3) + mean_at(views / 2));
  const double next = mean_at(1);
  int lag = 1;
  while (lag < std::min(kLongest, views / 5) && mean_at(lag) - any > kRest * (next - any)) ++lag;
  return lag;
}

bool MapLocalizer::Impl::near(int a, int b) const {
  if (std::abs(a - b) <= lag_) return true;
  const PlaceId at = keyframe_of(a).place, other = keyframe_of(b).place;
  return at == other || adjacent_.count({at, other}) > 0;
}

std::vector<ViewEvidence> MapLocalizer::Impl::evidence(
    const std::vector<std::vector<PlaceSimilarity>>& lists, bool sequence) const {
  const int views = recognizer_.size();
  return sequence ? sequence_evidence(lists, views, options_.sequence)
                  : lone_evidence(lists, views);
}

/// Calibrates with the map's own views: matches without all views nearby are wrong, those without
/// only the view itself are right. Nothing if all views are similar or in one place, because they
/// then provide no examples of wrong matches.
std::optional<RecognitionProbability> MapLocalizer::Impl::odds(bool sequence) const {
  const int views = recognizer_.size();
  // Some stretches of a long map, as a sequence needs neighbours.
  const int stretches = views <= options_.calibration_views ? 1 : 3;
  const int length = std::min(views, options_.calibration_views) / stretches;
  const NearViews near = [this](int a, int b) { return this->near(a, b); };
  std::vector<ViewEstimate> wrong, right;
  for (int s = 0; s < stretches; ++s) {
    const int begin = s * views / stretches;
    std::vector<std::vector<PlaceSimilarity>> far, but_itself;
    for (int view = begin; view < begin + length; ++view) {
      check_interruption();
      far.emplace_back();
      but_itself.emplace_back();
      for (const PlaceSimilarity& similarity : similarities(recognizer_.view(view))) {
        if (similarity.view != view) but_itself.back().push_back(similarity);
        if (!near(similarity.view, view)) far.back().push_back(similarity);
      }
    }
    const auto of_far = evidence(far, sequence), of_others = evidence(but_itself, sequence);
    for (int i = 0; i < length; ++i) {
      const int view = begin + i;
      const auto index = static_cast<std::size_t>(i);
      const ViewEstimate not_near =
          view_estimate(of_far[index], near, [&](int other) { return !near(other, view); });
      if (not_near.view >= 0) wrong.push_back(not_near);
      const ViewEstimate other =
          view_estimate(of_others[index], near, [&](int candidate) { return candidate != view; });
      if (other.view >= 0) right.push_back(other);
    }
  }
  if (wrong.empty() || right.empty()) return std::nullopt;
  return RecognitionProbability(wrong, right);
}

Localization MapLocalizer::Impl::described(const ViewEstimate& estimate, double probability) const {
  Localization result;
  result.stage = "blank";
  if (estimate.view < 0) return result;
  const Keyframe& keyframe = keyframe_of(estimate.view);
  result.place = keyframe.place;
  result.keyframe = keyframe.id;
  result.frame = keyframe.frame;
  result.probability = probability;
  result.placed = result.probability >= options_.min_probability;
  result.stage = "appearance";
  return result;
}

std::vector<Localization> MapLocalizer::Impl::localize(std::size_t count, const Frames& frames,
                                                       bool sequence) const {
  std::vector<std::vector<PlaceSimilarity>> lists;
  std::vector<std::optional<LocatedFrame>> verified;
  std::vector<std::string> hindrances, incomparable;
  for (std::size_t i = 0; i < count; ++i) {
    check_interruption();
    const Frame frame = frames(i);
    incomparable.push_back(why_incomparable(frame));
    if (!incomparable.back().empty()) {
      lists.emplace_back();
      hindrances.emplace_back();
      verified.emplace_back();
      continue;
    }
    lists.push_back(similarities(
        describe_place(in_colour_ ? frame.colour : frame.image, options_.recognizer.cues, true)));
    hindrances.push_back(why_no_features(frame.image));
    verified.push_back(hindrances.back().empty() ? verify(frame, lists.back()) : std::nullopt);
  }
  const NearViews near = [this](int a, int b) { return this->near(a, b); };
  std::vector<ViewEstimate> estimates;
  for (const ViewEvidence& of_image : evidence(lists, sequence))
    estimates.push_back(view_estimate(of_image, near, [](int) { return true; }));
  // The range of the filter.
  const int reach =
      sequence ? static_cast<int>(std::lround(1 / (1 - options_.sequence.memory))) : 0;
  const auto calibration = odds(sequence);
  const std::vector<double> probabilities = calibration
                                                ? calibration->probabilities(estimates, near, reach)
                                                : std::vector<double>(count, 0.5);
  std::vector<Localization> result;
  for (std::size_t i = 0; i < count; ++i) {
    result.push_back(described(estimates[i], probabilities[i]));
    if (!incomparable[i].empty()) result.back().stage = incomparable[i];
    if (!calibration && estimates[i].view >= 0) result.back().stage = "calibration";
    if (verified[i]) take_geometry(*verified[i], result.back());
    if (result.back().placed && !result.back().T_map_cam)
      result.back().without_pose =
          hindrances[i].empty() ? "the features agree with no view of the map" : hindrances[i];
  }
  return result;
}

std::optional<LocatedFrame> MapLocalizer::Impl::verify(
    const Frame& frame, const std::vector<PlaceSimilarity>& list) const {
  // Candidates that are verified: the cost. Chosen.
  constexpr std::size_t kTries = 3;
  std::vector<KeyframeId> tries;
  for (std::size_t i = 0; i < std::min(kTries, list.size()); ++i)
    tries.push_back(keyframe_of(list[i].view).id);
  return closer_->relocalize(frame, std::move(tries));
}

/// Features agree with a pose by chance at most once in a thousand images; the probability from
/// whole views is combined with that, for the same place or against another.
void MapLocalizer::Impl::take_geometry(const LocatedFrame& located, Localization& result) const {
  // The thousand of the line above; the bound keeps the quotient finite. Chosen.
  constexpr double kOddsOfVerified = 1000, kSurest = 1 - 1e-9;
  const Keyframe& match = *stored_.map.find_keyframe(located.match);
  const bool agree = result.place && (*result.place == match.place ||
                                      adjacent_.contains({*result.place, match.place}));
  const double p = std::clamp(result.probability, 1 - kSurest, kSurest);
  const double odds = kOddsOfVerified * (agree ? p / (1 - p) : (1 - p) / p);
  result.probability = odds / (1 + odds);
  result.placed = result.probability >= options_.min_probability;
  result.place = match.place;
  result.keyframe = match.id;
  result.frame = match.frame;
  result.stage = "geometry";
  if (!result.placed) return;
  const Sim3 S_map_cam = stored_.map.S_map_keyframe(match.id) * Sim3(located.T_match_query);
  result.T_map_cam = SE3(S_map_cam.rotation(), S_map_cam.translation());
}

}  // namespace placegraph
