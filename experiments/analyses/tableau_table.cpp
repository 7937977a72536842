#include "experiments/analyses/tableau_table.h"

#include <fmt/format.h>

#include <limits>

#include "experiments/base/numbers.h"
#include "experiments/tables/environment.h"
#include "experiments/tables/named_cells.h"
#include "irk/tableaus.h"
#include "tableaus/analysis/properties.h"
#include "tableaus/catalogue/source.h"
#include "tableaus/files/file.h"

namespace irk {
namespace {

std::string truth(bool value) { return value ? "1" : "0"; }

NamedCells propertyCells(const Tableau<BigFloat>& tableau, const TableauProperties& properties) {
  const auto& [analysis, kind, quadrature, symmetric, R, stability, spectrum] = properties;
  return {{"method", tableau.id},
          {"family", tableau.family},
          {"stages", std::to_string(tableau.stages())},
          {"kind", std::string(stageKindName(kind))},
          {"order", std::to_string(tableau.order)},
          {"B", std::to_string(analysis.p)},
          {"C", std::to_string(analysis.q)},
          {"D", std::to_string(analysis.r)},
          {"numerator_degree", std::to_string(R.numeratorDegree())},
          {"denominator_degree", std::to_string(R.denominatorDegree())},
          {"order_R", std::to_string(R.order)},
          {"error_constant", numberText(R.error_constant)},
          {"R_infinity", numberText(R.atInfinity())},
          {"a_stable", truth(stability.a_stable)},
          {"l_stable", truth(stability.l_stable)},
          {"alpha_degrees", numberText(stability.alpha)},
          {"real_limit", numberText(stability.real_limit)},
          {"imaginary_limit", numberText(stability.imaginary_limit)},
          {"algebraically_stable", truth(analysis.algebraically_stable)},
          {"stiffly_accurate", truth(analysis.stiffly_accurate)},
          {"symplectic", truth(analysis.symplectic)},
          {"symmetric", truth(symmetric)},
          {"positive_weights", truth(quadrature.positive)},
          {"condition_A",
           numberText(analysis.regular ? 1 / analysis.reciprocal_condition : std::numeric_limits<double>::infinity())},
          {"condition_eigenvectors", numberText(spectrum.eigenvector_condition)},
          {"defective", truth(spectrum.defective)}};
}

void appendRoots(const Tableau<BigFloat>& tableau, const StabilityFunction& R, Table& table) {
  const auto add = [&](const char* root, const std::vector<std::complex<double>>& places) {
    for (const auto& z : places) {
      addRow(table, {{"method", tableau.id},
                     {"family", tableau.family},
                     {"stages", std::to_string(tableau.stages())},
                     {"root", root},
                     {"re", numberText(z.real())},
                     {"im", numberText(z.imag())}});
    }
  };
  add("zero", R.zeros);
  add("pole", R.poles);
}

}  // namespace

TableauTables tableauTables(const std::vector<std::string>& methods) {
  TableauTables tables;
  tables.properties.head = tables.stability.head = environmentHead("tableaus", 1);
  for (const auto& method : methods) {
    const TableauFile file = findTableau(method);
    const auto properties = analyzeProperties(file.tableau, toleranceOfDigits(file.digits));
    addRow(tables.properties, propertyCells(file.tableau, properties));
    appendRoots(file.tableau, properties.R, tables.stability);
  }
  return tables;
}

std::vector<std::string> familyMembers(int most) {
  std::vector<std::string> members;
  for (const auto& family : familyCatalogue()) {
    for (Index s = family.min_stages; s <= most; ++s) {
      members.push_back(fmt::format("{}_{}", family.id, s));
    }
  }
  return members;
}

}  // namespace irk
