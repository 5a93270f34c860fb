#include <placegraph/graph/core/error.h>
#include <placegraph/graph/geometry/bounded_covariance.h>
#include <placegraph/pipeline/places/keyframe_chain.h>
#include <placegraph/pipeline/places/rescaling.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace placegraph {
namespace {

bool is_odometry(const std::optional<KeyframeLink>& link) {
  return link && link->source == ConstraintSource::kOdometry;
}

Matrix7d covariance_of_link(const KeyframeLink& link) {
  Matrix7d covariance = Matrix7d::Zero();
  covariance.topLeftCorner<6, 6>() = bounded_covariance(link.information);
  covariance(6, 6) = link.sigma_log_scale * link.sigma_log_scale;
  return covariance;
}

KeyframeChain::Keyframe chained(const std::optional<KeyframeLink>& link, int track_segment) {
  const Matrix7d covariance = link ? covariance_of_link(*link) : Matrix7d(Matrix7d::Zero());
  return {link, covariance, track_segment, SE3(), 0};
}

}  // namespace

KeyframeChain::KeyframeChain(const std::vector<PlaceHistory::Keyframe>& keyframes,
                             std::vector<bool> scale_known)
    : scale_known_(std::move(scale_known)) {
  for (const auto& [id, segment, track_segment, link] : keyframes) {
    require(track_segment >= 0 && track_segment < static_cast<int>(scale_known_.size()),
            "KeyframeChain: keyframe " + to_string(id) + " is in an unknown track segment");
    insert(id, link, track_segment);
  }
  chain_up(kBeforeAll);
}

void KeyframeChain::add(KeyframeId id, const std::optional<KeyframeLink>& link, bool scale_known) {
  const bool begins_track_segment = !is_odometry(link) || !contains(link->from);
  insert(
      id, link,
      begins_track_segment ? static_cast<int>(scale_known_.size()) : at(link->from).track_segment);
  if (begins_track_segment) scale_known_.push_back(scale_known);
  chain_up(id);
}

void KeyframeChain::insert(KeyframeId id, const std::optional<KeyframeLink>& link,
                           int track_segment) {
  const std::string subject = "KeyframeChain: keyframe " + to_string(id);
  require(!contains(id), subject + " already exists");
  require(!link || (link->from < id && contains(link->from)),
          subject + " is not linked to an earlier one");
  require(!is_odometry(link) || at(link->from).track_segment == track_segment,
          subject + " is linked by odometry to another track segment");
  keyframes_[id] = chained(link, track_segment);
}

/// Updates poses and path lengths from keyframe `first` on.
void KeyframeChain::chain_up(KeyframeId first) {
  for (auto at = keyframes_.lower_bound(first); at != keyframes_.end(); ++at) {
    auto& [id, keyframe] = *at;
    if (!is_odometry(keyframe.link)) continue;
    const Keyframe& from = keyframes_.at(keyframe.link->from);
    const SE3& T_from_this = keyframe.link->T_from_this;
    keyframe.T_track_keyframe = from.T_track_keyframe * T_from_this;
    keyframe.path_length = from.path_length + T_from_this.translation().norm();
  }
}

void KeyframeChain::update_link(KeyframeId id, const SE3& T_from_this) {
  auto& link = keyframes_.at(id).link;
  require(link.has_value(),
          "KeyframeChain::update_link: keyframe " + to_string(id) + " has no link");
  link->T_from_this = T_from_this;
  chain_up(id);
}

void KeyframeChain::correct_links(const std::map<KeyframeId, Vector6d>& corrections) {
  for (const auto& [id, correction] : corrections) {
    auto& link = keyframes_.at(id).link;
    require(link.has_value(),
            "KeyframeChain::correct_links: keyframe " + to_string(id) + " has no link");
    link->T_from_this = link->T_from_this * SE3::exp(correction);
  }
  if (!corrections.empty()) chain_up(corrections.begin()->first);
}

void KeyframeChain::inform_link(KeyframeId id, const Matrix6d& information,
                                double sigma_log_scale) {
  Keyframe& keyframe = keyframes_.at(id);
  require(keyframe.link.has_value(),
          "KeyframeChain::inform_link: keyframe " + to_string(id) + " has no link");
  keyframe.link->information = information;
  keyframe.link->sigma_log_scale = sigma_log_scale;
  keyframe.link_covariance = covariance_of_link(*keyframe.link);
}

void KeyframeChain::rescale(KeyframeId first, double factor) {
  const int track_segment = at(first).track_segment;
  scale_known_[track_segment] = true;
  for (auto& [id, keyframe] : keyframes_) {
    if (!keyframe.link) continue;
    KeyframeLink& link = *keyframe.link;
    const bool begins = at(link.from).track_segment == track_segment,
               ends = keyframe.track_segment == track_segment;
    if (begins) link.T_from_this = link.T_from_this.scaled(factor);
    if (ends) link.information = rescaled_information<6>(link.information, factor);
    if (link.source != ConstraintSource::kOdometry)
      link.scale *= (begins ? factor : 1) / (ends ? factor : 1);
    else if (ends)
      link.sigma_log_scale = 0;
    keyframe.link_covariance = covariance_of_link(link);
  }
  chain_up(kBeforeAll);
}

bool KeyframeChain::has_odometry(KeyframeId id) const { return is_odometry(at(id).link); }

SE3 KeyframeChain::T_a_b(KeyframeId a, KeyframeId b) const {
  return at(a).T_track_keyframe.inverse() * at(b).T_track_keyframe;
}

std::optional<TrackedMotion> KeyframeChain::odometry(KeyframeId a, KeyframeId b) const {
  const auto from = keyframes_.find(a), to = keyframes_.find(b);
  if (from == keyframes_.end() || to == keyframes_.end() ||
      from->second.track_segment != to->second.track_segment)
    return std::nullopt;
  return TrackedMotion{T_a_b(a, b), std::abs(to->second.path_length - from->second.path_length)};
}

bool KeyframeChain::all_scales_known() const {
  return std::all_of(scale_known_.begin(), scale_known_.end(), [](bool known) { return known; });
}

}  // namespace placegraph
