#pragma once
#include <placegraph/graph/image/image.h>

#include <cstdint>
#include <memory>
#include <opencv2/core/version.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace placegraph {

/// A neural network that computes numbers of pictures.
class ImageNetwork {
 public:
  virtual ~ImageNetwork() = default;
  /// The values of one output for an input (CV_32F of four dimensions); `output` names it, or is
  /// empty for the last one. No values with a reason in `problem` if it cannot be computed.
  virtual std::vector<float> run(const Image& input, const std::string& output,
                                 std::string& problem) = 0;
};

/// Interface of the module libplacegraph_network_plugin.so. Only the module links OpenCV's dnn. No
/// function throws.
struct NetworkPlugin {
  virtual ~NetworkPlugin() = default;
  /// Loads a network from the bytes of an ONNX file; null with a reason in `problem`, which names
  /// the layer, if it has parts that this version does not know.
  virtual std::unique_ptr<ImageNetwork> load_onnx(std::string_view bytes,
                                                  std::string& problem) const = 0;
};

/// The version of NetworkPlugin, and that of the OpenCV whose images it takes. It changes with
/// every change of the declarations above.
constexpr std::int64_t kNetworkPluginVersion =
    1'000'000 + 1'000 * CV_VERSION_MAJOR + CV_VERSION_MINOR;

constexpr const char* kNetworkPluginFile = "libplacegraph_network_plugin.so";

/// The module, loaded by the first call. Any thread may call this function. `wanted` names the
/// purpose, usually the path of a file. Throws FileError, which names `wanted`, the module and the
/// folders of plugin_folders(), if the module is in none of them or cannot be loaded.
const NetworkPlugin& network_plugin(const std::string& wanted);

}  // namespace placegraph
