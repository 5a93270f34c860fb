#pragma once
#include <placegraph/frontend/places/place_recognizer.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/map.h>

#include <functional>

namespace placegraph {

/// The image of a frame that a recognizer of the caller's own is given: in colour, if there is one.
inline const Image& recognizer_image(const Frame& frame) {
  return frame.colour.empty() ? frame.image : frame.colour;
}

/// The best `count` of the views that `allowed` admits, best first; the image is that of `frame`.
///
/// The recognizer is asked once for each stretch of such views. Throws ArgumentError for candidates
/// that break the contract of PlaceRetrieval::query.
std::vector<PlaceSimilarity> ask_recognizer(PlaceRetrieval& recognizer, const Image& image,
                                            FrameId frame, int views, int count,
                                            const std::function<bool(int)>& allowed);

/// Stores the images of a map's keyframes in a recognizer; null: does nothing.
///
/// `frame_of` returns their frames; without it there is an ArgumentError.
void show_keyframes(PlaceRetrieval* recognizer, const Map& map,
                    const std::function<Frame(FrameId)>& frame_of);

}  // namespace placegraph
