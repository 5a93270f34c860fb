#pragma once
#include <placegraph/io/exports/colmap_model.h>
#include <placegraph/io/map/stored_map.h>

#include <string>

namespace placegraph {

/// A map of the images and points of a COLMAP model, which are in a sequence.
///
/// Every image is a keyframe and a place of its own, every other frame of the sequence is lost. The
/// names of the images are their paths within the sequence or the names of its files. `metric`:
/// lengths of the model are metres. The map has no features, so that no run can continue it. Throws
/// ArgumentError if the sequence lacks an image, an image occurs twice or has another size than the
/// model's camera; FileError if there is no sequence.
StoredMap map_of_colmap(const ColmapModel& model, const std::string& sequence, bool metric);

}  // namespace placegraph
