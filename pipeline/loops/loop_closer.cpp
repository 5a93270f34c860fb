#include <placegraph/frontend/places/place_database.h>
#include <placegraph/frontend/places/verification/loop_verifier.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/pipeline/loops/loop_closer.h>
#include <placegraph/pipeline/loops/loop_gates.h>
#include <placegraph/pipeline/loops/loop_probability.h>
#include <placegraph/pipeline/loops/own_recognizer.h>

#include <algorithm>
#include <unordered_set>

namespace placegraph {
namespace {

// Factor on the information of a loop: feature noise is correlated, so that the number of inliers
// overestimates the information. Chosen.
constexpr double kLoopInformationScale = 0.1;
// Number of keyframes within which a second loop must agree. Chosen.
constexpr std::size_t kSupportWindow = 4;

}  // namespace

LoopCloser::LoopCloser(const LoopOptions& options, const Calibration& calibration,
                       std::uint64_t seed, std::shared_ptr<PlaceRetrieval> recognizer)
    : options_(options),
      describer_(options.detector, options.verifier.matcher, calibration),
      seed_(seed),
      database_(options.database, seed),
      recognizer_(std::move(recognizer)) {
  options_.check();
  if (recognizer_) recognizer_->clear();
}

LoopCloser::LoopCloser(const LoopOptions& options, const Calibration& calibration,
                       std::uint64_t seed, const Map& map,
                       std::shared_ptr<PlaceRetrieval> recognizer,
                       const std::function<Frame(FrameId)>& frame_of)
    : LoopCloser(options, calibration, seed, std::move(recognizer)) {
  show_keyframes(recognizer_.get(), map, frame_of);
  for (const Keyframe& keyframe : map.keyframes) {
    require(views_.empty() || views_.back().keyframe < keyframe.id,
            "LoopCloser: the map's keyframes must be in the order of their ids");
    database_.add(keyframe.id, keyframe.features);
    views_.push_back({keyframe.id, keyframe.frame, keyframe.features, {}});
  }
  records_ = map.loops;
}

/// Where the view of a keyframe is in views_.
std::size_t LoopCloser::number_of(KeyframeId keyframe) const {
  const auto at = std::ranges::lower_bound(views_, keyframe, {}, &View::keyframe);
  return static_cast<std::size_t>(at - views_.begin());
}

bool LoopCloser::correct_views() {
  for (View& view : views_) correct(view);
  return views_corrected_;
}

void LoopCloser::correct(View& view) {
  if (describer_.correct(view, views_.back().errors.errors)) views_corrected_ = true;
}

void LoopCloser::add_view(KeyframeId keyframe, const Frame& frame,
                          const std::optional<SE3>& T_previous_this, std::vector<LineFeature> lines,
                          const FrameErrors& errors) {
  View view = describer_.describe(keyframe, frame, std::move(lines), errors);
  if (T_previous_this && !views_.empty())
    describer_.triangulate(views_.back(), view, *T_previous_this);
  database_.add(keyframe, view.features);
  views_.push_back(std::move(view));
  if (!recognizer_) return;
  newest_image_ = recognizer_image(frame);
  recognizer_->begin_frame(frame.id);
  recognizer_->add(newest_image_);
}

/// The views that are most similar to an image with the given features, the best first.
std::vector<PlaceCandidate> LoopCloser::similar_views(
    const std::vector<Feature>& features, const Image& image, FrameId frame,
    const std::function<bool(KeyframeId)>& allowed) const {
  if (!recognizer_) return database_.query(features, options_.candidates, allowed);
  const auto keyframe_of = [&](int view) {
    return views_[static_cast<std::size_t>(view)].keyframe;
  };
  std::vector<PlaceCandidate> candidates;
  for (const PlaceSimilarity& each :
       ask_recognizer(*recognizer_, image, frame, static_cast<int>(views_.size()),
                      options_.candidates, [&](int view) { return allowed(keyframe_of(view)); }))
    candidates.push_back({keyframe_of(each.view), each.score});
  return candidates;
}

/// Similarity of a view to the one before it; 0 for the first, which has no reference.
double LoopCloser::similarity_to_previous(std::size_t number) const {
  return number == 0 ? 0
                     : database_.similarity(views_[number].features, views_[number - 1].keyframe);
}

/// Older views similar to the newest one, the most similar first. In another component of the map
/// the newest ones count too.
std::vector<LoopCloser::Candidate> LoopCloser::retrieve(const KnownMotions& known) {
  const View& query = views_.back();
  const double unit = recognizer_ ? 1 : similarity_to_previous(views_.size() - 1);
  std::vector<Candidate> candidates;
  for (const PlaceCandidate& candidate :
       similar_views(query.features, newest_image_, query.frame, [&](KeyframeId id) {
         return query.frame.value() - view(id).frame.value() >= options_.min_frame_gap ||
                (known.apart && known.apart(id, query.keyframe));
       }))
    candidates.push_back({&views_[number_of(candidate.id)], unit > 0 ? candidate.score / unit : 1});
  return candidates;
}

/// The relative pose of a view and an older one from their features.
std::optional<Loop> LoopCloser::verify(const View& query, const View& match, bool free_scale,
                                       LoopRecord& record) const {
  Random random(seed_, "loop", {query.frame.value(), match.keyframe.value()});
  const LoopVerification verified =
      verify_loop(describer_.camera(), query.for_verification(), match.for_verification(),
                  options_.verifier, random, free_scale);
  record.inliers = verified.inliers;
  record.lines = verified.lines;
  record.model = verified.model;
  if (!verified.outcome) return std::nullopt;
  record.T_match_query = verified.T_match_query;
  return Loop{query.keyframe, match.keyframe, verified.T_match_query,
              kLoopInformationScale * verified.information, verified.scale_match_query};
}

std::optional<Loop> LoopCloser::measure(KeyframeId query, KeyframeId match, bool free_scale,
                                        LoopRecord& record) const {
  const auto position = std::ranges::lower_bound(views_, query, {}, &View::keyframe);
  require(match < query && position != views_.end() && position->keyframe == query &&
              view(match).keyframe == match,
          "LoopCloser::measure: two known keyframes needed, the later one first");
  record = LoopRecord();
  record.query_frame = position->frame;
  record.match_frame = view(match).frame;
  const double reference =
      similarity_to_previous(static_cast<std::size_t>(position - views_.begin()));
  record.similarity =
      reference > 0 ? database_.similarity(position->features, match) / reference : 1;
  return verify(*position, view(match), free_scale, record);
}

/// The loop to a candidate if it passes all tests except support; the record's stage is the
/// deciding test.
std::optional<Loop> LoopCloser::judge(const Candidate& candidate, const KnownMotions& known,
                                      double median_depth_m, LoopRecord& record) const {
  const KeyframeId match = candidate.match->keyframe, query = views_.back().keyframe;
  record.stage = LoopStage::kRetrieval;
  if (!recognizer_ && candidate.similarity < options_.min_similarity) return std::nullopt;

  const bool free_scale = known.scale_unknown && known.scale_unknown(match, query);
  const auto odometry = known.odometry ? known.odometry(match, query) : std::nullopt;
  record.stage = LoopStage::kReach;
  if (!free_scale && odometry &&
      !within_reach(*odometry, farthest_depth(*candidate.match), median_depth_m, options_))
    return std::nullopt;

  record.stage = LoopStage::kGeometry;
  const std::optional<Loop> loop = verify(views_.back(), *candidate.match, free_scale, record);
  if (!loop) return std::nullopt;

  record.stage = LoopStage::kDrift;
  if (odometry && !within_drift(*loop, *odometry, median_depth_m, free_scale, options_))
    return std::nullopt;

  record.stage = LoopStage::kCovariance;
  const auto predicted = known.map ? known.map(match, query) : std::nullopt;
  if (predicted && !within_covariance(*loop, *predicted, median_depth_m, options_))
    return std::nullopt;

  record.stage = LoopStage::kSupport;
  return loop;
}

void LoopCloser::accept(const Pending& pending, std::vector<Loop>& accepted) {
  LoopRecord& record = records_[pending.record];
  if (record.accepted()) return;
  record.stage = LoopStage::kAccepted;
  record.probability = loop_probability(record);
  accepted.push_back(pending.loop);
}

/// The newest loop, which is in pending_, and those that agree with it, if there are any.
std::vector<Loop> LoopCloser::support(const MotionBetween& odometry, double median_depth_m) {
  std::vector<Loop> accepted;
  const Pending& found = pending_.back();
  for (const Pending& other : pending_) {
    if (other.loop.query == found.loop.query || !odometry) continue;
    const auto queries = odometry(other.loop.query, found.loop.query);
    const auto matches = odometry(other.loop.match, found.loop.match);
    if (!queries || !matches || !agree(other.loop, found.loop, *queries, *matches, median_depth_m))
      continue;
    accept(other, accepted);
    accept(found, accepted);
  }
  return accepted;
}

std::vector<Loop> LoopCloser::find_loops(const KnownMotions& known, double median_depth_m) {
  std::vector<Loop> accepted;
  for (const Candidate& candidate : retrieve(known)) {
    LoopRecord record;
    record.query_frame = views_.back().frame;
    record.match_frame = candidate.match->frame;
    record.similarity = candidate.similarity;
    correct(*candidate.match);
    const std::optional<Loop> loop = judge(candidate, known, median_depth_m, record);
    record.probability = loop_probability(record);
    records_.push_back(record);
    if (record.stage == LoopStage::kRetrieval) break;  // the remaining candidates are less similar
    if (!loop) continue;
    pending_.push_back({*loop, records_.size() - 1, views_.size()});
    accepted = support(known.odometry, median_depth_m);
    break;
  }
  while (!pending_.empty() && views_.size() - pending_.front().view >= kSupportWindow)
    pending_.pop_front();
  return accepted;
}

std::optional<LocatedFrame> LoopCloser::relocalize(const Frame& frame,
                                                   std::size_t last_views) const {
  std::vector<KeyframeId> tries;
  for (std::size_t back = 1; back <= last_views && back <= views_.size(); ++back)
    tries.push_back(views_[views_.size() - back].keyframe);
  return relocalize(frame, std::move(tries));
}

std::optional<LocatedFrame> LoopCloser::relocalize(const Frame& frame,
                                                   std::vector<KeyframeId> tries) const {
  if (views_.empty()) return std::nullopt;
  const std::vector<Feature> features = describer_.features(frame);
  for (const PlaceCandidate& c :
       similar_views(features, recognizer_image(frame), frame.id, [](KeyframeId) { return true; }))
    if (std::find(tries.begin(), tries.end(), c.id) == tries.end()) tries.push_back(c.id);
  for (const KeyframeId id : tries) {
    Random random(seed_, "relocalization", {frame.id.value(), id.value()});
    const LoopVerification verified = verify_loop(
        describer_.camera(), features, view(id).for_verification(), options_.verifier, random);
    // No second loop supports this one: two views and a few depths are insufficient.
    if (verified.outcome && verified.model == LoopModel::kPoints3d2d)
      return LocatedFrame{id, verified.T_match_query, kLoopInformationScale * verified.information};
  }
  return std::nullopt;
}

void LoopCloser::rescale(double factor, KeyframeId first_keyframe) {
  std::unordered_set<FrameId> rescaled;
  for (std::size_t i = number_of(first_keyframe); i < views_.size(); ++i) {
    placegraph::rescale(views_[i], factor);
    rescaled.insert(views_[i].frame);
  }
  // Loops measured with the old scale must not be compared with those of the new one.
  pending_.clear();
  for (LoopRecord& record : records_)
    if (rescaled.contains(record.match_frame))
      record.T_match_query = record.T_match_query.scaled(factor);
}

}  // namespace placegraph
