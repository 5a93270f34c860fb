#pragma once
#include <placegraph/backend/factor_graph/factor_graph.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/core/robust_kernel.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "python/src/arrays.h"

namespace placegraph::python {

// ---- rows of numbers of poses: x y angle; x y z qx qy qz qw; or these and the scale ----

/// Width of a row of a kind of pose.
std::size_t row_width(PoseKind kind);
/// The pose of a row of 3, 7 or 8 finite numbers; throws ArgumentError, which names the row.
Pose pose_of_row(const double* row, std::size_t width, const std::string& name);
void append_row(const Pose& pose, std::vector<double>& values);
/// Ids of nodes of an array, N of int64; ArgumentError names `ids`.
std::vector<NodeId> node_ids(const ArrayArgument<std::int64_t>& ids);
/// The pose of an SE2, SE3 or Sim3, of a row, or of a matrix (3 x 3 in the plane, 4 x 4 in space).
Pose pose_of(nb::handle value, const char* argument);
/// Poses of rows (N x 3, N x 7 or N x 8) or matrices (N x 3 x 3 in the plane, N x 4 x 4 in space),
/// all of one kind; `count` may be kAny. Throws ArgumentError, which names the argument and row.
std::vector<Pose> poses_of(const ArrayArgument<double>& array, const char* argument, int count);

/// An object whose class only the caller knows: typing.Any for the type checkers.
inline nb::any as_any(nb::object object) { return nb::steal<nb::any>(object.release()); }

// ---- names of choices ----

RotationError rotation_error_of(const std::string& name);

// ---- variables of factor graphs: float, SE2, SE3, Sim3, SO3, 3 numbers, Line3, Plane3, Marker
// ----

/// The variable of an object of Python; throws ArgumentError, which names the argument.
Variable variable_of(nb::handle value, const std::string& argument);
nb::object object_of(const Variable& variable);

/// Adds to the class what makes and changes a pose graph.
void bind_pose_graph_building(nb::class_<PoseGraph>& graph);

// ---- calls into the library ----

/// A log that makes warnings those of Python, and gives `on_step` (a function, or None) the other
/// messages: a line for each step.
LogSink steps_to(nb::handle on_step);

/// W with W^T W = information, of standard deviations (one, or one a row) or of a matrix.
/// Throws ArgumentError unless exactly one of them is given and positive.
Eigen::MatrixXd whitening_of(nb::handle sigma, nb::handle information, int rows);

/// An object that only one call at a time may use, because calls release the GIL.
template <class T>
class Exclusive {
 public:
  Exclusive(const char* name, T value) : name_(name), value_(std::move(value)) {}

  /// The object; throws ArgumentError while a call is running, and Error after a change that was
  /// interrupted.
  T& get() {
    require(!busy_, std::string(name_) + ": another call is using it");
    if (half_changed_)
      throw Error(std::string(name_) + ": an interrupted call left it half changed; make another");
    return value_;
  }
  /// The object for the garbage collector; null while a call is running.
  T* at_rest() { return busy_ ? nullptr : &value_; }
  /// Calls `function` with the object and without the GIL.
  template <class Function>
  auto run(const Function& function) {
    T& value = get();
    const Busy busy(busy_);
    const WithoutGil released;
    return function(value);
  }
  /// The same of a function that changes the object, which is lost if Python interrupts it.
  template <class Function>
  auto change(const Function& function) {
    try {
      return run(function);
    } catch (const nb::python_error&) {
      half_changed_ = true;
      throw;
    }
  }

 private:
  struct Busy {
    explicit Busy(bool& shared) : flag(shared) { flag = true; }
    ~Busy() { flag = false; }
    Busy(const Busy&) = delete;
    Busy& operator=(const Busy&) = delete;
    bool& flag;
  };
  const char* name_;
  T value_;
  bool busy_ = false, half_changed_ = false;
};

/// A factor with its name.
struct NamedFactor {
  std::shared_ptr<const Factor> factor;
  std::string name;
};

/// A factor of functions of Python. The kinds of its variables and the size of its residual are
/// those at `values`. See Factor.custom for the arguments.
NamedFactor custom_factor(nb::object residual, const std::vector<Variable>& values,
                          nb::object jacobian, nb::handle sigma, nb::handle information,
                          const std::string& name);

/// For the garbage collector: visits the functions of Python that only this term refers to.
int visit_functions(const FactorGraph::Term& term, visitproc visit, void* arg);

}  // namespace placegraph::python
