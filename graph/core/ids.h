#pragma once
#include <placegraph/graph/core/id.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A frame: its position in the sequence or folder of images that it was read from.
using FrameId = Id<struct FrameTag>;

/// A keyframe. They are numbered in the order of their frames, over all components of a map. The
/// first keyframe of a part of a place, its anchor, names the part.
using KeyframeId = Id<struct KeyframeTag>;

/// A topological place: a node of the place graph.
using PlaceId = Id<struct PlaceTag>;

/// A point of the scene. The track of image points that it is seen by has the same id.
using LandmarkId = Id<struct LandmarkTag>;

/// A straight line of the scene. The track of edges that it is seen by has the same id.
using LineId = Id<struct LineTag>;

/// A plane of the scene.
using PlaneId = Id<struct PlaneTag>;

/// Three directions at right angles (a "rectangular world") that many edges of the scene keep to.
using ManhattanFrameId = Id<struct ManhattanFrameTag>;

/// A vertex of a pose graph: a pose, or a point beside the poses. Ids may be any integers.
using NodeId = Id<struct NodeTag>;

}  // namespace placegraph
