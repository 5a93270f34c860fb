#pragma once
#include <placegraph/frontend/places/place_recognizer.h>
#include <placegraph/graph/image/frame.h>

#include <functional>

namespace placegraph {

/// The image of a frame that a recognizer of the caller's own is given: in colour, if there is one.
inline const Image& recognizer_image(const Frame& frame) {
  return frame.colour.empty() ? frame.image : frame.colour;
}

/// The best `count` of the views that `allowed` admits, best first.
///
/// The recognizer is asked once for each stretch of such views. Throws ArgumentError for candidates
/// that break the contract of PlaceRetrieval::query.
std::vector<PlaceSimilarity> ask_recognizer(PlaceRetrieval& recognizer, const Image& image,
                                            int views, int count,
                                            const std::function<bool(int)>& allowed);

}  // namespace placegraph
