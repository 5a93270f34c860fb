#pragma once
#include <jpeglib.h>
#include <cstdio>  // jpeglib.h needs FILE
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

namespace placegraph::test {

/// A kind of JPEG file that libjpeg can write.
struct JpegKind {
  J_COLOR_SPACE stored = JCS_YCbCr;  ///< colours of the file
  int horizontal = 1, vertical = 1;  ///< pixels that share a value of colour
  bool progressive = false, arithmetic = false;
  int restart_rows = 0;
  int width = 0, height = 0;
};

inline std::string name_of(const JpegKind& kind) {
  return "colours " + std::to_string(kind.stored) + ", " + std::to_string(kind.horizontal) + "x" +
         std::to_string(kind.vertical) + (kind.progressive ? ", progressive" : "") +
         (kind.arithmetic ? ", arithmetic" : "") + ", restart " +
         std::to_string(kind.restart_rows) + ", " + std::to_string(kind.width) + "x" +
         std::to_string(kind.height);
}

/// All kinds of one size.
inline std::vector<JpegKind> all_jpeg_kinds(int width, int height) {
  std::vector<JpegKind> kinds;
  for (const J_COLOR_SPACE stored : {JCS_GRAYSCALE, JCS_RGB, JCS_YCbCr, JCS_CMYK, JCS_YCCK})
    for (const auto& [horizontal, vertical] : {std::pair{1, 1}, {2, 1}, {2, 2}, {1, 2}, {4, 1}})
      for (const bool progressive : {false, true})
        for (const bool arithmetic : {false, true})
          for (const int restart_rows : {0, 1})
            if (horizontal * vertical == 1 || stored == JCS_YCbCr || stored == JCS_YCCK)
              kinds.push_back({stored, horizontal, vertical, progressive, arithmetic, restart_rows,
                               width, height});
  return kinds;
}

/// A smooth random picture in a file of this kind.
inline std::string make_jpeg(const JpegKind& kind, unsigned seed = 1) {
  jpeg_compress_struct info{};
  jpeg_error_mgr errors{};
  info.err = jpeg_std_error(&errors);
  jpeg_create_compress(&info);
  unsigned char* data = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&info, &data, &size);
  info.image_width = static_cast<JDIMENSION>(kind.width);
  info.image_height = static_cast<JDIMENSION>(kind.height);
  const bool inks = kind.stored == JCS_CMYK || kind.stored == JCS_YCCK;
  info.in_color_space = kind.stored == JCS_GRAYSCALE ? JCS_GRAYSCALE : inks ? JCS_CMYK : JCS_RGB;
  info.input_components = kind.stored == JCS_GRAYSCALE ? 1 : inks ? 4 : 3;
  jpeg_set_defaults(&info);
  jpeg_set_colorspace(&info, kind.stored);
  jpeg_set_quality(&info, 85, TRUE);
  info.comp_info[0].h_samp_factor = kind.horizontal;
  info.comp_info[0].v_samp_factor = kind.vertical;
  if (kind.stored == JCS_YCCK) {
    info.comp_info[3].h_samp_factor = kind.horizontal;
    info.comp_info[3].v_samp_factor = kind.vertical;
  }
  info.arith_code = kind.arithmetic;
  info.restart_in_rows = kind.restart_rows;
  if (kind.progressive) jpeg_simple_progression(&info);
  jpeg_start_compress(&info, TRUE);
  std::mt19937 random(seed);
  std::vector<JSAMPLE> row(static_cast<std::size_t>(kind.width * info.input_components));
  for (int v = 0; v < kind.height; ++v) {
    for (std::size_t i = 0; i < row.size(); ++i)
      row[i] =
          static_cast<JSAMPLE>((3 * i + 5 * static_cast<std::size_t>(v) + random() % 40) % 256);
    JSAMPROW pointer = row.data();
    jpeg_write_scanlines(&info, &pointer, 1);
  }
  jpeg_finish_compress(&info);
  const std::string bytes(reinterpret_cast<char*>(data), size);
  jpeg_destroy_compress(&info);
  std::free(data);
  return bytes;
}

}  // namespace placegraph::test
