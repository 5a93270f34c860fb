#pragma once
/// The five Lie groups of the library, all with one interface: exp, log, inverse, *, plus, adjoint,
/// ad, right_jacobian, right_jacobian_inverse; kDof, Tangent, Jacobian, Point.
#include <placegraph/graph/geometry/se2.h>
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/geometry/sim3.h>
#include <placegraph/graph/geometry/so2.h>
#include <placegraph/graph/geometry/so3.h>
