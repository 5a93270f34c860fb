#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/places/place_mapper.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Information of the same motion when its unit of length shrinks by `factor`; covariance when it
/// grows.
template <int N>
Eigen::Matrix<double, N, N> scaled(Eigen::Matrix<double, N, N> information, double factor) {
  information.template topRows<3>() /= factor;
  information.template leftCols<3>() /= factor;
  return information;
}

}  // namespace

void PlaceOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PlaceOptions& o) {
  field("max_distance", o.max_distance,
        "of a keyframe from its place's anchor, as a share of the median depth", {0, 100});
  field("max_angle_deg", o.max_angle_deg, "between a keyframe and its place's anchor", {0, 180});
  field.choice("loop_kernel", o.loop_kernel.kind, robust_kernel_names(), "robust kernel of loops");
  field("loop_kernel_width", o.loop_kernel.width, "its width in standard deviations", {0.01, 1000});
  field.choice("motion_kernel", o.motion_kernel.kind, robust_kernel_names(),
               "robust kernel of motion that other sensors measured");
  field("motion_kernel_width", o.motion_kernel.width, "its width in standard deviations",
        {0.01, 1000});
  field("merge", o.merge, "places that a loop shows to be one become one");
  field("merge_sigma", o.merge_sigma,
        "standard deviation of their distance, share of the reach, above which they do not",
        {0, 100});
}

PlaceMapper::PlaceMapper(const PlaceOptions& options, const IncrementalOptions& optimizer)
    : options_(options), optimizer_(optimizer) {
  options_.check();
}

SE3 PlaceMapper::T_part_keyframe(const Node& node) const {
  return nodes_.at(node.part).T_run_keyframe.inverse() * node.T_run_keyframe;
}

Sim3 PlaceMapper::S_place_keyframe(const Node& node) const {
  return parts_.at(node.part).S_place_part * Sim3(T_part_keyframe(node));
}

const PlaceMapper::PlaceState& PlaceMapper::place_at(std::int64_t keyframe) const {
  return places_.at(place_of(keyframe));
}

PlaceMapper::PlaceState& PlaceMapper::place_at(std::int64_t keyframe) {
  return places_.at(place_of(keyframe));
}

Sim3 PlaceMapper::S_map_keyframe(std::int64_t id) const {
  return place_at(id).S_map_place * S_place_keyframe(nodes_.at(id));
}

SE3 PlaceMapper::T_map_keyframe(std::int64_t id) const {
  const Sim3 S_map_keyframe = this->S_map_keyframe(id);
  return SE3(S_map_keyframe.rotation(), S_map_keyframe.translation());
}

std::int64_t PlaceMapper::place_of(std::int64_t keyframe) const {
  return parts_.at(nodes_.at(keyframe).part).place;
}

int PlaceMapper::component_of(std::int64_t keyframe) const { return place_at(keyframe).component; }

bool PlaceMapper::free_units() const {
  return !std::all_of(scale_known_.begin(), scale_known_.end(), [](bool known) { return known; });
}

bool PlaceMapper::units_differ(std::int64_t a, std::int64_t b) const {
  return !scale_known_[nodes_.at(a).run] || !scale_known_[nodes_.at(b).run];
}

bool PlaceMapper::metric() const {
  return std::any_of(nodes_.begin(), nodes_.end(), [&](const auto& entry) {
    return scale_known_[entry.second.run] &&
           places_.at(parts_.at(entry.second.part).place).component == 0;
  });
}

std::optional<TrackedMotion> PlaceMapper::odometry(std::int64_t from, std::int64_t to) const {
  const auto a = nodes_.find(from), b = nodes_.find(to);
  if (a == nodes_.end() || b == nodes_.end() || a->second.run != b->second.run) return std::nullopt;
  return TrackedMotion{a->second.T_run_keyframe.inverse() * b->second.T_run_keyframe,
                       std::abs(b->second.way - a->second.way)};
}

void PlaceMapper::add_keyframe(std::int64_t id, const std::optional<Link>& link,
                               const SE3& T_map_guess, double median_depth_m, bool scale_known) {
  require(!nodes_.count(id), "PlaceMapper: keyframe id used twice");
  changed(id);
  Node node{id, link, link ? covariance_of(*link) : Matrix7d(Matrix7d::Zero()), SE3(), 0, 0};
  if (link && link->source == ConstraintSource::kOdometry) {
    const Node& previous = nodes_.at(link->from);
    node.run = previous.run;
    node.T_run_keyframe = previous.T_run_keyframe * link->T_from_this;
    node.way = previous.way + link->T_from_this.translation().norm();
    node.part = previous.part;
    const Sim3 S_place_this = S_place_keyframe(node);
    if (S_place_this.translation().norm() <
            options_.max_distance * median_depth_m * S_place_this.scale() &&
        S_place_this.rotation().log().norm() < deg_to_rad(options_.max_angle_deg) &&
        same_known_ground(node, S_place_this)) {
      nodes_[id] = node;
      place_at(id).last_keyframe = id;
      return;
    }
    node.part = id;
  } else {
    node.run = static_cast<int>(scale_known_.size());
    scale_known_.push_back(scale_known);
  }
  PlaceState place{id, Sim3(T_map_guess), 0, options_.max_distance * median_depth_m, id};
  if (link) {
    const Sim3 S_from_this(link->T_from_this.rotation(), link->T_from_this.translation(),
                           link->scale);
    place.S_map_place = S_map_keyframe(link->from) * S_from_this;
    place.component = component_of(link->from);
  } else {
    for (const auto& [number, other] : places_)
      place.component = std::max(place.component, other.component + 1);
  }
  const std::int64_t number = founded_++;
  nodes_[id] = node;
  parts_[id] = {number, Sim3()};
  places_[number] = place;
}

void PlaceMapper::follow_links(std::int64_t first) {
  changed(first);
  for (auto node = nodes_.lower_bound(first); node != nodes_.end(); ++node) {
    const auto& link = node->second.link;
    if (!link || link->source != ConstraintSource::kOdometry) continue;
    const Node& from = nodes_.at(link->from);
    node->second.T_run_keyframe = from.T_run_keyframe * link->T_from_this;
    node->second.way = from.way + link->T_from_this.translation().norm();
  }
}

void PlaceMapper::update_link(std::int64_t id, const SE3& T_from_this) {
  Node& node = nodes_.at(id);
  require(node.link.has_value(), "PlaceMapper::update_link: the keyframe has no link");
  // What moved is the newest part of the track, so an anchor follows its predecessor, unless its
  // place is an older one that it was merged into.
  node.link->T_from_this = T_from_this;
  follow_links(id);
  PlaceState& place = places_.at(place_of(id));
  if (place.anchor_keyframe == id)
    place.S_map_place = S_map_keyframe(node.link->from) * Sim3(T_from_this);
}

void PlaceMapper::inform_link(std::int64_t id, const Matrix6d& information,
                              double sigma_log_scale) {
  Node& node = nodes_.at(id);
  require(node.link.has_value(), "PlaceMapper::inform_link: the keyframe has no link");
  node.link->information = information;
  node.link->sigma_log_scale = sigma_log_scale;
  node.covariance = covariance_of(*node.link);
  changed(id);
}

std::optional<std::int64_t> PlaceMapper::previous_anchor(std::int64_t anchor) const {
  const auto node = nodes_.find(anchor);
  if (node == nodes_.end() || node->second.part != anchor || !node->second.link ||
      node->second.link->source != ConstraintSource::kOdometry)
    return std::nullopt;
  return nodes_.at(node->second.link->from).part;
}

void PlaceMapper::add_motion(std::int64_t previous, std::int64_t anchor,
                             const SE3& T_previous_anchor, const Matrix6d& covariance) {
  require(parts_.count(previous) && parts_.count(anchor) && previous != anchor,
          "PlaceMapper::add_motion: two anchors needed");
  changed(anchor);
  Edge edge{{PlaceConstraint::Kind::kMotion, static_cast<std::int64_t>(motions_.size())},
            previous,
            anchor,
            Sim3(T_previous_anchor),
            Matrix7d::Zero(),
            ConstraintSource::kOther,
            options_.motion_kernel};
  edge.covariance.topLeftCorner<6, 6>() = covariance;
  motions_.push_back(edge);
}

void PlaceMapper::add_loop(const Loop& loop) {
  loops_.push_back(loop);
  changed(std::max(loop.match, loop.query));
}

void PlaceMapper::rescale(std::int64_t first, double factor) {
  const int run = nodes_.at(first).run;
  const int component = component_of(first);
  scale_known_[run] = true;
  const auto in_run = [&](std::int64_t keyframe) { return nodes_.at(keyframe).run == run; };
  const Eigen::Vector3d centre = T_map_keyframe(first).translation();
  bool alone = true;
  for (const auto& [id, node] : nodes_) alone &= node.run == run || component_of(id) != component;
  for (auto& [id, node] : nodes_) {
    if (!node.link) continue;
    Link& link = *node.link;
    const bool odometry = link.source == ConstraintSource::kOdometry;
    if (in_run(link.from)) link.T_from_this = link.T_from_this.scaled(factor);
    if (in_run(id)) link.information = scaled<6>(link.information, factor);
    if (odometry && in_run(id)) link.sigma_log_scale = 0;
    if (!odometry) link.scale *= (in_run(link.from) ? factor : 1) / (in_run(id) ? factor : 1);
    node.covariance = covariance_of(link);
  }
  for (Loop& loop : loops_) {
    if (in_run(loop.match)) {
      loop.T_match_query = loop.T_match_query.scaled(factor);
      loop.scale_match_query *= factor;
    }
    if (in_run(loop.query)) {
      loop.information = scaled<7>(loop.information, factor);
      loop.scale_match_query /= factor;
    }
  }
  for (auto& [anchor, part] : parts_) {
    const Sim3& S = part.S_place_part;
    const bool place_grows = in_run(places_.at(part.place).anchor_keyframe);
    if (in_run(anchor)) part.covariance = scaled<7>(part.covariance, 1 / factor);
    if (in_run(anchor) && part.motion_covariance)
      part.motion_covariance = scaled<6>(*part.motion_covariance, 1 / factor);
    part.S_place_part =
        Sim3(S.rotation(), (place_grows ? factor : 1) * S.translation(),
             S.scale() * (place_grows ? factor : 1) / (in_run(anchor) ? factor : 1));
  }
  for (Merged& merged : merged_)
    for (auto& [anchor, covariance] : merged.covariance_of_part)
      if (in_run(anchor)) covariance = scaled<7>(covariance, 1 / factor);
  for (auto& [number, place] : places_) {
    if (!in_run(place.anchor_keyframe)) continue;
    place.reach *= factor;
    Sim3& S = place.S_map_place;
    S = alone ? Sim3(S.rotation(), centre + factor * (S.translation() - centre), S.scale())
              : Sim3(S.rotation(), S.translation(), S.scale() / factor);
  }
  follow_links(first);
  untold_since_ = kFirst;
  begin_anew_ = true;
}

std::vector<Place> PlaceMapper::places() const {
  std::vector<Place> places;
  std::map<std::int64_t, std::size_t> index;
  for (const auto& [number, state] : places_) {
    index[number] = places.size();
    Place place;
    place.id = number;
    place.anchor_keyframe = state.anchor_keyframe;
    place.T_map_place = SE3(state.S_map_place.rotation(), state.S_map_place.translation());
    place.scale = state.S_map_place.scale();
    place.component = state.component;
    places.push_back(std::move(place));
  }
  // An anchor is older than all that came to its place later.
  for (const auto& [id, node] : nodes_) {
    const Sim3 S = S_place_keyframe(node);
    places[index.at(place_of(id))].members.push_back(
        {id, SE3(S.rotation(), S.translation()), S.scale()});
  }
  return places;
}

PlaceGraph PlaceMapper::place_graph() const {
  PlaceGraph graph;
  graph.places = places();
  for (const PlaceConstraint& constraint : constraints(0))
    if (constraint.measured) graph.constraints.push_back(*constraint.measured);
  return graph;
}

}  // namespace placegraph
