#include "tableaus/analysis/properties.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "irk/misuse.h"
#include "tableaus/families/precise.h"

namespace irk {
namespace {

StageKind stageKind(const Mat<BigFloat>& A) {
  const Index s = A.rows();
  for (Index i = 0; i < s; ++i) {
    for (Index j = i + 1; j < s; ++j) {
      if (A(i, j) != 0) return StageKind::kFull;
    }
  }
  const auto diagonal = A.diagonal();
  const auto equal = [](const auto& part) { return (part.array() == part[0]).all(); };
  if (diagonal.isZero(0)) return StageKind::kExplicit;
  if (equal(diagonal)) return StageKind::kSinglyDiagonal;
  const bool rest = diagonal[0] == 0 && equal(diagonal.tail(s - 1));
  return rest ? StageKind::kSinglyDiagonalRest : StageKind::kDiagonal;
}

NodesAndWeights nodesAndWeights(const Tableau<BigFloat>& tableau, double tolerance) {
  Vec<BigFloat> c = tableau.c;
  std::ranges::sort(c);
  BigFloat closest = 1;
  for (Index i = 1; i < c.size(); ++i) closest = std::min<BigFloat>(closest, c[i] - c[i - 1]);
  NodesAndWeights result{};
  result.closest = static_cast<double>(closest);
  result.lowest = static_cast<double>(c[0]);
  result.highest = static_cast<double>(c[c.size() - 1]);
  result.smallest_weight = static_cast<double>(tableau.b.minCoeff());
  result.distinct = result.closest > tolerance;
  result.within = result.lowest >= -tolerance && c[c.size() - 1] - 1 <= tolerance;
  result.positive = result.smallest_weight > tolerance;
  return result;
}

/// Searches stage by stage for the permutation of the stages that makes a method its own adjoint. There is a choice
/// only between equal nodes.
class SymmetrySearch {
 public:
  SymmetrySearch(const Tableau<BigFloat>& tableau, double tolerance) : tableau_(tableau), tolerance_(tolerance) {}

  bool found() {
    if (static_cast<Index>(image_.size()) == tableau_.stages()) return true;
    for (Index k = 0; k < tableau_.stages(); ++k) {
      if (std::ranges::find(image_, k) != image_.end()) continue;
      image_.push_back(k);
      if (lastFits() && found()) return true;
      image_.pop_back();
    }
    return false;
  }

 private:
  bool zero(const BigFloat& x) const { return abs(x) <= tolerance_; }

  bool lastFits() const {
    const auto& [A, b, c] = std::tie(tableau_.A, tableau_.b, tableau_.c);
    const Index i = static_cast<Index>(image_.size()) - 1;
    if (!zero(c[i] + c[image(i)] - 1) || !zero(b[i] - b[image(i)])) return false;
    for (Index j = 0; j <= i; ++j) {
      if (!zero(A(image(i), image(j)) + A(i, j) - b[j])) return false;
      if (!zero(A(image(j), image(i)) + A(j, i) - b[i])) return false;
    }
    return true;
  }
  Index image(Index i) const { return image_[static_cast<std::size_t>(i)]; }

  const Tableau<BigFloat>& tableau_;
  double tolerance_;
  std::vector<Index> image_;
};

std::string_view yesNo(bool value) { return value ? "yes" : "no"; }

std::string polynomialText(const Vec<BigFloat>& ascending) {
  std::string text;
  for (Index k = 0; k < ascending.size(); ++k) {
    const auto x = static_cast<double>(ascending[k]);
    if (x == 0) continue;
    text += k == 0 ? "" : x < 0 ? " - " : " + ";
    text += fmt::format("{:.10g}", std::abs(x));
    text += k == 0 ? "" : k == 1 ? " z" : fmt::format(" z^{}", k);
  }
  return text;
}

std::string stabilityFunctionText(const StabilityFunction& R) {
  constexpr Index kLargestShownDegree = 6;
  const Index j = R.numeratorDegree(), k = R.denominatorDegree();
  std::string text = fmt::format("  R(z) = N / D of degrees ({}, {}){}, R(inf) = {:.6g}\n", j, k,
                                 R.isPade() ? ", a Pade approximation" : "", R.atInfinity());
  if (std::max(j, k) <= kLargestShownDegree) {
    text += fmt::format("    N = {}\n    D = {}\n", polynomialText(R.numerator), polynomialText(R.denominator));
  }
  if (R.order_resolved) {
    return text + fmt::format("  order of R {}, error constant: e^z - R(z) = {:.6g} z^{} + ...\n", R.order,
                              R.error_constant, R.order + 1);
  }
  return text + fmt::format("  order of R at least {}; error constant: too small for the digits to resolve\n", R.order);
}

std::string limitText(double limit) {
  return std::isinf(limit) ? "all" : limit == 0 ? "none" : fmt::format("to {:.10g}", limit);
}

std::string stabilityText(const Stability& stability) {
  std::string text =
      fmt::format("  A-stable: {}, L-stable: {}, |R| <= 1 on the imaginary axis: {}", yesNo(stability.a_stable),
                  yesNo(stability.l_stable), limitText(stability.imaginary_limit));
  if (stability.a_stable) return text + '\n';
  text += fmt::format(", on the negative real axis: {}\n", limitText(stability.real_limit));
  if (std::isnan(stability.alpha)) return text + "  not A(alpha)-stable for any alpha\n";
  return text + fmt::format("  A(alpha)-stable with alpha = {:.5f} degrees\n", stability.alpha);
}

std::string spectrumText(const Spectrum& spectrum) {
  const auto real = std::ranges::count_if(spectrum.values, [](const auto& x) { return x.im == 0; });
  std::string text = fmt::format("  eigenvalues of A: {}, {} of them real, ", spectrum.values.size(), real);
  if (spectrum.defective) {
    return text + "repeated and DEFECTIVE: A has no basis of eigenvectors (use Schur's form)\n";
  }
  return text + fmt::format("{}; condition of the unit eigenvectors {:.3g}\n",
                            spectrum.repeated ? "repeated, not defective" : "distinct", spectrum.eigenvector_condition);
}

std::string quadratureText(const NodesAndWeights& x) {
  return fmt::format(
      "  nodes {}, {}; weights {}\n", x.distinct ? "distinct" : "repeated",
      x.within ? "in [0, 1]" : fmt::format("from {:.6g} to {:.6g}, not in [0, 1]", x.lowest, x.highest),
      x.positive ? "positive" : fmt::format("not all positive, the smallest is {:.6g}", x.smallest_weight));
}

}  // namespace

std::string_view stageKindName(StageKind kind) {
  switch (kind) {
    case StageKind::kExplicit:
      return "explicit";
    case StageKind::kSinglyDiagonal:
      return "singly diagonally implicit (SDIRK)";
    case StageKind::kSinglyDiagonalRest:
      return "singly diagonally implicit after an explicit first stage (ESDIRK)";
    case StageKind::kDiagonal:
      return "diagonally implicit (DIRK)";
    case StageKind::kFull:
      return "fully implicit";
  }
  return "";
}

TableauProperties analyzeProperties(const Tableau<BigFloat>& tableau, double tolerance) {
  const WorkingDigits digits(kAnalysisDigits);
  TableauAnalysis analysis = analyzeTableau(tableau, tolerance);
  if (tableau.stages() > kMaxAnalyzedStages) {
    throw Misuse(fmt::format("tableau '{}': {} stages, properties are analysed up to {}", tableau.id, tableau.stages(),
                             kMaxAnalyzedStages));
  }
  StabilityFunction R = stabilityFunction(tableau, tolerance);
  const Stability stability = analyzeStability(R, tolerance);
  return {std::move(analysis),
          stageKind(tableau.A),
          nodesAndWeights(tableau, tolerance),
          SymmetrySearch(tableau, tolerance).found(),
          std::move(R),
          stability,
          spectrum(tableau.A, tolerance)};
}

std::string propertiesText(const TableauProperties& properties) {
  const TableauAnalysis& analysis = properties.analysis;
  return fmt::format("  {}; ", stageKindName(properties.kind)) + quadratureText(properties.quadrature).substr(2) +
         stabilityFunctionText(properties.R) + stabilityText(properties.stability) +
         fmt::format("  algebraically stable: {}, stiffly accurate: {}, symplectic: {}, symmetric: {}\n",
                     yesNo(analysis.algebraically_stable), yesNo(analysis.stiffly_accurate), yesNo(analysis.symplectic),
                     yesNo(properties.symmetric)) +
         fmt::format("  A {}{}{}\n", analysis.regular ? "regular" : "singular",
                     analysis.regular ? fmt::format(", condition {:.3g}", 1 / analysis.reciprocal_condition) : "",
                     analysis.explicit_first_stage ? ", first stage explicit" : "") +
         spectrumText(properties.spectrum);
}

}  // namespace irk
