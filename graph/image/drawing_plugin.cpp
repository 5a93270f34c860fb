#include <placegraph/graph/image/drawing_plugin.h>
#include <placegraph/graph/image/plugin_folders.h>
#include <placegraph/graph/image/plugin_loader.h>

namespace placegraph {

const DrawingPlugin& load_drawing_plugin(const std::vector<std::string>& folders,
                                         const std::string& wanted) {
  constexpr PluginKind kKind = {kDrawingPluginFile, "placegraph_drawing_plugin_version",
                                "placegraph_drawing_plugin", kDrawingPluginVersion,
                                "librsvg2-2 and fonts-dejavu-core"};
  return *static_cast<const DrawingPlugin*>(load_plugin(kKind, folders, wanted));
}

const DrawingPlugin& drawing_plugin(const std::string& wanted) {
  static const DrawingPlugin& plugin = load_drawing_plugin(plugin_folders(), wanted);
  return plugin;
}

}  // namespace placegraph
