// The Newton methods that come with the library.
#include "core/newton/residual_newton.h"
#include "core/newton/simplified_newton.h"
#include "core/newton/step_reuse.h"
#include "irk/multiprecision.h"

namespace irk {

IRK_STRATEGIES(NewtonKind, "newton")

template <>
Catalogue<NewtonKind>& catalogue<NewtonKind>() {
  static Catalogue<NewtonKind> all([] {
    std::vector<Strategy<NewtonKind>> entries{simplifiedNewton(),   broydenNewton(),   modifiedNewton(),
                                              modifiedOnlyNewton(), paperRuleNewton(), fullNewton()};
    for (auto& entry : newtonWithReuseByStep()) entries.push_back(std::move(entry));
    return entries;
  }());
  return all;
}

template <class Real>
std::unique_ptr<Newton<Real>> makeNewton(const IntegratorOptions& options, const Sizes& sizes,
                                         const Scheme<Real>& scheme) {
  return catalogue<NewtonKind>()[options.newton.kind].make.template of<Real>()(options, sizes, scheme);
}

template std::unique_ptr<Newton<double>> makeNewton(const IntegratorOptions&, const Sizes&, const Scheme<double>&);
template std::unique_ptr<Newton<mp50>> makeNewton(const IntegratorOptions&, const Sizes&, const Scheme<mp50>&);
template std::unique_ptr<Newton<mp100>> makeNewton(const IntegratorOptions&, const Sizes&, const Scheme<mp100>&);

}  // namespace irk
