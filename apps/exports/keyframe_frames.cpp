#include "apps/exports/keyframe_frames.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/pipeline/internal/lens_correction.h>

namespace placegraph::apps {

PosedImages posed_images(const StoredMap& stored, const MapGeometry& geometry) {
  const MapOrigin& origin = stored.origin;
  const std::shared_ptr<const Dataset> dataset = open_dataset(origin.sequence);
  LensCorrection lens(dataset->calibration(origin.sensor));
  if (origin.lens_k1 != 0) lens.add(origin.lens_k1);
  for (const PosedKeyframe& posed : geometry.keyframes)
    require(posed.keyframe->frame.value() >= 0 &&
                static_cast<std::size_t>(posed.keyframe->frame.value()) < dataset->size(),
            fmt::format("{}: it has no frame {}, which is a keyframe of the map", origin.sequence,
                        posed.keyframe->frame.value()));
  return {geometry.keyframes, origin.calibration.value(),
          [dataset, lens, sensor = origin.sensor](const Keyframe& keyframe) {
            Frame frame = dataset->frame(static_cast<std::size_t>(keyframe.frame.value()), sensor);
            lens.apply(frame);
            frame.colour = frame.colour.empty() ? frame.colour : lens.corrected(frame.colour);
            return frame;
          }};
}

}  // namespace placegraph::apps
