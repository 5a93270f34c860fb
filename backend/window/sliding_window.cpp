#include <placegraph/backend/window/prior_gauge.h>
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/backend/window/window_marginalization.h>
#include <placegraph/backend/window/window_problem.h>
#include <placegraph/backend/window/window_transform.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <typeinfo>

namespace placegraph {
namespace {

bool positive(double x) { return std::isfinite(x) && x > 0; }

bool is_positive_definite(const Eigen::Matrix2d& m) {
  return m.allFinite() && std::abs(m(0, 1) - m(1, 0)) <= 1e-6 * m.trace() && m(0, 0) > 0 &&
         m.determinant() > 0;
}

/// Inserts an observation in the order of the keyframes; throws if its keyframe has one already.
template <class Observation>
void insert_observation(std::vector<Observation>& list, const Observation& o,
                        const std::string& name) {
  const auto at = std::lower_bound(
      list.begin(), list.end(), o.keyframe,
      [](const Observation& a, KeyframeId keyframe) { return a.keyframe < keyframe; });
  require(at == list.end() || at->keyframe != o.keyframe, name + " is there already");
  list.insert(at, o);
}

void require_sound(const LineObservation::SecondCamera& second, const std::string& name) {
  require(
      second.second_in_cam.allFinite() && second.second_in_cam.norm() > 0 &&
          second.start_px.allFinite() && second.end_px.allFinite() && positive(second.sigma_px),
      name + ": a second camera must be finite, at another position and have a positive sigma_px");
}

/// "sliding window: landmark 3"
template <class Key>
std::string name_of(const char* what, Key id) {
  using std::to_string;
  return std::string("sliding window: ") + what + " " + to_string(id);
}

template <class Map>
auto& find(Map& all, typename Map::key_type id, const char* what) {
  const auto it = all.find(id);
  require(it != all.end(), name_of(what, id) + " is not in the window");
  return it->second;
}

template <class Key, class T>
void insert(std::map<Key, T>& all, Key id, const T& value, const char* what) {
  require(all.try_emplace(id, value).second, name_of(what, id) + " is there already");
}

template <class Key, class T>
std::vector<Key> ids_of(const std::map<Key, T>& all) {
  std::vector<Key> ids;
  for (const auto& [id, value] : all) ids.push_back(id);
  return ids;
}

template <class Key, class T>
std::optional<T> value_if_there(const std::map<Key, T>& all, Key id) {
  const auto it = all.find(id);
  return it == all.end() ? std::nullopt : std::optional(it->second);
}

/// The name of an observation; throws ArgumentError unless its numbers are sound.
std::string checked_name(const WindowObservation& o) {
  std::string name =
      name_of("observation of landmark", o.landmark) + " in keyframe " + to_string(o.keyframe);
  require(o.px.allFinite() && positive(o.sigma_px),
          name + ": px must be finite and sigma_px positive");
  require(!o.covariance_px || is_positive_definite(*o.covariance_px),
          name + ": covariance_px must be finite and positive definite");
  require(!o.inverse_depth || (std::isfinite(*o.inverse_depth) && positive(o.sigma_inverse_depth)),
          name + ": inverse_depth must be finite and its sigma positive");
  return name;
}

}  // namespace

SlidingWindow::SlidingWindow(const SlidingWindowOptions& options, const Camera& camera)
    : state_(std::make_unique<WindowState>()) {
  options.check();
  camera.check();
  require(camera.distortion == Distortion::kNone, "sliding window: the camera must be undistorted");
  state_->options = options;
  state_->camera = camera;
}
SlidingWindow::~SlidingWindow() = default;
SlidingWindow::SlidingWindow(SlidingWindow&&) noexcept = default;
SlidingWindow& SlidingWindow::operator=(SlidingWindow&&) noexcept = default;

WindowState& SlidingWindow::change() {
  information_.reset();
  return *state_;
}

const WindowInformation& SlidingWindow::information() const {
  if (!information_) information_ = window_information(*state_);
  return *information_;
}

void SlidingWindow::add_keyframe(KeyframeId id, const SE3& T_map_cam,
                                 const std::optional<double>& stamp_s) {
  WindowState& state = change();
  require(state.keyframes.empty() || id > state.keyframes.rbegin()->first,
          name_of("keyframe", id) + " is not newer than the last one");
  require(T_map_cam.matrix().allFinite(), name_of("pose of keyframe", id) + " is not finite");
  require(std::isfinite(stamp_s.value_or(0)), name_of("stamp of keyframe", id) + " is not finite");
  if (state.keyframes.empty() && state.prior.empty()) state.fixed = id;
  state.keyframes.emplace(id, T_map_cam);
  if (stamp_s) state.stamps.emplace(id, *stamp_s);
}

void SlidingWindow::add_landmark(LandmarkId id, const Eigen::Vector3d& p_map) {
  require(p_map.allFinite(), name_of("landmark", id) + " is not finite");
  insert(change().landmarks, id, WindowLandmark{p_map, {}, {}}, "landmark");
}

void SlidingWindow::add_observation(const WindowObservation& o) {
  require_variable(*state_, keyframe_variable(o.keyframe));
  WindowLandmark& landmark = find(change().landmarks, o.landmark, "landmark");
  insert_observation(landmark.observations, o, checked_name(o));
}

void SlidingWindow::add_line(LineId id, const Line3& line_map) {
  require(line_map.coordinates().allFinite(), name_of("line", id) + " is not finite");
  insert(change().lines, id, WindowLine{line_map, {}}, "line");
}

void SlidingWindow::add_line_observation(const LineObservation& o) {
  require_variable(*state_, keyframe_variable(o.keyframe));
  WindowLine& line = find(change().lines, o.line, "line");
  const std::string name =
      name_of("observation of line", o.line) + " in keyframe " + to_string(o.keyframe);
  require(o.start_px.allFinite() && o.end_px.allFinite() && positive(o.sigma_px),
          name + ": its ends must be finite and sigma_px positive");
  if (o.second) require_sound(*o.second, name);
  insert_observation(line.observations, o, name);
}

void SlidingWindow::add_plane(PlaneId id, const Plane3& plane_map) {
  insert(change().planes, id, plane_map, "plane");
}

void SlidingWindow::add_plane_point(const PlanePoint& point) {
  require_variable(*state_, plane_variable(point.plane));
  WindowLandmark& landmark = find(change().landmarks, point.landmark, "landmark");
  require(positive(point.sigma_m), "sliding window: sigma_m must be finite and positive");
  require(!landmark.on_plane, name_of("landmark", point.landmark) + " is already on a plane");
  landmark.on_plane = point;
}

void SlidingWindow::add_manhattan_frame(ManhattanFrameId id, const SO3& R_map_manhattan) {
  require(R_map_manhattan.matrix().allFinite(), name_of("Manhattan frame", id) + " is not finite");
  insert(change().manhattan_frames, id, R_map_manhattan, "Manhattan frame");
}

void SlidingWindow::add(const WindowFactor& factor) {
  std::string name = "sliding window: measurement";
  for (std::size_t k = 0; k < factor.variables.size(); ++k)
    name += (k == 0 ? " of " : " and ") + to_string(factor.variables[k]);
  check(factor, name);
  for (const WindowVariable& variable : factor.variables) require_variable(*state_, variable);
  WindowState& state = change();
  // Factors are grouped by type, so that the order of measurements of different types does not
  // change the sums.
  const auto same_type = [&added = *factor.factor](const WindowFactor& other) {
    const Factor& before = *other.factor;
    return typeid(before) == typeid(added);
  };
  const auto last = std::find_if(state.factors.rbegin(), state.factors.rend(), same_type);
  state.factors.insert(last == state.factors.rend() ? state.factors.end() : last.base(), factor);
  if (state.fixed && is_full_pose_prior(state, factor) &&
      factor.variables[0] == keyframe_variable(*state.fixed))
    state.fixed.reset();
}

void SlidingWindow::remove_landmark(LandmarkId id) {
  find(state_->landmarks, id, "landmark");
  change().landmarks.erase(id);
}

void SlidingWindow::remove_observation(KeyframeId keyframe, LandmarkId landmark) {
  const std::size_t removed =
      std::erase_if(find(change().landmarks, landmark, "landmark").observations,
                    [&](const WindowObservation& o) { return o.keyframe == keyframe; });
  require(removed > 0,
          name_of("landmark", landmark) + " has no observation in keyframe " + to_string(keyframe));
}

void SlidingWindow::remove_line(LineId id) {
  find(state_->lines, id, "line");
  change().lines.erase(id);
}

void SlidingWindow::remove_plane(PlaneId id) {
  const WindowVariable plane = plane_variable(id);
  require_variable(*state_, plane);
  WindowState& state = change();
  std::erase_if(state.factors, [&](const WindowFactor& factor) { return touches(factor, plane); });
  for (auto& [landmark_id, landmark] : state.landmarks)
    if (landmark.on_plane && landmark.on_plane->plane == id) landmark.on_plane.reset();
  state.kept.erase(plane);
  state.planes.erase(id);
  const auto in_prior = std::find(state.prior.planes.begin(), state.prior.planes.end(), id);
  if (in_prior != state.prior.planes.end())
    forget_plane(state.prior, static_cast<std::size_t>(in_prior - state.prior.planes.begin()));
}

void SlidingWindow::remove(const WindowFactor& factor) {
  const std::shared_ptr<const Factor> which = factor.factor;  // `factor` may be one of the window's
  const std::size_t removed = std::erase_if(
      change().factors, [&](const WindowFactor& other) { return other.factor == which; });
  require(removed > 0, "sliding window: a measurement to be removed is not in the window");
}

void SlidingWindow::revise_inverse_depth(KeyframeId keyframe, LandmarkId landmark,
                                         double inverse_depth) {
  require(std::isfinite(inverse_depth), "sliding window: inverse_depth must be finite");
  for (WindowObservation& o : find(change().landmarks, landmark, "landmark").observations)
    if (o.keyframe == keyframe && o.inverse_depth) {
      o.inverse_depth = inverse_depth;
      return;
    }
  throw ArgumentError(name_of("landmark", landmark) + " has no inverse depth in keyframe " +
                      to_string(keyframe));
}

void SlidingWindow::revise(const WindowObservation& observation) {
  const std::string name = checked_name(observation);
  for (WindowObservation& o :
       find(change().landmarks, observation.landmark, "landmark").observations)
    if (o.keyframe == observation.keyframe) {
      o = observation;
      return;
    }
  throw ArgumentError(name + " is not in the window");
}

void SlidingWindow::revise_second_camera(KeyframeId keyframe, LineId line,
                                         const LineObservation::SecondCamera& second) {
  const std::string in_keyframe = " in keyframe " + to_string(keyframe);
  require_sound(second, name_of("line", line) + in_keyframe);
  for (LineObservation& o : find(change().lines, line, "line").observations)
    if (o.keyframe == keyframe && o.second) {
      o.second = second;
      return;
    }
  throw ArgumentError(name_of("line", line) + " has no second camera" + in_keyframe);
}

void SlidingWindow::keep(const WindowVariable& variable, bool kept) {
  require_variable(*state_, variable);
  if (kept)
    change().kept.insert(variable);
  else
    change().kept.erase(variable);
}

void SlidingWindow::hold_manhattan_frame(std::optional<ManhattanFrameId> id) {
  if (id) require_variable(*state_, manhattan_variable(*id));
  change().held_manhattan_frame = id;
}

WindowSummary SlidingWindow::optimize() { return optimize_window(change()); }

std::vector<KeyframeId> SlidingWindow::marginalize() { return marginalize_window(change()); }

void SlidingWindow::rescale(double scale) {
  require(!has_metric_observation(*state_) && !state_->prior_is_metric,
          "sliding window: the scale cannot be set because it is already measured");
  rescale_window(change(), scale);
}

std::vector<KeyframeId> SlidingWindow::keyframes() const { return ids_of(state_->keyframes); }
std::vector<LandmarkId> SlidingWindow::landmarks() const { return ids_of(state_->landmarks); }
std::vector<LineId> SlidingWindow::lines() const { return ids_of(state_->lines); }
std::vector<PlaneId> SlidingWindow::planes() const { return ids_of(state_->planes); }
std::vector<ManhattanFrameId> SlidingWindow::manhattan_frames() const {
  return ids_of(state_->manhattan_frames);
}

SE3 SlidingWindow::pose(KeyframeId keyframe) const {
  return find(state_->keyframes, keyframe, "keyframe");
}

std::optional<Eigen::Vector3d> SlidingWindow::landmark(LandmarkId id) const {
  const auto it = state_->landmarks.find(id);
  if (it == state_->landmarks.end()) return std::nullopt;
  return it->second.p_map;
}

std::optional<Line3> SlidingWindow::line(LineId id) const {
  const auto it = state_->lines.find(id);
  if (it == state_->lines.end()) return std::nullopt;
  return it->second.line_map;
}

std::optional<Plane3> SlidingWindow::plane(PlaneId id) const {
  return value_if_there(state_->planes, id);
}

std::optional<SO3> SlidingWindow::manhattan_frame(ManhattanFrameId id) const {
  return value_if_there(state_->manhattan_frames, id);
}

const std::vector<WindowObservation>& SlidingWindow::observations(LandmarkId landmark) const {
  return find(state_->landmarks, landmark, "landmark").observations;
}

const std::vector<LineObservation>& SlidingWindow::line_observations(LineId line) const {
  return find(state_->lines, line, "line").observations;
}

const std::vector<WindowFactor>& SlidingWindow::factors() const { return state_->factors; }

}  // namespace placegraph
