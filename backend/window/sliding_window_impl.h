#pragma once
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/backend/window/window_information.h>
#include <placegraph/backend/window/window_state.h>
#include <placegraph/graph/core/error.h>

#include <cmath>
#include <string>

namespace placegraph {

/// What a sliding window knows, and what follows from it until it changes.
struct SlidingWindow::Impl {
  /// Nothing but the prior leads back to the keyframe that set the map's frame; once another has to
  /// be held instead, what is known is known from there only.
  bool tied_to_map = true;

  const WindowState& state() const { return state_; }
  /// What follows from the state is forgotten.
  WindowState& change() {
    information_.reset();
    return state_;
  }
  const WindowInformation& information() const {
    if (!information_) information_ = window_information(state_);
    return *information_;
  }

  const SE3& keyframe(std::int64_t id) const { return find(state_.keyframes, id, "keyframe"); }
  const WindowLandmark& landmark(std::int64_t id) const {
    return find(state_.landmarks, id, "landmark");
  }
  const WindowLine& line(std::int64_t id) const { return find(state_.lines, id, "line"); }
  const SO3& world(std::int64_t id) const { return find(state_.worlds, id, "world"); }
  void require_plane(std::int64_t id) const { find(state_.planes, id, "plane"); }

 private:
  template <class T>
  static const T& find(const std::map<std::int64_t, T>& all, std::int64_t id, const char* what) {
    const auto it = all.find(id);
    require(it != all.end(), std::string("sliding window: ") + what + " " + std::to_string(id) +
                                 " is not in the window");
    return it->second;
  }

  WindowState state_;
  mutable std::optional<WindowInformation> information_;
};

inline bool positive(double x) { return std::isfinite(x) && x > 0; }

template <class T>
std::vector<std::int64_t> ids_of(const std::map<std::int64_t, T>& all) {
  std::vector<std::int64_t> ids;
  for (const auto& [id, value] : all) ids.push_back(id);
  return ids;
}

}  // namespace placegraph
