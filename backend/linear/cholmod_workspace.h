#pragma once
#include <suitesparse/cholmod.h>

namespace placegraph {

/// CHOLMOD's workspace and settings, without its printed messages.
class CholmodWorkspace {
 public:
  CholmodWorkspace() {
    cholmod_start(&common_);
    common_.print = 0;
    common_.final_ll = 1;
    common_.nmethods = 1;
    common_.quick_return_if_not_posdef = 1;
  }
  ~CholmodWorkspace() { cholmod_finish(&common_); }
  CholmodWorkspace(const CholmodWorkspace&) = delete;
  CholmodWorkspace& operator=(const CholmodWorkspace&) = delete;
  cholmod_common* operator->() { return &common_; }
  operator cholmod_common*() { return &common_; }

 private:
  cholmod_common common_;
};

}  // namespace placegraph
