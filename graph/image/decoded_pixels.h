#pragma once

namespace placegraph {

/// The pixel format that is requested of a picture file. The EXIF orientation is never applied.
enum class DecodedPixels {
  kAsStored,      ///< the format of the file: grey, BGR or BGRA, 8 or 16 bits
  kGreyOrColour,  ///< grey or BGR, 8 or 16 bits; alpha is dropped
  kEightBits,     ///< grey or BGR, 8 bits: the upper ones of 16 bits
};

}  // namespace placegraph
