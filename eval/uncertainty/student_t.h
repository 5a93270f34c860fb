#pragma once

namespace placegraph {

/// P(t > x) for a variable of Student's distribution with `dof` > 0 real degrees of freedom.
double student_t_tail(double x, double dof);

/// The x that Student's t stays below with `probability` in (0, 1); `dof` > 0 may be no integer.
double student_t_quantile(double probability, double dof);

}  // namespace placegraph
