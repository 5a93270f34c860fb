#pragma once
#include <placegraph/graph/core/id.h>

namespace placegraph {

/// A frame: its position in the sequence or folder of images that it was read from.
using FrameId = Id<struct FrameTag>;

/// A keyframe. They are numbered in the order of their frames, over all components of a map. The
/// first keyframe of a part of a place, its anchor, names the part.
using KeyframeId = Id<struct KeyframeTag>;

/// A topological place: a node of the place graph.
using PlaceId = Id<struct PlaceTag>;

/// A point of the scene. The track of image points that it is seen by has the same id.
using LandmarkId = Id<struct LandmarkTag>;

}  // namespace placegraph
