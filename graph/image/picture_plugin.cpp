#include <placegraph/graph/image/picture_plugin.h>
#include <placegraph/graph/image/plugin_folders.h>
#include <placegraph/graph/image/plugin_loader.h>

namespace placegraph {

const PicturePlugin& load_picture_plugin(const std::vector<std::string>& folders,
                                         const std::string& wanted) {
  constexpr PluginKind kKind = {
      kPicturePluginFile, "placegraph_picture_plugin_version", "placegraph_picture_plugin",
      kPicturePluginVersion,
      "libopencv-imgcodecs406, libopencv-videoio406 and libopencv-contrib406"};
  return *static_cast<const PicturePlugin*>(load_plugin(kKind, folders, wanted));
}

const PicturePlugin& picture_plugin(const std::string& wanted) {
  // A loaded module stays loaded. After a failure the next call tries again.
  static const PicturePlugin& plugin = load_picture_plugin(plugin_folders(), wanted);
  return plugin;
}

}  // namespace placegraph
