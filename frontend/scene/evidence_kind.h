#pragma once
#include <cstddef>

namespace placegraph {

/// Positions in EnvironmentEvidence::values.
enum EvidenceKind : std::size_t {
  kSkyAbove,
  kGroundAbove,
  kVerticalAbove,
  kGroundBelow,
  kVerticalBelow,
  kObject,
  kLines,
  kUpright,
  kLevel,
  kRectangular,
  kSpread,
  kTall,
  kDepth,
  kSide,
  kAbove
};

}  // namespace placegraph
