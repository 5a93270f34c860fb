#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// What a module of the library offers, and what a message says if it is missing.
struct PluginKind {
  const char* file;            ///< name of the shared library
  const char* version_symbol;  ///< function std::int64_t () in it
  const char* symbol;          ///< function const void* () in it: the address of the interface
  std::int64_t version;        ///< the only version that is taken
  const char* packages;        ///< Debian's packages that it links
};

/// Loads a module from the first of the folders that has it in this version. It stays loaded.
/// `wanted` names the purpose, usually the path of a file. Throws FileError, which names `wanted`,
/// the module and the folders, if it is in none of them or cannot be loaded.
const void* load_plugin(const PluginKind& kind, const std::vector<std::string>& folders,
                        const std::string& wanted);

/// The same in the folders of plugin_folders().
const void* load_plugin(const PluginKind& kind, const std::string& wanted);

}  // namespace placegraph
