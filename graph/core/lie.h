#pragma once
/// The five groups, all with one interface: exp, log, inverse, *, plus, adjoint, ad,
/// right_jacobian, right_jacobian_inverse; kDof, Tangent, Jacobian, Point.
#include <placegraph/graph/core/se2.h>
#include <placegraph/graph/core/se3.h>
#include <placegraph/graph/core/sim3.h>
#include <placegraph/graph/core/so2.h>
#include <placegraph/graph/core/so3.h>
