#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/picture_size.h>
#include <placegraph/graph/image/png_codec.h>
#include <png.h>
#include <zlib.h>

#include <bit>
#include <csetjmp>
#include <cstring>
#include <exception>
#include <vector>

namespace placegraph {
namespace {

constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";

// libpng reports errors by a jump out of its functions. A jump must not pass over a C++ object that
// has a destructor: the functions below that call setjmp, and the callbacks, contain none.
[[noreturn]] void leave_png(png_structp png, png_const_charp) { png_longjmp(png, 1); }
void ignore_png_warning(png_structp, png_const_charp) {}

struct PngBytes {
  const char* next = nullptr;
  std::size_t left = 0;
};

void read_png_bytes(png_structp png, png_bytep to, png_size_t count) {
  auto& bytes = *static_cast<PngBytes*>(png_get_io_ptr(png));
  if (count > bytes.left) png_error(png, "the data end");
  std::memcpy(to, bytes.next, count);
  bytes.next += count;
  bytes.left -= count;
}

class PngReader {
 public:
  explicit PngReader(std::string_view bytes)
      : bytes_{bytes.data(), bytes.size()},
        png_(
            png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, leave_png, ignore_png_warning)) {
    if (png_) info_ = png_create_info_struct(png_);
    if (png_) end_ = png_create_info_struct(png_);
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, &end_); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  /// False if libpng refuses the data before the pixels.
  bool read_header() noexcept {
    if (!info_ || !end_ || setjmp(png_jmpbuf(png_))) return false;
    png_set_read_fn(png_, &bytes_, read_png_bytes);
    png_read_info(png_, info_);
    return true;
  }

  /// The type of the image as stored, after read_header().
  int stored_type() const {
    const int colour = png_get_color_type(png_, info_);
    const bool transparent = png_get_valid(png_, info_, PNG_INFO_tRNS) != 0;
    int channels = 1;
    if (colour & PNG_COLOR_MASK_ALPHA)
      channels = 4;
    else if (colour & PNG_COLOR_MASK_COLOR)
      channels = transparent ? 4 : 3;
    return CV_MAKETYPE(png_get_bit_depth(png_, info_) == 16 ? CV_16U : CV_8U, channels);
  }
  png_uint_32 width() const { return png_get_image_width(png_, info_); }
  png_uint_32 height() const { return png_get_image_height(png_, info_); }
  std::size_t stored_row_bytes() const { return png_get_rowbytes(png_, info_); }

  /// Decodes into rows of an image of `type`, after read_header(); false if the data are damaged.
  bool read_pixels(png_bytepp rows, int type) noexcept {
    if (setjmp(png_jmpbuf(png_))) return false;
    const int colour = png_get_color_type(png_, info_), bits = png_get_bit_depth(png_, info_);
    if (bits == 16 && CV_MAT_DEPTH(type) == CV_8U)
      png_set_strip_16(png_);
    else if (std::endian::native == std::endian::little)
      png_set_swap(png_);
    if (CV_MAT_CN(type) == 4)
      png_set_tRNS_to_alpha(png_);
    else
      png_set_strip_alpha(png_);
    if (colour == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png_);
    if (!(colour & PNG_COLOR_MASK_COLOR) && bits < 8) png_set_expand_gray_1_2_4_to_8(png_);
    if (colour & PNG_COLOR_MASK_COLOR)
      png_set_bgr(png_);
    else if (CV_MAT_CN(type) > 1)
      png_set_gray_to_rgb(png_);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    png_read_image(png_, rows);
    png_read_end(png_, end_);
    return true;
  }

 private:
  PngBytes bytes_;
  png_structp png_;
  png_infop info_ = nullptr, end_ = nullptr;
};

/// Whether that number of bytes can contain that number of pixel bytes: deflate writes at most 1032
/// bytes for one.
bool can_hold(std::size_t file_bytes, std::uint64_t row_bytes, std::uint64_t rows) {
  return row_bytes * rows / 1032 <= file_bytes;
}

std::vector<png_bytep> rows_of(const Image& image) {
  std::vector<png_bytep> rows;
  for (int v = 0; v < image.rows; ++v) rows.push_back(const_cast<png_bytep>(image.ptr(v)));
  return rows;
}

bool append(std::string& to, const char* bytes, std::size_t count) noexcept {
  try {
    to.append(bytes, count);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

void write_png_bytes(png_structp png, png_bytep bytes, png_size_t count) {
  auto& to = *static_cast<std::string*>(png_get_io_ptr(png));
  if (!append(to, reinterpret_cast<const char*>(bytes), count)) png_error(png, "no memory");
}
void flush_png_bytes(png_structp) {}

class PngWriter {
 public:
  PngWriter()
      : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, leave_png,
                                     ignore_png_warning)) {
    if (png_) info_ = png_create_info_struct(png_);
  }
  ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  bool write(png_bytepp rows, int width, int height, int type, const PngCompression& compression,
             std::string& bytes) noexcept {
    if (!info_ || setjmp(png_jmpbuf(png_))) return false;
    png_set_write_fn(png_, &bytes, write_png_bytes, flush_png_bytes);
    if (!compression.level) png_set_filter(png_, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_compression_level(png_, compression.level.value_or(Z_BEST_SPEED));
    const bool runs_only = compression.runs_only || !compression.level;
    png_set_compression_strategy(png_, runs_only ? Z_RLE : Z_DEFAULT_STRATEGY);
    const int channels = CV_MAT_CN(type);
    png_set_IHDR(png_, info_, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height),
                 CV_MAT_DEPTH(type) == CV_16U ? 16 : 8,
                 channels == 1   ? PNG_COLOR_TYPE_GRAY
                 : channels == 3 ? PNG_COLOR_TYPE_RGB
                                 : PNG_COLOR_TYPE_RGBA,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png_, info_);
    png_set_bgr(png_);
    if (std::endian::native == std::endian::little) png_set_swap(png_);
    png_write_image(png_, rows);
    png_write_end(png_, info_);
    return true;
  }

 private:
  png_structp png_;
  png_infop info_ = nullptr;
};

}  // namespace

bool is_png(std::string_view bytes) { return bytes.starts_with(kPngSignature.substr(0, 4)); }

bool is_truncated_png(std::string_view bytes) {
  return bytes.rfind("IEND") == std::string_view::npos;
}

Image decode_png(std::string_view bytes, DecodedPixels pixels) {
  if (!bytes.starts_with(kPngSignature)) return {};
  PngReader reader(bytes);
  if (!reader.read_header() || !is_decodable_size(reader.width(), reader.height()) ||
      !can_hold(bytes.size(), reader.stored_row_bytes(), reader.height()))
    return {};
  int type = reader.stored_type();
  if (pixels != DecodedPixels::kAsStored && CV_MAT_CN(type) == 4)
    type = CV_MAKETYPE(CV_MAT_DEPTH(type), 3);
  if (pixels == DecodedPixels::kEightBits) type = CV_MAKETYPE(CV_8U, CV_MAT_CN(type));
  Image image(static_cast<int>(reader.height()), static_cast<int>(reader.width()), type);
  std::vector<png_bytep> rows = rows_of(image);
  return reader.read_pixels(rows.data(), type) ? image : Image();
}

std::string encode_png(const Image& image, const PngCompression& compression) {
  const int channels = image.channels();
  require(!image.empty() && (image.depth() == CV_8U || image.depth() == CV_16U) &&
              (channels == 1 || channels == 3 || channels == 4),
          "encode_png: an image of 8 or 16 bits, grey, BGR or BGRA, is needed");
  require(!compression.level || (*compression.level >= 0 && *compression.level <= 9),
          "encode_png: the level is 0 to 9");
  std::string bytes;
  std::vector<png_bytep> rows = rows_of(image);
  PngWriter writer;
  if (!writer.write(rows.data(), image.cols, image.rows, image.type(), compression, bytes))
    throw Error("an image cannot be encoded as PNG");
  return bytes;
}

}  // namespace placegraph
