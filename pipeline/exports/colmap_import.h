#pragma once
#include <placegraph/graph/core/log.h>
#include <placegraph/io/map/stored_map.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// The map of a COLMAP model in a folder, whose images are in a sequence.
///
/// Every image is a keyframe and a place of its own, every other frame of the sequence is lost. The
/// names of the images are their paths within the sequence or the names of its files. `metric`:
/// lengths of the model are metres. The map has no features, so that no run can continue it. Throws
/// ArgumentError if the sequence lacks an image, an image occurs twice or has another size than the
/// model's camera; FileError if there is no sequence or no model whose images have one pinhole
/// camera; NoResult if the model has no image. `log` takes a line on cameras that no image has.
StoredMap import_colmap(const std::string& model, const std::string& sequence, bool metric,
                        const LogSink& log = {});

}  // namespace placegraph
