// Van der Pol's equation, written by hand and given to integrators of other libraries without the suite between: what
// their adapters are compared with. All options are those of the adapters.
#pragma once

#include <cstdint>

namespace irk::direct {

inline constexpr double kEps = 1e-6;
/// y at t = 0, as in the scene van_der_pol.
inline constexpr double kStart[2] = {2, -0.66};

struct Result {
  double y[2];
  std::int64_t steps = 0, evaluations = 0;  ///< evaluations of the right-hand side or of the residual
};

/// Each makes the library's objects, integrates from 0 to t_end with rtol = atol = tol, and frees them. They throw
/// std::runtime_error if the library reports a failure.
Result cvode(double t_end, double tol);
Result ida(double t_end, double tol);
/// The functions of fortran_codes.c. `code` is the address of radau_ or radau5_; `h` the first step, `max_steps` as in
/// IWORK(2).
Result radau(void (*code)(), double t_end, double tol, double h, int max_steps);

/// The right-hand side and its Jacobian by columns.
void rates(double t, const double* y, double* f);
void jacobian(double t, const double* y, double* J);

}  // namespace irk::direct
