#include <placegraph/graph/image/network_plugin.h>
#include <placegraph/graph/image/plugin_loader.h>

namespace placegraph {

const NetworkPlugin& network_plugin(const std::string& wanted) {
  constexpr PluginKind kKind = {kNetworkPluginFile, "placegraph_network_plugin_version",
                                "placegraph_network_plugin", kNetworkPluginVersion,
                                "libopencv-dnn406"};
  static const NetworkPlugin& plugin =
      *static_cast<const NetworkPlugin*>(load_plugin(kKind, wanted));
  return plugin;
}

}  // namespace placegraph
