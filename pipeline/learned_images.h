#pragma once
#include <placegraph/io/map/stored_map.h>
#include <placegraph/pipeline/lens_correction.h>
#include <placegraph/pipeline/run_mask.h>

#include <vector>

namespace placegraph {

/// What the passes of a run have learned of its images: the distortion that is removed from them,
/// and the static overlays that are masked. It is part of the origin of the map.
class LearnedImages {
 public:
  LearnedImages(const RunMask& mask, const Calibration& as_given)
      : mask_(mask), lens_(as_given) {}

  /// Takes over what an interrupted run has learned. Throws ArgumentError if its overlays are not
  /// of the images' size.
  void take_up(const MapOrigin& origin);
  void describe(MapOrigin& origin) const;

  Calibration calibration() const { return lens_.calibration(); }
  double k1() const { return lens_.k1(); }
  /// Number of restarts for the present distortion.
  int lens_pass() const { return lens_pass_; }
  void apply(Frame& frame) const;

  /// Learns the static overlay that a pass has found; returns whether the run must restart. The
  /// lens is then estimated again: tracks on the overlay have contributed to its estimate.
  bool learn_overlay(const Slam& slam, const LogSink& log);
  /// Learns the distortion that a pass has left in its images; returns whether the run must
  /// restart.
  bool learn_lens(const LensDistortion& seen, const LensOptions& options, const LogSink& log);
  /// What all passes have found, and what the present one leaves in its images.
  std::vector<DataNote> notes(const Slam& slam, const LensOptions& options) const;

 private:
  RunMask mask_;
  LensCorrection lens_;
  int lens_pass_ = 0;
};

}  // namespace placegraph
