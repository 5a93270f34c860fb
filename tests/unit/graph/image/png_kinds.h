#pragma once
#include <png.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace placegraph::test {

/// A kind of PNG file that libpng can write.
struct PngKind {
  int colour_type = PNG_COLOR_TYPE_GRAY;
  int bits = 8;
  bool interlaced = false;
  bool transparent = false;  ///< with a tRNS chunk
  int width = 0, height = 0;
};

inline std::string name_of(const PngKind& kind) {
  return "colour type " + std::to_string(kind.colour_type) + ", " + std::to_string(kind.bits) +
         " bits, " + std::to_string(kind.width) + "x" + std::to_string(kind.height) +
         (kind.interlaced ? ", interlaced" : "") + (kind.transparent ? ", transparent" : "");
}

/// All kinds of one size.
inline std::vector<PngKind> all_png_kinds(int width, int height) {
  std::vector<PngKind> kinds;
  for (const auto& [colour_type, all_bits] :
       {std::pair{PNG_COLOR_TYPE_GRAY, std::vector{1, 2, 4, 8, 16}},
        std::pair{PNG_COLOR_TYPE_PALETTE, std::vector{1, 2, 4, 8}},
        std::pair{PNG_COLOR_TYPE_RGB, std::vector{8, 16}},
        std::pair{PNG_COLOR_TYPE_GRAY_ALPHA, std::vector{8, 16}},
        std::pair{PNG_COLOR_TYPE_RGB_ALPHA, std::vector{8, 16}}})
    for (const int bits : all_bits)
      for (const bool interlaced : {false, true})
        for (const bool transparent : {false, true})
          if (!transparent || !(colour_type & PNG_COLOR_MASK_ALPHA))
            kinds.push_back({colour_type, bits, interlaced, transparent, width, height});
  return kinds;
}

inline void add_png_palette(png_structp png, png_infop info, const PngKind& kind) {
  std::vector<png_color> palette(std::size_t{1} << kind.bits);
  std::vector<png_byte> alpha;
  for (std::size_t i = 0; i < palette.size(); ++i) {
    const auto byte = [&](std::size_t factor) { return static_cast<png_byte>(factor * i + 9); };
    palette[i] = {byte(37), byte(101), byte(7)};
    if (i < 200) alpha.push_back(byte(59));
  }
  png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
  if (kind.transparent)
    png_set_tRNS(png, info, alpha.data(), static_cast<int>(alpha.size()), nullptr);
}

/// Random pixels in a file of this kind.
inline std::string make_png(const PngKind& kind, unsigned seed = 1) {
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &bytes,
      [](png_structp p, png_bytep data, png_size_t count) {
        static_cast<std::string*>(png_get_io_ptr(p))->append(reinterpret_cast<char*>(data), count);
      },
      [](png_structp) {});
  png_set_IHDR(png, info, static_cast<png_uint_32>(kind.width),
               static_cast<png_uint_32>(kind.height), kind.bits, kind.colour_type,
               kind.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (kind.colour_type == PNG_COLOR_TYPE_PALETTE) {
    add_png_palette(png, info, kind);
  } else if (kind.transparent) {
    png_color_16 clear{};
    clear.gray = clear.red = clear.green = clear.blue = 1;
    png_set_tRNS(png, info, nullptr, 0, &clear);
  }
  png_write_info(png, info);
  std::mt19937 random(seed);
  std::vector<std::vector<png_byte>> rows(static_cast<std::size_t>(kind.height));
  std::vector<png_bytep> pointers;
  for (auto& row : rows) {
    row.resize(png_get_rowbytes(png, info));
    // Two values: colours repeat, and that of the transparent pixels is among them.
    for (auto& byte : row) byte = random() % 3 ? static_cast<png_byte>(random()) : png_byte{1};
    pointers.push_back(row.data());
  }
  png_write_image(png, pointers.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

}  // namespace placegraph::test
