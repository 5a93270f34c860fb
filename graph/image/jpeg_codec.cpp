#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/jpeg_codec.h>
#include <placegraph/graph/image/picture_size.h>

// clang-format off
#include <cstdio>  // jpeglib.h needs FILE
#include <jpeglib.h>
#include <jerror.h>  // its numbers depend on what jpeglib.h defines
// clang-format on
#include <algorithm>
#include <csetjmp>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace placegraph {
namespace {

// libjpeg reports errors by a jump out of its functions. A jump must not pass over a C++ object
// that has a destructor: the functions below that call setjmp, and the callbacks, contain none.
struct JpegErrors {
  jpeg_error_mgr base;
  std::jmp_buf jump;
  bool damaged;  ///< whether pixels were invented for missing or wrong data
};

/// More bytes than this between two markers are data that no block used. Some cameras write a few.
constexpr int kMostStray = 64;

[[noreturn]] void leave_jpeg(j_common_ptr info) {
  std::longjmp(reinterpret_cast<JpegErrors*>(info->err)->jump, 1);
}
void ignore_jpeg_message(j_common_ptr) {}
/// Decides which of libjpeg's warnings (level -1) are about damaged pixels.
void judge_jpeg_warning(j_common_ptr info, int level) {
  if (level >= 0) return;
  switch (info->err->msg_code) {
    case JWRN_HIT_MARKER:
    case JWRN_HUFF_BAD_CODE:
    case JWRN_ARITH_BAD_CODE:
    case JWRN_MUST_RESYNC:
    case JWRN_BOGUS_PROGRESSION:
      reinterpret_cast<JpegErrors*>(info->err)->damaged = true;
      break;
    case JWRN_EXTRANEOUS_DATA:
      if (info->err->msg_parm.i[0] > kMostStray)
        reinterpret_cast<JpegErrors*>(info->err)->damaged = true;
      break;
    default:
      break;
  }
}

void do_nothing(j_decompress_ptr) {}
/// No more bytes exist than those in memory.
boolean end_of_data(j_decompress_ptr) { return FALSE; }
void skip_data(j_decompress_ptr info, long count) {
  jpeg_source_mgr& source = *info->src;
  if (count <= 0) return;
  const std::size_t skipped = std::min(static_cast<std::size_t>(count), source.bytes_in_buffer);
  source.next_input_byte += skipped;
  source.bytes_in_buffer -= skipped;
}

class JpegReader {
 public:
  explicit JpegReader(std::string_view bytes) {
    info_.err = jpeg_std_error(&errors_.base);
    errors_.base.error_exit = leave_jpeg;
    errors_.base.output_message = ignore_jpeg_message;
    errors_.base.emit_message = judge_jpeg_warning;
    source_.next_input_byte = reinterpret_cast<const JOCTET*>(bytes.data());
    source_.bytes_in_buffer = bytes.size();
    source_.init_source = do_nothing;
    source_.fill_input_buffer = end_of_data;
    source_.skip_input_data = skip_data;
    source_.resync_to_restart = jpeg_resync_to_restart;
    source_.term_source = do_nothing;
  }
  ~JpegReader() { jpeg_destroy_decompress(&info_); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  /// False if libjpeg refuses the data before the pixels.
  bool read_header() noexcept {
    if (setjmp(errors_.jump)) return false;
    jpeg_create_decompress(&info_);
    info_.src = &source_;
    return jpeg_read_header(&info_, TRUE) == JPEG_HEADER_OK;
  }

  unsigned width() const { return info_.image_width; }
  unsigned height() const { return info_.image_height; }
  int components() const { return info_.num_components; }
  bool arithmetic_code() const { return info_.arith_code != FALSE; }

  /// Begins to decode to grey, BGR or four inks, after read_header().
  bool start() noexcept {
    if (setjmp(errors_.jump)) return false;
    info_.out_color_space = components() == 1   ? JCS_GRAYSCALE
                            : components() == 4 ? JCS_CMYK
                                                : JCS_EXT_BGR;
    return jpeg_start_decompress(&info_) != FALSE;
  }

  /// Decodes the next row.
  bool read_row(JSAMPROW row) noexcept {
    if (setjmp(errors_.jump)) return false;
    return jpeg_read_scanlines(&info_, &row, 1) == 1;
  }

  /// Reads up to the end mark, after the last row; whether all data made sense.
  bool finish() noexcept {
    if (setjmp(errors_.jump)) return false;
    (void)jpeg_finish_decompress(&info_);  // false: the end mark is missing, all rows are there
    return !errors_.damaged;
  }

 private:
  JpegErrors errors_{};
  jpeg_source_mgr source_{};
  jpeg_decompress_struct info_{};
};

/// Encodes an image into a buffer of its own.
class JpegWriter {
 public:
  JpegWriter() {
    info_.err = jpeg_std_error(&errors_.base);
    errors_.base.error_exit = leave_jpeg;
    errors_.base.output_message = ignore_jpeg_message;
  }
  ~JpegWriter() {
    jpeg_destroy_compress(&info_);
    std::free(bytes_);
  }
  JpegWriter(const JpegWriter&) = delete;
  JpegWriter& operator=(const JpegWriter&) = delete;

  bool encode(const Image& image, int quality) noexcept {
    if (setjmp(errors_.jump)) return false;
    jpeg_create_compress(&info_);
    jpeg_mem_dest(&info_, &bytes_, &size_);
    info_.image_width = static_cast<JDIMENSION>(image.cols);
    info_.image_height = static_cast<JDIMENSION>(image.rows);
    info_.input_components = image.channels();
    info_.in_color_space = image.channels() == 1 ? JCS_GRAYSCALE : JCS_EXT_BGR;
    jpeg_set_defaults(&info_);
    jpeg_set_quality(&info_, quality, TRUE);
    jpeg_start_compress(&info_, TRUE);
    while (info_.next_scanline < info_.image_height) {
      auto* row = const_cast<JSAMPROW>(image.ptr(static_cast<int>(info_.next_scanline)));
      (void)jpeg_write_scanlines(&info_, &row, 1);
    }
    jpeg_finish_compress(&info_);
    return true;
  }
  std::string_view bytes() const { return {reinterpret_cast<const char*>(bytes_), size_}; }

 private:
  JpegErrors errors_{};
  jpeg_compress_struct info_{};
  unsigned char* bytes_ = nullptr;
  unsigned long size_ = 0;  // NOLINT(google-runtime-int): libjpeg's type
};

/// Whether that number of bytes can contain that number of pixels: a block of 8x8 takes one bit at
/// least.
bool can_hold_blocks(std::size_t file_bytes, const JpegReader& reader) {
  return reader.arithmetic_code() ||
         std::uint64_t{reader.width()} * reader.height() / 512 <= file_bytes;
}

/// Colour of ink over white: the light that passes both the ink and black.
void inks_to_bgr(const std::vector<JSAMPLE>& inks, JSAMPROW bgr) {
  for (std::size_t i = 0; i < inks.size(); i += 4, bgr += 3) {
    const int black = inks[i + 3];
    for (std::size_t c = 0; c < 3; ++c)
      bgr[2 - c] = static_cast<JSAMPLE>(black - ((255 - inks[i + c]) * black >> 8));
  }
}

}  // namespace

bool is_jpeg(std::string_view bytes) { return bytes.starts_with("\xff\xd8"); }

bool is_truncated_jpeg(std::string_view bytes) {
  const auto end = bytes.rfind("\xff\xd9"), scan = bytes.rfind("\xff\xda");
  return end == std::string_view::npos || (scan != std::string_view::npos && end < scan);
}

Image decode_jpeg(std::string_view bytes) {
  if (!bytes.starts_with("\xff\xd8\xff")) return {};
  JpegReader reader(bytes);
  if (!reader.read_header() || !is_decodable_size(reader.width(), reader.height()) ||
      !can_hold_blocks(bytes.size(), reader) || !reader.start())
    return {};
  Image image(static_cast<int>(reader.height()), static_cast<int>(reader.width()),
              reader.components() == 1 ? CV_8UC1 : CV_8UC3);
  std::vector<JSAMPLE> inks(reader.components() == 4 ? std::size_t{4} * reader.width() : 0);
  for (int v = 0; v < image.rows; ++v) {
    if (!reader.read_row(inks.empty() ? image.ptr(v) : inks.data())) return {};
    if (!inks.empty()) inks_to_bgr(inks, image.ptr(v));
  }
  return reader.finish() ? image : Image();
}

std::string encode_jpeg(const Image& image, int quality) {
  require(!image.empty() && (image.type() == CV_8UC1 || image.type() == CV_8UC3),
          "encode_jpeg: the image must be CV_8UC1 or CV_8UC3");
  require(quality >= 1 && quality <= 100, "encode_jpeg: quality must be from 1 to 100");
  JpegWriter writer;
  require(writer.encode(image, quality), "encode_jpeg: the image is too large");
  return std::string(writer.bytes());
}

}  // namespace placegraph
