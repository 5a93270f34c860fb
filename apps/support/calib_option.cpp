#include "apps/support/calib_option.h"

#include <CLI/CLI.hpp>

namespace placegraph::apps {

CLI::Option* add_calib_option(CLI::App& command, std::string& path, const std::string& doc) {
  return command.add_option("--calib", path, doc)->check(CLI::ExistingFile);
}

}  // namespace placegraph::apps
