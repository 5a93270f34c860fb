#include "tests/faults/fault.h"

namespace placegraph::faults {

std::vector<Fault> all_faults() {
  std::vector<Fault> faults;
  for (const auto& kind : {optics_faults(), overlay_faults(), timing_faults(), calibration_faults(),
                           stereo_faults(), scene_faults(), motion_faults(), depth_faults()})
    faults.insert(faults.end(), kind.begin(), kind.end());
  return faults;
}

}  // namespace placegraph::faults
