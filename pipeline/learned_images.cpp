#include <placegraph/graph/text/log_message.h>
#include <placegraph/pipeline/learned_images.h>

namespace placegraph {

void LearnedImages::take_up(const MapOrigin& origin) {
  mask_.take_up(origin.overlays, lens_.calibration().camera);
  if (origin.lens_k1 != 0) lens_.add(origin.lens_k1);
  lens_pass_ = origin.lens_pass;
}

void LearnedImages::describe(MapOrigin& origin) const {
  origin.calibration = lens_.calibration();
  origin.lens_k1 = lens_.k1();
  origin.lens_pass = lens_pass_;
  origin.overlays = mask_.overlays();
}

void LearnedImages::apply(Frame& frame) const {
  mask_.apply(frame);
  lens_.apply(frame);
}

bool LearnedImages::learn_overlay(const Slam& slam, const LogSink& log) {
  if (!mask_.learn(slam, lens_)) return false;
  lens_.reset();
  lens_pass_ = 0;
  placegraph::log(log, LogLevel::kInfo, "restarting without the regions that are fixed to the camera");
  return true;
}

bool LearnedImages::learn_lens(const LensDistortion& seen, const LensOptions& options,
                               const LogSink& log) {
  const auto change = change_of_k1(lens_.k1(), seen, lens_pass_, options);
  if (!change) return false;
  lens_.add(*change);
  ++lens_pass_;
  placegraph::log(
      log, LogLevel::kInfo,
      "images are distorted by {:f} +- {:f} more than expected: restarting with k1 = {:f}", seen.k1,
      seen.sigma_k1, lens_.k1());
  return true;
}

std::vector<DataNote> LearnedImages::notes(const Slam& slam, const LensOptions& options) const {
  std::vector<DataNote> notes;
  for (const MaskedOverlay& overlay : mask_.overlays()) notes.push_back(overlay.note);
  for (const DataNote& note : slam.notes()) notes.push_back(note);
  if (is_clear(slam.lens(), options)) notes.push_back(distortion_note(lens_.k1(), slam.lens()));
  return notes;
}

}  // namespace placegraph
