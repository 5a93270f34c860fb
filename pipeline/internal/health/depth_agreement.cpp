#include <fmt/format.h>
#include <placegraph/frontend/internal/features/depth_lookup.h>
#include <placegraph/frontend/internal/relative_pose/mono_initializer.h>
#include <placegraph/graph/internal/core/median.h>
#include <placegraph/graph/internal/core/random.h>
#include <placegraph/pipeline/internal/health/depth_agreement.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Minimum number of pairs for a result.
constexpr std::size_t kFewestPairs = 3;

}  // namespace

std::optional<double> unexplained_share(const std::vector<TwoInverseDepths>& depths) {
  constexpr std::size_t kFewest = 40;
  constexpr double kSigmas = 3;
  if (depths.size() < kFewest) return std::nullopt;
  const auto median = [&](auto&& value) {
    std::vector<double> values;
    for (const TwoInverseDepths& d : depths) values.push_back(value(d));
    return median_of(std::move(values));
  };
  const double factor = median([](const auto& d) { return d.from_views / d.measured; });
  const double constant = median([](const auto& d) { return d.from_views; });
  const double spread = median([&](const auto& d) { return std::abs(d.from_views - constant); });
  if (!(spread > kSigmas * median([](const auto& d) { return d.sigma; }))) return std::nullopt;
  return median([&](const auto& d) { return std::abs(d.from_views - factor * d.measured); }) /
         spread;
}

DepthAgreement::DepthAgreement(const Calibration& calibration) : calibration_(calibration) {}

void DepthAgreement::add(const Frame& frame) {
  // Takes about a hundredth of the time of a run.
  constexpr int kFramesBetweenPairs = 40, kFramesAStep = 6, kSteps = 3;
  if (!calibration_.depth) return;
  ++frames_;
  if (!tracker_) {
    if (pairs_.size() < kFewestPairs || frames_ > kFramesBetweenPairs) begin(frame);
    return;
  }
  if (frames_ % kFramesAStep != 0) return;
  tracker_->track(frame.image);
  const auto depths = compare();
  const auto unexplained = depths ? unexplained_share(*depths) : std::nullopt;
  if (!unexplained && frames_ < kSteps * kFramesAStep) return;
  if (unexplained) add(*unexplained);
  tracker_.reset();
  frames_ = 0;
}

void DepthAgreement::begin(const Frame& frame) {
  if (frame.depth.empty()) return;
  PointTrackerOptions options;
  options.max_tracks = 200;
  options.max_anchor_shift_px = 0;
  tracker_.emplace(options);
  tracker_->track(frame.image);
  tracker_->detect(frame.mask);
  px_first_.clear();
  for (const PointTrack& track : tracker_->tracks()) px_first_[track.id] = track.px.cast<double>();
  depth_first_ = frame.depth;
  frames_ = 0;
}

/// Nothing if the views show too little parallax.
std::optional<std::vector<TwoInverseDepths>> DepthAgreement::compare() const {
  constexpr double kLeastParallaxDeg = 1, kSigmaPx = 0.7;
  const Camera& camera = calibration_.camera;
  std::vector<Eigen::Vector2d> px_first, px_now;
  std::vector<Eigen::Vector2f> found_depth;
  for (const PointTrack& track : tracker_->tracks()) {
    px_first.push_back(px_first_.at(track.id));
    px_now.push_back(track.px.cast<double>());
    found_depth.push_back(px_first.back().cast<float>());
  }
  Random random(0, 0);
  MonoInitializerOptions options;
  options.min_parallax_deg = kLeastParallaxDeg;
  const MonoInitialization views = initialize_mono(camera, px_first, px_now, {}, options, random);
  if (!views.outcome) return std::nullopt;
  const auto measured = lookup_depth(depth_first_, camera, *calibration_.depth, found_depth);
  const Eigen::Vector3d& t = views.T_ref_cur.translation();
  std::vector<TwoInverseDepths> depths;
  for (std::size_t i = 0; i < px_first.size(); ++i) {
    const auto& point = views.points_ref[i];
    const auto ray = camera.unproject(px_first[i]);
    if (!point || !measured[i] || !ray || !(point->z() > 0)) continue;
    const double px_per_inverse = camera.fx * (t.head<2>() - ray->head<2>() * t.z()).norm();
    depths.push_back({1 / point->z(), kSigmaPx / std::max(px_per_inverse, 1e-9), 1 / *measured[i]});
  }
  return depths;
}

void DepthAgreement::add(double unexplained) { pairs_.push_back(unexplained); }

std::optional<DataNote> DepthAgreement::note() const {
  constexpr double kMost = 0.5;
  if (pairs_.size() < kFewestPairs) return std::nullopt;
  const auto contradict = static_cast<std::size_t>(
      std::ranges::count_if(pairs_, [](double unexplained) { return unexplained > kMost; }));
  if (2 * contradict <= pairs_.size()) return std::nullopt;
  return DataNote{
      fmt::format(
          "the depth images do not fit the points that two views show, in {} of {} pairs of "
          "frames: they are of another time, mirrored, or not measured",
          contradict, pairs_.size()),
      true, NoteCause::kDepthMismatch,
      "compare the file names or stamps of images and depth images, and their orientation"};
}

}  // namespace placegraph
