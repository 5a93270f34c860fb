#include <placegraph/backend/evidence/intrinsics_evidence.h>
#include <placegraph/pipeline/local_map/distortion_evidence.h>

namespace placegraph {

DistortionEvidence lens_evidence(const WindowState& state) {
  const IntrinsicsEvidence all = intrinsics_evidence(state, true);
  return {all.gradient[IntrinsicsEvidence::kRadial],
          all.information(IntrinsicsEvidence::kRadial, IntrinsicsEvidence::kRadial), all.residuals};
}

}  // namespace placegraph
