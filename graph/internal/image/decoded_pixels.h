#pragma once

namespace placegraph {

/// Which pixels of a picture file are asked for. The EXIF orientation is never applied.
enum class DecodedPixels {
  kAsStored,      ///< grey, BGR or BGRA, of 8 or 16 bits: what the file has
  kGreyOrColour,  ///< grey or BGR, of 8 or 16 bits: alpha is left out
  kEightBits,     ///< grey or BGR of 8 bits: of 16 bits the upper ones
};

}  // namespace placegraph
