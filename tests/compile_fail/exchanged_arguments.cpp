// The arguments of a function of the library, exchanged.
#include <placegraph/backend/window/sliding_window.h>

namespace placegraph {
void wrong(SlidingWindow& window, KeyframeId keyframe, LandmarkId landmark) {
  window.remove_observation(landmark, keyframe);
}
}  // namespace placegraph
