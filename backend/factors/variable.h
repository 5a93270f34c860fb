#pragma once
#include <placegraph/graph/geometry/lie.h>
#include <placegraph/graph/geometry/line3.h>
#include <placegraph/graph/geometry/plane3.h>

#include <variant>

namespace [[gnu::visibility("default")]] placegraph {

/// A square marker of known size: x right, y up, z out of its face, origin in the middle.
struct Marker {
  SE3 T_world_marker;  ///< estimated pose
  double size_m = 1;   ///< length of a side [m]; known, not estimated
};

/// A variable that a factor graph can estimate.
/// Its kinds are: a scalar (a scale, a bias), poses `T_world_node` of three groups, a Manhattan
/// frame `R_world_manhattan`, a point in the world frame (or any three numbers), a line, a plane, a
/// marker.
using Variable = std::variant<double, SE2, SE3, Sim3, SO3, Eigen::Vector3d, Line3, Plane3, Marker>;

/// The tangent and the memory layout of a kind of variable.
/// `kDof` is the size of the tangent, x [+] xi = plus(x, xi), y [-] x = minus(y, x); `store` and
/// `load` convert to and from a block of `kSize` >= kDof doubles.
template <class T>
struct VariableBlock;

/// The tangent of a Lie group: x [+] xi = x exp(xi), y [-] x = log(x^-1 y).
template <class Group>
struct GroupBlock {
  static constexpr int kDof = Group::kDof;  ///< size of the tangent
  /// The group's own tangent.
  using Tangent = typename Group::Tangent;
  /// x [+] xi.
  static Group plus(const Group& x, const Tangent& xi) { return x.plus(xi); }
  /// y [-] x.
  static Tangent minus(const Group& y, const Group& x) { return (x.inverse() * y).log(); }
};

/// A planar pose, stored as [x, y, angle].
template <>
struct VariableBlock<SE2> : GroupBlock<SE2> {
  static constexpr int kSize = 3;
  static void store(const SE2& T, double* x) {
    x[0] = T.translation()[0];
    x[1] = T.translation()[1];
    x[2] = T.rotation().angle();
  }
  static SE2 load(const double* x) { return SE2(x[0], x[1], x[2]); }
};

/// A rotation, stored as [qx, qy, qz, qw].
template <>
struct VariableBlock<SO3> : GroupBlock<SO3> {
  static constexpr int kSize = 4;
  static void store(const SO3& R, double* x) {
    Eigen::Map<Eigen::Vector4d>{x} = R.quaternion().coeffs();
  }
  static SO3 load(const double* x) { return SO3(Eigen::Quaterniond(x)); }
};

/// A pose, stored as [qx, qy, qz, qw, x, y, z].
template <>
struct VariableBlock<SE3> : GroupBlock<SE3> {
  static constexpr int kSize = 7;
  static void store(const SE3& T, double* x) {
    VariableBlock<SO3>::store(T.rotation(), x);
    Eigen::Map<Eigen::Vector3d>(x + 4) = T.translation();
  }
  static SE3 load(const double* x) {
    return SE3(VariableBlock<SO3>::load(x),
               Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(x + 4)));
  }
};

/// A similarity, stored as [qx, qy, qz, qw, x, y, z, scale].
template <>
struct VariableBlock<Sim3> : GroupBlock<Sim3> {
  static constexpr int kSize = 8;
  static void store(const Sim3& S, double* x) {
    VariableBlock<SO3>::store(S.rotation(), x);
    Eigen::Map<Eigen::Vector3d>(x + 4) = S.translation();
    x[7] = S.scale();
  }
  static Sim3 load(const double* x) {
    return Sim3(VariableBlock<SO3>::load(x),
                Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(x + 4)), x[7]);
  }
};

template <>
struct VariableBlock<double> {
  static constexpr int kDof = 1, kSize = 1;
  using Tangent = Eigen::Matrix<double, 1, 1>;
  static double plus(double x, const Tangent& delta) { return x + delta[0]; }
  static Tangent minus(double y, double x) { return Tangent(y - x); }
  static void store(double value, double* x) { *x = value; }
  static double load(const double* x) { return *x; }
};

template <>
struct VariableBlock<Eigen::Vector3d> {
  static constexpr int kDof = 3, kSize = 3;
  using Tangent = Eigen::Vector3d;
  static Eigen::Vector3d plus(const Eigen::Vector3d& x, const Tangent& delta) { return x + delta; }
  static Tangent minus(const Eigen::Vector3d& y, const Eigen::Vector3d& x) { return y - x; }
  static void store(const Eigen::Vector3d& p, double* x) { Eigen::Map<Eigen::Vector3d>{x} = p; }
  static Eigen::Vector3d load(const double* x) { return Eigen::Map<const Eigen::Vector3d>(x); }
};

/// A line, stored as [quaternion of U, angle].
template <>
struct VariableBlock<Line3> {
  static constexpr int kDof = Line3::kDof, kSize = 5;
  using Tangent = Line3::Tangent;
  static Line3 plus(const Line3& line, const Tangent& delta) { return line.plus(delta); }
  static Tangent minus(const Line3& y, const Line3& x) { return y.minus(x); }
  static void store(const Line3& line, double* x) {
    VariableBlock<SO3>::store(line.U(), x);
    x[4] = line.angle();
  }
  static Line3 load(const double* x) { return {VariableBlock<SO3>::load(x), x[4]}; }
};

/// A plane, stored as its quaternion.
template <>
struct VariableBlock<Plane3> {
  static constexpr int kDof = Plane3::kDof, kSize = 4;
  using Tangent = Plane3::Tangent;
  static Plane3 plus(const Plane3& plane, const Tangent& delta) { return plane.plus(delta); }
  static Tangent minus(const Plane3& y, const Plane3& x) { return y.minus(x); }
  static void store(const Plane3& plane, double* x) {
    VariableBlock<SO3>::store(plane.quaternion(), x);
  }
  static Plane3 load(const double* x) { return Plane3(VariableBlock<SO3>::load(x)); }
};

/// A marker, stored as [T_world_marker, size].
template <>
struct VariableBlock<Marker> {
  static constexpr int kDof = SE3::kDof, kSize = 8;
  using Tangent = SE3::Tangent;
  static Marker plus(const Marker& x, const Tangent& xi) {
    return {x.T_world_marker.plus(xi), x.size_m};
  }
  static Tangent minus(const Marker& y, const Marker& x) {
    return VariableBlock<SE3>::minus(y.T_world_marker, x.T_world_marker);
  }
  static void store(const Marker& marker, double* x) {
    VariableBlock<SE3>::store(marker.T_world_marker, x);
    x[7] = marker.size_m;
  }
  static Marker load(const double* x) { return {VariableBlock<SE3>::load(x), x[7]}; }
};

/// Size of the variable's tangent.
int degrees_of_freedom(const Variable& variable);
/// Name of the variable's kind for messages: "scalar", "SE2", "SE3", "plane" etc.
const char* kind_name(const Variable& variable);
/// Number of doubles in the variable's block, see VariableBlock.
int block_size(const Variable& variable);
/// Writes the variable's value to `block`, which has room for block_size doubles.
void store_block(const Variable& variable, double* block);
/// Sets `variable` to the value in `block`; its kind stays the same.
void load_block(const double* block, Variable& variable);
/// y [-] x of two variables; throws ArgumentError if they are of different kinds.
Eigen::VectorXd minus(const Variable& y, const Variable& x);
/// Whether all numbers of the variable's block are finite.
bool is_finite(const Variable& variable);
/// x [+] xi; throws ArgumentError if `xi` has another size than degrees_of_freedom(x).
Variable plus(const Variable& x, const Eigen::Ref<const Eigen::VectorXd>& xi);

}  // namespace placegraph
