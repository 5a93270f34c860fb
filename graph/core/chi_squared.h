#pragma once

namespace [[gnu::visibility("default")]] placegraph {

// Boost.Math has both functions for real degrees of freedom; integer degrees need only these short
// functions and no further dependency.

/// P(chi2 > x) for a chi-squared variable of `dof` >= 1 degrees of freedom.
/// Closed form of integer degrees (Abramowitz & Stegun 26.4.4, 26.4.5).
double chi_squared_tail(double x, int dof);

/// The x that a chi-squared variable stays below with `probability` in (0, 1).
/// It has `dof` >= 1 degrees of freedom.
double chi_squared_quantile(double probability, int dof);

/// The quantile of chi-squared / dof at `z` standard deviations of the normal distribution.
/// It is for real degrees of freedom from about 4 on and without a largest number (Wilson, Hilferty
/// 1931).
double mean_square_quantile(double z, double dof);

}  // namespace placegraph
