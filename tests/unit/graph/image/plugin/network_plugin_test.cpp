#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/network_plugin.h>

#include <memory>

namespace placegraph {
namespace network_plugin_test {

// What networks compute is tested with the recognizers that use them (onnx_describer_test.cpp).

const NetworkPlugin* plugin() {
  try {
    return &network_plugin("a test");
  } catch (const FileError&) {
    return nullptr;  // OpenCV's dnn is not installed
  }
}

TEST(NetworkPlugin, SaysInOneLineWhatIsNoNetwork) {
  if (!plugin()) GTEST_SKIP() << "there is no module for networks";
  for (const std::string& bytes : {std::string(), std::string("a text"), std::string(400, '\x1')}) {
    std::string problem;
    testing::internal::CaptureStderr();
    const std::unique_ptr<ImageNetwork> network = plugin()->load_onnx(bytes, problem);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(network, nullptr);
    EXPECT_NE(problem, "");
    EXPECT_EQ(problem.find('\n'), std::string::npos) << problem;
  }
}

}  // namespace network_plugin_test
}  // namespace placegraph
