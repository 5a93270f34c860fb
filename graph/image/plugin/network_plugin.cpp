// The module libplacegraph_network_plugin.so, see network_plugin.h. It depends on OpenCV alone.
#include <placegraph/graph/image/network_plugin.h>

#include <algorithm>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>

namespace placegraph {
namespace {

/// OpenCV's messages on stderr are off while it exists: its exceptions say the same.
class QuietOpenCv {
 public:
  QuietOpenCv() : before_(cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT)) {}
  ~QuietOpenCv() { cv::utils::logging::setLogLevel(before_); }
  QuietOpenCv(const QuietOpenCv&) = delete;
  QuietOpenCv& operator=(const QuietOpenCv&) = delete;

 private:
  cv::utils::logging::LogLevel before_;
};

/// What OpenCV says of an error, in one line.
std::string one_line(const cv::Exception& error) {
  std::string text = error.err;
  // An error that was caught and thrown again has the text of the first one within its own.
  constexpr std::string_view kPlace = "OpenCV(", kMeaning = "error: ";
  if (const auto place = text.find(kPlace); place != std::string::npos) {
    const auto meaning = text.find(kMeaning, place);
    if (meaning != std::string::npos) text.erase(place, meaning + kMeaning.size() - place);
  }
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  const auto begin = text.find_first_not_of(" >"), end = text.find_last_not_of(" >");
  return begin == std::string::npos ? "no reason is given" : text.substr(begin, end + 1 - begin);
}

class OpenCvNetwork : public ImageNetwork {
 public:
  explicit OpenCvNetwork(cv::dnn::Net net) : net_(std::move(net)) {}

  std::vector<float> run(const Image& input, const std::string& output,
                         std::string& problem) override {
    const QuietOpenCv quiet;
    try {
      net_.setInput(input);
      const cv::Mat values = net_.forward(output);
      if (values.type() == CV_32FC1 && values.isContinuous() && !values.empty())
        return {values.ptr<float>(), values.ptr<float>() + values.total()};
      problem = "the output is no array of floats";
    } catch (const cv::Exception& error) {
      problem = one_line(error);
    } catch (const std::exception& error) {
      problem = error.what();
    }
    return {};
  }

 private:
  cv::dnn::Net net_;
};

struct OpenCvNetworks : NetworkPlugin {
  std::unique_ptr<ImageNetwork> load_onnx(std::string_view bytes,
                                          std::string& problem) const override {
    const QuietOpenCv quiet;
    try {
      cv::dnn::Net net = cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
      net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
      net.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
      if (!net.empty()) return std::make_unique<OpenCvNetwork>(std::move(net));
      problem = "it has no layers";
    } catch (const cv::Exception& error) {
      problem = one_line(error);
    } catch (const std::exception& error) {
      problem = error.what();
    }
    return nullptr;
  }
};

}  // namespace
}  // namespace placegraph

extern "C" __attribute__((visibility("default"))) std::int64_t placegraph_network_plugin_version() {
  return placegraph::kNetworkPluginVersion;
}

extern "C" __attribute__((visibility("default"))) const void* placegraph_network_plugin() {
  static const placegraph::OpenCvNetworks plugin;
  return static_cast<const placegraph::NetworkPlugin*>(&plugin);
}
