#include "python/src/values/value_class.h"

#include <fmt/format.h>

namespace placegraph::python {

nb::tuple pickled_state(const std::string& bytes) {
  return nb::make_tuple(PLACEGRAPH_VERSION, nb::bytes(bytes.data(), bytes.size()));
}

nb::bytes pickled_bytes(nb::handle state, nb::handle type) {
  const std::string name = nb::cast<std::string>(type.attr("__name__"));
  std::string version;
  require(nb::isinstance<nb::tuple>(state) && nb::len(state) == 2 &&
              nb::try_cast<std::string>(state[0], version) && nb::isinstance<nb::bytes>(state[1]),
          fmt::format("pickle: the state of a {} is its version and bytes", name));
  require_own_version(version, name);
  return nb::cast<nb::bytes>(state[1]);
}

void require_own_version(const std::string& version, const std::string& type) {
  require(version == PLACEGRAPH_VERSION,
          fmt::format("pickle: placegraph {} wrote this {}, and placegraph {} does not read it",
                      version, type, PLACEGRAPH_VERSION));
}

}  // namespace placegraph::python
