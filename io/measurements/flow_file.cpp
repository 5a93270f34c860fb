#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/png_codec.h>
#include <placegraph/io/files/atomic_file.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/measurements/flow_file.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

namespace placegraph {
namespace {

static_assert(std::endian::native == std::endian::little, "the files are little-endian");

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr float kMiddleburyTag = 202021.25F, kMiddleburyLimit = 1e9F, kMiddleburyUnknown = 1.6e9F;
constexpr std::int32_t kMaxSide = 32768;
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 27;  // 1 GiB of flow

bool known(const cv::Vec2f& d) { return std::isfinite(d[0]) && std::isfinite(d[1]); }

std::string lower_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

Image read_middlebury(const std::string& path) {
  require_input_file(path);
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  std::ifstream stream(path, std::ios::binary);
  if (error || !stream) throw FileError(path, "flow cannot be read");
  float tag = 0;
  std::array<std::int32_t, 2> sides{};
  stream.read(reinterpret_cast<char*>(&tag), sizeof tag);
  stream.read(reinterpret_cast<char*>(sides.data()), sizeof sides);
  if (!stream || tag != kMiddleburyTag) throw FileError(path, "is not Middlebury flow");
  const auto [width, height] = sides;
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide ||
      std::int64_t{width} * height > kMaxPixels)
    throw FileError(path, fmt::format("flow of {}x{} pixels", width, height));
  const std::uintmax_t expected = 12 + std::uintmax_t{8} * static_cast<std::uintmax_t>(width) *
                                           static_cast<std::uintmax_t>(height);
  if (size != expected)
    throw FileError(path, fmt::format("{} bytes, but flow of {}x{} pixels has {}", size, width,
                                      height, expected));
  Image flow(height, width, CV_32FC2);
  stream.read(reinterpret_cast<char*>(flow.data), static_cast<std::streamsize>(expected - 12));
  if (!stream) throw FileError(path, "flow cannot be read");
  for (auto& d : cv::Mat_<cv::Vec2f>(flow))
    if (!(std::abs(d[0]) <= kMiddleburyLimit && std::abs(d[1]) <= kMiddleburyLimit))
      d = {kUnknown, kUnknown};
  return flow;
}

Image read_kitti_flow(const std::string& path) {
  const Image raw = read_image_as_stored(path);
  if (raw.type() != CV_16UC3) throw FileError(path, "flow must have three channels of 16 bits");
  Image flow(raw.size(), CV_32FC2);
  for (int v = 0; v < raw.rows; ++v) {
    for (int u = 0; u < raw.cols; ++u) {
      const cv::Vec3w& d = raw.at<cv::Vec3w>(v, u);
      const auto px = [](unsigned short steps) {
        return static_cast<float>(static_cast<int>(steps) - 32768) / 64;
      };
      flow.at<cv::Vec2f>(v, u) =
          d[0] ? cv::Vec2f(px(d[2]), px(d[1])) : cv::Vec2f(kUnknown, kUnknown);
    }
  }
  return flow;
}

void write_middlebury(std::ostream& stream, const Image& flow) {
  const std::array<std::int32_t, 2> sides{flow.cols, flow.rows};
  stream.write(reinterpret_cast<const char*>(&kMiddleburyTag), sizeof kMiddleburyTag);
  stream.write(reinterpret_cast<const char*>(sides.data()), sizeof sides);
  Image complete = flow.clone();
  for (auto& d : cv::Mat_<cv::Vec2f>(complete))
    if (!known(d)) d = {kMiddleburyUnknown, kMiddleburyUnknown};
  stream.write(reinterpret_cast<const char*>(complete.data),
               static_cast<std::streamsize>(complete.total() * complete.elemSize()));
}

}  // namespace

Image encode_kitti_flow(const Image& flow) {
  require(flow.type() == CV_32FC2, "encode_kitti_flow: flow of two channels is needed");
  Image out(flow.size(), CV_16UC3, cv::Scalar::all(0));
  for (int v = 0; v < out.rows; ++v) {
    for (int u = 0; u < out.cols; ++u) {
      const cv::Vec2f& d = flow.at<cv::Vec2f>(v, u);
      const double du = std::floor(d[0] * 64.0 + 32768.5), dv = std::floor(d[1] * 64.0 + 32768.5);
      if (!(du >= 0 && dv >= 0 && du <= 65535 && dv <= 65535)) continue;
      out.at<cv::Vec3w>(v, u) = {1, static_cast<unsigned short>(dv),
                                 static_cast<unsigned short>(du)};
    }
  }
  return out;
}

void require_flow_extension(const std::string& path) {
  const std::string extension = lower_extension(path);
  require(extension == ".flo" || extension == ".png",
          path + ": flow is written as .flo (Middlebury) or .png (KITTI)");
}

Image read_flow(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw FileError(path, "flow is missing");
  const std::string extension = lower_extension(path);
  if (extension == ".flo") return read_middlebury(path);
  if (extension == ".png") return read_kitti_flow(path);
  throw FileError(path, "flow is read from .flo (Middlebury) or .png (KITTI)");
}

void write_flow(const std::string& path, const Image& flow) {
  require(flow.type() == CV_32FC2, "write_flow: flow of two channels is needed");
  require_flow_extension(path);
  AtomicFile file(path);
  if (lower_extension(path) == ".flo") {
    write_middlebury(file.stream(), flow);
  } else {
    const std::string bytes = encode_png(encode_kitti_flow(flow));
    file.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  file.commit();
}

}  // namespace placegraph
