#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/place_mapper.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Inverse of a positive semi-definite matrix; eigenvalues below `floor` or 1e-12 of the largest
/// count as that much.
Matrix6d inverse_of(const Matrix6d& matrix, double floor) {
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(0.5 * (matrix + matrix.transpose()));
  const double least = std::max(floor, 1e-12 * eigen.eigenvalues()[5]);
  const Vector6d inverse = eigen.eigenvalues().cwiseMax(least).cwiseInverse();
  return eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
}

/// Unknown directions get a large, finite variance.
Matrix6d covariance_of(const Matrix6d& information) { return inverse_of(information, 1e-6); }

Matrix6d information_of(const Matrix6d& covariance) { return inverse_of(covariance, 1e-18); }

SE3 scaled(const SE3& T, double factor) { return SE3(T.rotation(), factor * T.translation()); }

/// Information of the same motion when its unit of length shrinks by `factor`.
Matrix6d scaled(const Matrix6d& information, double factor) {
  Vector6d inverse;
  inverse << Eigen::Vector3d::Constant(1 / factor), Eigen::Vector3d::Ones();
  return inverse.asDiagonal() * information * inverse.asDiagonal();
}

}  // namespace

void PlaceOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PlaceOptions& o) {
  field("max_distance", o.max_distance,
        "of a keyframe from its place's anchor, as a share of the median depth", {0, 100});
  field("max_angle_deg", o.max_angle_deg, "between a keyframe and its place's anchor", {0, 180});
  field.choice("loop_kernel", o.loop_kernel.kind, robust_kernel_names(), "robust kernel of loops");
  field("loop_kernel_width", o.loop_kernel.width, "its width in standard deviations", {0.01, 1000});
}

PlaceMapper::PlaceMapper(const PlaceOptions& options) : options_(options) { options_.check(); }

SE3 PlaceMapper::T_place_keyframe(std::int64_t id) const {
  const Node& node = nodes_.at(id);
  const Node& anchor = nodes_.at(places_[node.place].anchor_keyframe);
  return anchor.T_run_keyframe.inverse() * node.T_run_keyframe;
}

SE3 PlaceMapper::T_map_keyframe(std::int64_t id) const {
  return places_[nodes_.at(id).place].T_map_place * T_place_keyframe(id);
}

std::int64_t PlaceMapper::place_of(std::int64_t keyframe) const {
  return nodes_.at(keyframe).place;
}

int PlaceMapper::component_of(std::int64_t keyframe) const {
  return places_[nodes_.at(keyframe).place].component;
}

std::optional<TrackedMotion> PlaceMapper::odometry(std::int64_t from, std::int64_t to) const {
  const auto a = nodes_.find(from), b = nodes_.find(to);
  if (a == nodes_.end() || b == nodes_.end() || a->second.run != b->second.run) return std::nullopt;
  return TrackedMotion{a->second.T_run_keyframe.inverse() * b->second.T_run_keyframe,
                       std::abs(b->second.way - a->second.way)};
}

void PlaceMapper::add_keyframe(std::int64_t id, const std::optional<Link>& link,
                               const SE3& T_map_guess, double median_depth_m) {
  require(!nodes_.count(id), "PlaceMapper: keyframe id used twice");
  Node node{0, link, SE3(), 0, 0};
  const bool same_run = link && link->source == ConstraintSource::kOdometry;
  if (same_run) {
    const Node& previous = nodes_.at(link->from);
    node.run = previous.run;
    node.T_run_keyframe = previous.T_run_keyframe * link->T_from_this;
    node.way = previous.way + link->T_from_this.translation().norm();
    const Place& place = places_[previous.place];
    const SE3 T_anchor_this =
        nodes_.at(place.anchor_keyframe).T_run_keyframe.inverse() * node.T_run_keyframe;
    if (T_anchor_this.translation().norm() < options_.max_distance * median_depth_m &&
        T_anchor_this.rotation().log().norm() < options_.max_angle_deg * M_PI / 180) {
      node.place = previous.place;
      nodes_[id] = node;
      places_[node.place].members.push_back({id, T_anchor_this});
      return;
    }
  } else {
    node.run = runs_++;
  }
  Place place;
  place.id = static_cast<std::int64_t>(places_.size());
  place.anchor_keyframe = id;
  place.members.push_back({id, SE3()});
  if (link) {
    place.T_map_place = T_map_keyframe(link->from) * link->T_from_this;
    place.component = component_of(link->from);
  } else {
    place.T_map_place = T_map_guess;
    for (const Place& other : places_)
      place.component = std::max(place.component, other.component + 1);
  }
  node.place = place.id;
  nodes_[id] = node;
  places_.push_back(std::move(place));
}

void PlaceMapper::follow_links(std::int64_t first) {
  for (auto node = nodes_.lower_bound(first); node != nodes_.end(); ++node) {
    const auto& link = node->second.link;
    if (!link || link->source != ConstraintSource::kOdometry) continue;
    const Node& from = nodes_.at(link->from);
    node->second.T_run_keyframe = from.T_run_keyframe * link->T_from_this;
    node->second.way = from.way + link->T_from_this.translation().norm();
  }
}

void PlaceMapper::update_link(std::int64_t id, const SE3& T_from_this,
                              const std::optional<Matrix6d>& information) {
  Node& node = nodes_.at(id);
  require(node.link.has_value(), "PlaceMapper::update_link: the keyframe has no link");
  // The place keeps its pose if the keyframe is its anchor's successor or a member: what moved is
  // the newest part of the track, so anchors follow their predecessor.
  node.link->T_from_this = T_from_this;
  if (information) node.link->information = *information;
  const std::int64_t from_place = nodes_.at(node.link->from).place;
  follow_links(id);
  if (places_[node.place].anchor_keyframe == id && from_place != node.place)
    places_[node.place].T_map_place = T_map_keyframe(node.link->from) * T_from_this;
}

void PlaceMapper::add_loop(std::int64_t query, std::int64_t match, const SE3& T_match_query,
                           const Matrix6d& information) {
  loops_.push_back({query, match, T_match_query, information});
}

void PlaceMapper::rescale(std::int64_t first, double factor) {
  const Eigen::Vector3d centre = T_map_keyframe(first).translation();
  const int run = nodes_.at(first).run;
  for (auto& [id, node] : nodes_) {
    if (node.run != run || !node.link || id <= first) continue;
    node.link->T_from_this = scaled(node.link->T_from_this, factor);
    node.link->information = scaled(node.link->information, factor);
  }
  for (LoopEdge& loop : loops_) {
    if (nodes_.at(loop.query).run != run || nodes_.at(loop.match).run != run) continue;
    loop.T_match_query = scaled(loop.T_match_query, factor);
    loop.information = scaled(loop.information, factor);
  }
  for (auto& place : places_)
    if (nodes_.at(place.anchor_keyframe).run == run)
      place.T_map_place = SE3(place.T_map_place.rotation(),
                              centre + factor * (place.T_map_place.translation() - centre));
  follow_links(first);
}

std::vector<RelativePoseConstraint> PlaceMapper::constraints() const {
  std::vector<RelativePoseConstraint> result;
  const auto add = [&](std::int64_t from, std::int64_t to, const SE3& T_from_to,
                       const Matrix6d& information, ConstraintSource source) {
    RelativePoseConstraint constraint;
    constraint.from = from;
    constraint.to = to;
    constraint.T_from_to = T_from_to;
    constraint.information = 0.5 * (information + information.transpose());
    constraint.source = source;
    if (source != ConstraintSource::kOdometry) constraint.kernel = options_.loop_kernel;
    result.push_back(std::move(constraint));
  };
  // Along a run of tracking: covariances of the links add up between anchors.
  Matrix6d covariance = Matrix6d::Zero();
  for (const auto& [id, node] : nodes_) {
    if (!node.link) {
      covariance.setZero();
      continue;
    }
    const Node& from = nodes_.at(node.link->from);
    const Place& place = places_[node.place];
    if (node.link->source != ConstraintSource::kOdometry) {
      const SE3 T_from_to = T_place_keyframe(node.link->from) * node.link->T_from_this;
      add(from.place, node.place, T_from_to, node.link->information, node.link->source);
      covariance.setZero();
      continue;
    }
    const SE3& T_from_this = node.link->T_from_this;
    const Matrix6d adjoint = T_from_this.inverse().adjoint();
    covariance = adjoint * covariance * adjoint.transpose() + covariance_of(node.link->information);
    if (place.anchor_keyframe != id) continue;
    const SE3 T_anchor_anchor =
        nodes_.at(places_[from.place].anchor_keyframe).T_run_keyframe.inverse() *
        node.T_run_keyframe;
    add(from.place, node.place, T_anchor_anchor, information_of(covariance),
        ConstraintSource::kOdometry);
    covariance.setZero();
  }
  for (const LoopEdge& loop : loops_) {
    const std::int64_t from = place_of(loop.match), to = place_of(loop.query);
    if (from == to) continue;
    const SE3 T_query_anchor = T_place_keyframe(loop.query).inverse();
    const SE3 T_from_to = T_place_keyframe(loop.match) * loop.T_match_query * T_query_anchor;
    // Information of T_match_query, carried to the anchor's tangent.
    const Matrix6d adjoint = T_query_anchor.adjoint();
    add(from, to, T_from_to, adjoint.transpose() * loop.information * adjoint,
        ConstraintSource::kLoop);
  }
  return result;
}

void PlaceMapper::bring_together() {
  for (const LoopEdge& loop : loops_) {
    const int a = component_of(loop.match), b = component_of(loop.query);
    if (a == b) continue;
    // The younger component moves onto the older one.
    const bool query_moves = b > a;
    const SE3 T_map_new = query_moves ? T_map_keyframe(loop.match) * loop.T_match_query
                                      : T_map_keyframe(loop.query) * loop.T_match_query.inverse();
    const SE3 T_map_old = T_map_keyframe(query_moves ? loop.query : loop.match);
    const SE3 T_new_old = T_map_new * T_map_old.inverse();
    const int moving = std::max(a, b), staying = std::min(a, b);
    for (Place& place : places_)
      if (place.component == moving) {
        place.T_map_place = T_new_old * place.T_map_place;
        place.component = staying;
      }
  }
}

PoseGraphReport PlaceMapper::optimize(const PoseGraphOptions& options, const LogSink& log) {
  bring_together();
  PlaceGraph graph = place_graph();
  PoseGraphReport report = optimize_pose_graph(graph.pose_graph(), options, log);
  // Out of iterations is no reason to throw away what they gained.
  if (report.outcome || (report.outcome.code == Outcome::Code::kNotConverged &&
                         report.chi2_final < report.chi2_initial)) {
    report.outcome = Outcome::ok();
    graph.set_poses(report.graph);
    for (std::size_t i = 0; i < places_.size(); ++i)
      places_[i].T_map_place = graph.places[i].T_map_place;
  }
  return report;
}

PlaceGraph PlaceMapper::place_graph() const {
  PlaceGraph graph;
  graph.places = places_;
  for (Place& place : graph.places)
    for (PlaceMember& member : place.members)
      member.T_place_keyframe = T_place_keyframe(member.keyframe);
  graph.constraints = constraints();
  return graph;
}

}  // namespace placegraph
