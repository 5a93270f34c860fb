#pragma once

namespace placegraph {

/// Form of the numbers of an exported file.
enum class NumberForm {
  kBinary,  ///< little-endian
  kText     ///< decimal
};

}  // namespace placegraph
