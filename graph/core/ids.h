#pragma once
#include <placegraph/graph/core/id.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A frame: its position in the sequence or folder of images that it was read from.
using FrameId = Id<struct FrameTag>;

/// A keyframe. Keyframes are numbered in the order of their frames, over all components of a map.
/// A segment of a place is identified by its first keyframe, the anchor keyframe.
using KeyframeId = Id<struct KeyframeTag>;

/// A topological place: a node of the place graph.
using PlaceId = Id<struct PlaceTag>;

/// A point of the scene. The track of its observations in the images has the same id.
using LandmarkId = Id<struct LandmarkTag>;

/// A straight line of the scene. The track of its edges in the images has the same id.
using LineId = Id<struct LineTag>;

/// A plane of the scene.
using PlaneId = Id<struct PlaneTag>;

/// A Manhattan frame: three orthogonal directions that many edges of the scene are parallel to.
using ManhattanFrameId = Id<struct ManhattanFrameTag>;

/// A vertex of a pose graph: a pose or a point landmark. Ids may be any integers.
using NodeId = Id<struct NodeTag>;

}  // namespace placegraph
