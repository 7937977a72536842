// Abbreviations for the tests of core.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "irk/integrator.h"
#include "irk/tableaus.h"
#include "tests/core/problems.h"

namespace irk::test {

inline IntegratorOptions fixedSteps(double h) {
  IntegratorOptions o;
  o.step.control = StepControl::kFixed;
  o.step.h = h;
  return o;
}

inline IntegratorOptions adaptive(double tol) {
  IntegratorOptions o;
  o.tolerances.rtol = o.tolerances.atol = tol;
  return o;
}

inline IntegratorOptions embedded(double tol) {
  IntegratorOptions o = adaptive(tol);
  o.step.estimate = ErrorEstimate::kEmbedded;
  return o;
}

inline IntegratorOptions variable(double tol) {
  IntegratorOptions o = embedded(tol);
  o.order = OrderControl::kVariable;
  return o;
}

template <class Real, class P>
Solution<Real> integrate(P problem, const State<Real>& start, double t_end, const Tableau<Real>& tableau,
                         const IntegratorOptions& options, Formulation formulation = Formulation::kIndex2) {
  Integrator<Real> integrator(makeSystem<Real>(problem, {formulation}), tableau, options);
  return integrator.integrate(start, Real(t_end));
}

/// Least-squares slope of log(error) over log(h).
inline double slope(const std::vector<double>& h, const std::vector<double>& error) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const double n = static_cast<double>(h.size());
  for (std::size_t i = 0; i < h.size(); ++i) {
    const double x = std::log(h[i]), y = std::log(error[i]);
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// The observed order: the slope of an error that is computed for each step size.
template <class ErrorOf>
double orderOf(const std::vector<double>& h, const ErrorOf& error_of) {
  std::vector<double> errors;
  for (const double step : h) errors.push_back(error_of(step));
  return slope(h, errors);
}

/// The orders of several errors, which `errors_of` returns together, always in the same number.
template <class ErrorsOf>
std::vector<double> ordersOf(const std::vector<double>& h, const ErrorsOf& errors_of) {
  std::vector<std::vector<double>> errors;
  for (const double step : h) errors.push_back(errors_of(step));
  std::vector<double> orders;
  for (std::size_t i = 0; i < errors.front().size(); ++i) {
    std::size_t step = 0;
    orders.push_back(orderOf(h, [&](double) { return errors[step++][i]; }));
  }
  return orders;
}

}  // namespace irk::test
