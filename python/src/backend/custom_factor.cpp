#include <fmt/format.h>

#include "python/src/backend/graphs.h"

namespace placegraph::python {
namespace {

/// A factor whose residual, and perhaps Jacobian, is a function of Python.
class PythonFactor final : public Factor {
 public:
  PythonFactor(nb::object residual, nb::object jacobian, std::string name,
               std::vector<std::size_t> kinds, int rows)
      : residual_(std::move(residual)),
        jacobian_(std::move(jacobian)),
        name_(std::move(name)),
        kinds_(std::move(kinds)),
        rows_(rows),
        whitening_(Eigen::MatrixXd::Identity(rows, rows)) {}
  PythonFactor(const PythonFactor&) = delete;
  PythonFactor& operator=(const PythonFactor&) = delete;
  /// A call without the GIL may drop the last reference to this factor.
  ~PythonFactor() override {
    const nb::gil_scoped_acquire gil;
    residual_.reset();
    jacobian_.reset();
  }

  void whiten(Eigen::MatrixXd whitening) { whitening_ = std::move(whitening); }
  int visit(visitproc visitor, void* arg) const {
    for (PyObject* function : {residual_.ptr(), jacobian_.ptr()})
      if (function)
        if (const int stop = visitor(function, arg)) return stop;
    return 0;
  }

  int residual_size() const override { return rows_; }
  std::vector<std::size_t> variable_kinds() const override { return kinds_; }
  bool evaluate(std::span<const Variable* const> values, Eigen::Ref<Eigen::VectorXd> r,
                std::span<Eigen::MatrixXd> jacobians) const override {
    const nb::gil_scoped_acquire gil;
    std::vector<nb::object> objects;
    for (const Variable* value : values) objects.push_back(object_of(*value));
    const std::optional<Eigen::VectorXd> raw = call(objects);
    if (!raw) return false;
    r = whitening_ * *raw;
    if (jacobians.empty()) return true;
    if (!jacobian_.is_none()) {
      call_jacobian(objects, jacobians);
      return true;
    }
    return differentiate(values, objects, jacobians);
  }

  /// The residual of the function; nothing if it is None. Precondition: the GIL is held.
  static std::optional<Eigen::VectorXd> residual_at(const nb::object& function,
                                                    const std::vector<nb::object>& objects,
                                                    const std::string& name, int rows) {
    nb::object result = function(*as_tuple(objects));
    if (result.is_none()) return std::nullopt;
    try {
      result = nb::module_::import_("numpy").attr("atleast_1d")(result);
    } catch (const nb::python_error& error) {      // checked_array says what is wrong
      if (!error.matches(PyExc_Exception)) throw;  // KeyboardInterrupt
    }
    const auto array =
        ArrayArgument<double>{result}.get(fmt::format("residual of {}", name).c_str(), {rows});
    require(array.shape(0) > 0, fmt::format("residual of {}: it has no rows", name));
    return Eigen::Map<const Eigen::VectorXd>(array.data(),
                                             static_cast<Eigen::Index>(array.shape(0)));
  }

 private:
  static nb::tuple as_tuple(const std::vector<nb::object>& objects) {
    nb::list list;
    for (const nb::object& object : objects) list.append(object);
    return nb::tuple(list);
  }

  std::optional<Eigen::VectorXd> call(const std::vector<nb::object>& objects) const {
    return residual_at(residual_, objects, name_, rows_);
  }

  void call_jacobian(const std::vector<nb::object>& objects,
                     std::span<Eigen::MatrixXd> jacobians) const {
    const std::string what = fmt::format("jacobian of {}", name_);
    nb::object result = jacobian_(*as_tuple(objects));
    if (!nb::isinstance<nb::tuple>(result) && !nb::isinstance<nb::list>(result))
      result = nb::make_tuple(result);
    require(nb::len(result) == jacobians.size(),
            fmt::format("{}: {} arrays are needed, one for each variable, not {}", what,
                        jacobians.size(), nb::len(result)));
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    for (std::size_t k = 0; k < jacobians.size(); ++k) {
      const auto dof = static_cast<int>(jacobians[k].cols());
      const auto array = ArrayArgument<double>{nb::borrow(result[k])}.get(
          fmt::format("{}, variable {}", what, k).c_str(), {rows_, dof});
      jacobians[k] = whitening_ * Eigen::Map<const RowMajor>(array.data(), rows_, dof);
    }
  }

  /// Central differences in the tangents of the variables.
  bool differentiate(std::span<const Variable* const> values, std::vector<nb::object>& objects,
                     std::span<Eigen::MatrixXd> jacobians) const {
    constexpr double kStep = 1e-5;  // the error is of the order kStep^2
    for (std::size_t k = 0; k < values.size(); ++k) {
      const nb::object present = objects[k];
      const Eigen::Index dof = jacobians[k].cols();
      for (Eigen::Index j = 0; j < dof; ++j) {
        const Eigen::VectorXd xi = kStep * Eigen::VectorXd::Unit(dof, j);
        objects[k] = object_of(plus(*values[k], xi));
        const auto ahead = call(objects);
        objects[k] = object_of(plus(*values[k], -xi));
        const auto behind = call(objects);
        if (!ahead || !behind) return false;
        jacobians[k].col(j) = whitening_ * (*ahead - *behind) / (2 * kStep);
      }
      objects[k] = present;
    }
    return true;
  }

  nb::object residual_, jacobian_;
  std::string name_;
  std::vector<std::size_t> kinds_;
  int rows_;
  Eigen::MatrixXd whitening_;
};

}  // namespace

NamedFactor custom_factor(nb::object residual, const std::vector<Variable>& values,
                          nb::object jacobian, nb::handle sigma, nb::handle information,
                          const std::string& name) {
  require(PyCallable_Check(residual.ptr()) == 1, "residual: it must be callable");
  require(jacobian.is_none() || PyCallable_Check(jacobian.ptr()) == 1,
          "jacobian: it must be callable, or None");
  std::string known = name;
  if (known.empty())
    known = nb::hasattr(residual, "__name__")
                ? nb::str(nb::object(residual.attr("__name__"))).c_str()
                : "a factor";
  std::vector<nb::object> objects;
  std::vector<std::size_t> kinds;
  for (const Variable& value : values) {
    kinds.push_back(value.index());
    objects.push_back(object_of(value));
  }
  require(!objects.empty(), "values: there are none");
  const auto r = PythonFactor::residual_at(residual, objects, known, kAny);
  require(r.has_value(),
          fmt::format("residual of {}: it is None at the values, which must give its size", known));
  const auto rows = static_cast<int>(r->size());
  const auto factor = std::make_shared<PythonFactor>(std::move(residual), std::move(jacobian),
                                                     known, std::move(kinds), rows);
  if (!sigma.is_none() || !information.is_none())
    factor->whiten(whitening_of(sigma, information, rows));
  return {factor, known};
}

int visit_functions(const FactorGraph::Term& term, visitproc visit, void* arg) {
  if (term.factor.use_count() != 1) return 0;
  const auto* factor = dynamic_cast<const PythonFactor*>(term.factor.get());
  return factor ? factor->visit(visit, arg) : 0;
}

}  // namespace placegraph::python
