// The Newton methods that come with the library.
#include "core/newton/newton.h"
#include "core/options/entries.h"
#include "irk/multiprecision.h"

namespace irk {

IRK_STRATEGIES(NewtonKind, "newton")

IRK_CATALOGUE(NewtonKind, simplifiedNewton(), broydenNewton(), modifiedNewton(), modifiedOnlyNewton(),
              paperRuleNewton(), fullNewton(), modifiedNewtonEachStep(), modifiedNewtonAtStepChange(),
              broydenNewtonEachStep(), broydenNewtonAtStepChange())

template <class Real>
std::unique_ptr<Newton<Real>> makeNewton(const IntegratorOptions& options, const Sizes& sizes,
                                         const Scheme<Real>& scheme) {
  const NewtonKind kind = options.newton.kind;
  return madeBy(catalogue<NewtonKind>()[kind].make.template of<Real>(), kind, options, sizes, scheme);
}

template std::unique_ptr<Newton<double>> makeNewton(const IntegratorOptions&, const Sizes&, const Scheme<double>&);
template std::unique_ptr<Newton<BigFloat>> makeNewton(const IntegratorOptions&, const Sizes&, const Scheme<BigFloat>&);

}  // namespace irk
