#pragma once
#include <placegraph/graph/core/ids.h>

#include "python/src/bindings.h"

namespace nanobind::detail {

/// Ids are integers in Python.
template <class Tag>
struct type_caster<placegraph::Id<Tag>> {
  NB_TYPE_CASTER(placegraph::Id<Tag>, const_name("int"))

  bool from_python(handle source, uint8_t flags, cleanup_list* cleanup) noexcept {
    make_caster<std::int64_t> number;
    if (!number.from_python(source, flags, cleanup)) return false;
    value = placegraph::Id<Tag>(number.value);
    return true;
  }
  static handle from_cpp(placegraph::Id<Tag> id, rv_policy policy, cleanup_list* cleanup) noexcept {
    return make_caster<std::int64_t>::from_cpp(id.value(), policy, cleanup);
  }
};

}  // namespace nanobind::detail
