#pragma once
#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/frontend/internal/flow/anchored_patch.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace placegraph {

/// One image point followed over time; the landmark that it becomes has its id.
struct PointTrack {
  LandmarkId id;
  Eigen::Vector2f px = Eigen::Vector2f::Zero();
  Eigen::Vector2f px_previous = Eigen::Vector2f::Zero();
  int age = 0;  ///< frames since detection
  /// Of px [px^2], against where the track began; after `anchor` and `detect`.
  Eigen::Matrix2f covariance = Eigen::Matrix2f::Identity();
  Eigen::Matrix2f template_covariance = Eigen::Matrix2f::Zero();  ///< the same of its look
  std::shared_ptr<const AnchoredPatch> anchor;      ///< its look where that was last taken
  Eigen::Matrix2f A = Eigen::Matrix2f::Identity();  ///< how that lies in the image, see Place
};

/// Corners (Shi & Tomasi 1994) followed by pyramidal Lucas-Kanade (Bouguet 2000) with a
/// forward-backward check (Kalal et al. 2010), at keyframes held by their first looks; new ones are
/// detected so that they cover the image evenly. Ids are never used twice.
class PointTracker {
 public:
  explicit PointTracker(const PointTrackerOptions& options);

  /// Follows all tracks into `image` (CV_8UC1, the size of the last); lost ones are dropped.
  /// `predicted_px` holds a starting point for each present track, or is empty. How far from there
  /// a point is sought: over all levels of the pyramid, or over the finest two at less than half
  /// the cost, some ten pixels wide; farther off, such a search may end at something alike.
  enum class Search { kWide, kNear };
  void track(const Image& image, const std::vector<Eigen::Vector2f>& predicted_px = {},
             Search search = Search::kWide);
  /// Detects new corners in the last image wherever tracks are missing; `mask` 0 = not here (may be
  /// empty).
  void detect(const Image& mask = {});
  /// Puts every track to where its first look (AnchoredPatch) is in the last image, so that it does
  /// not drift, and says how well it is known. A look that is not found there, or is too warped to
  /// be compared, is taken anew: what the track erred by until then, it goes on to err by.
  void anchor();
  /// Drops the tracks whose flag is false (one flag a track, in order).
  void keep(const std::vector<bool>& flags);
  /// Forgets tracks and images; ids go on counting.
  void reset();

  const std::vector<PointTrack>& tracks() const { return tracks_; }
  const Image& image() const { return image_; }

 private:
  std::vector<std::optional<Eigen::Vector2f>> follow(
      const std::vector<Image>& pyramid, const std::vector<Eigen::Vector2f>& predicted_px,
      Search search) const;
  void take_template(PointTrack& track) const;

  PointTrackerOptions options_;
  Eigen::Matrix2f least_ = Eigen::Matrix2f::Identity();  // covariance of a look that is found
  std::vector<PointTrack> tracks_;
  Image image_;
  std::vector<Image> pyramid_;
  LandmarkId next_id_;
};

}  // namespace placegraph
