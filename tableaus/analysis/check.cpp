#include "tableaus/analysis/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tableaus/analysis/properties.h"
#include "tableaus/analysis/rooted_trees.h"
#include "tableaus/families/families.h"
#include "tableaus/families/precise.h"

namespace irk {

using tableaus::Finding;
using tableaus::Place;
using tableaus::Verdict;

namespace {

struct Subject {
  const Tableau<BigFloat>& tableau;
  const TableauAnalysis& analysis;
};

using Findings = std::vector<Finding>;
using Check = void (*)(const Subject&, Findings&);

void add(Findings& findings, Verdict verdict, Place place, std::string name, std::string text) {
  findings.push_back({verdict, place, 0, std::move(name), std::move(text)});
}

void checkWeights(const Subject& subject, Findings& findings) {
  const double residual = subject.analysis.residuals.B[0];
  const bool holds = residual <= subject.analysis.tolerance;
  add(findings, holds ? Verdict::kHolds : Verdict::kContradiction, Place::kWeights, "sum of b",
      holds ? "the sum of b is 1"
            : fmt::format("not consistent: the sum of b is {:.6g} and differs from 1 by {:.3g}",
                          static_cast<double>(subject.tableau.b.sum()),
                          static_cast<double>(abs(subject.tableau.b.sum() - 1))));
}

void checkRowSums(const Subject& subject, Findings& findings) {
  if (subject.tableau.stage_order < 1) {
    add(findings, Verdict::kNote, Place::kStageOrder, "row sums",
        "stage order 0 is declared: row sums of A need not equal c");
    return;
  }
  if (subject.analysis.q >= 1) {
    add(findings, Verdict::kHolds, Place::kStageOrder, "row sums", "every row sum of A equals its node c");
    return;
  }
  Index row = 0;
  const double error = subject.analysis.row_sum_errors.maxCoeff(&row);
  findings.push_back({Verdict::kContradiction, Place::kRow, row, "row sums",
                      fmt::format("row {} of A does not sum up to c_{} = {}: it is off by {:.3g}", row + 1, row + 1,
                                  static_cast<double>(subject.tableau.c[row]), error)});
}

// B(p) is necessary for order p, because quadrature is a special differential equation.
void checkConditions(const Subject& subject, Findings& findings) {
  const auto& residuals = subject.analysis.residuals;
  const Index s = subject.tableau.stages();
  const auto check = [&](Place place, const char* condition, std::string_view order, int declared, Index least,
                         Index most, int holds, const Vec<double>& of) {
    if (declared < least || declared > most) {
      add(findings, Verdict::kContradiction, place, condition,
          fmt::format("{} {} is impossible: with {} stages it is {} to {}", order, declared, s, least, most));
    } else if (declared > holds) {
      add(findings, Verdict::kContradiction, place, condition,
          fmt::format("{} {} is contradicted by {}({}), whose residual is {:.3g}", order, declared, condition,
                      holds + 1, of[holds]));
    } else {
      add(findings, Verdict::kHolds, place, condition, fmt::format("{}({}) holds", condition, declared));
    }
  };
  check(Place::kOrder, "B", "order", subject.tableau.order, 1, 2 * s, subject.analysis.p, residuals.B);
  check(Place::kStageOrder, "C", "stage order", subject.tableau.stage_order, 0, s, subject.analysis.q, residuals.C);
}

/// Largest |x - y| / max(1, |y|).
double distance(const Mat<BigFloat>& x, const Mat<BigFloat>& y) {
  const Mat<BigFloat> magnitude = y.cwiseAbs().cwiseMax(BigFloat(1));
  return static_cast<double>((x - y).cwiseAbs().cwiseQuotient(magnitude).maxCoeff());
}

// Lobatto IIIC, IIIC* and IIID satisfy the same B, C and D; only their coefficients distinguish them.
void checkFamilyMember(const Subject& subject, const Family& family, Findings& findings) {
  const auto& tableau = subject.tableau;  // no structured binding: clang 14 captures none
  const auto& analysis = subject.analysis;
  const SimplifyingOrders orders = family.orders(tableau.stages());
  const auto contradict = [&](Place place, const std::string& text) {
    add(findings, Verdict::kContradiction, place, "family", text);
  };
  const auto declares = [&](Place place, std::string_view what, int declared, int theory) {
    if (declared == theory) return;
    contradict(place, fmt::format("{} {} is declared, but {} with {} stages has {}", what, declared, family.title,
                                  tableau.stages(), theory));
  };
  declares(Place::kOrder, "order", tableau.order, orders.p);
  declares(Place::kStageOrder, "stage order", tableau.stage_order, orders.q);
  const auto requires_at_least = [&](std::string_view condition, int holds, int theory) {
    if (holds >= theory) return;
    contradict(Place::kFamily,
               fmt::format("{0} has {1}({2}), but here {1}({3}) fails", family.title, condition, theory, holds + 1));
  };
  requires_at_least("B", analysis.p, orders.p);
  requires_at_least("C", analysis.q, orders.q);
  requires_at_least("D", analysis.r, orders.r);

  const Tableau<BigFloat> expected = constructFamily(family, tableau.stages());
  const double error =
      std::max({distance(tableau.A, expected.A), distance(tableau.b, expected.b), distance(tableau.c, expected.c)});
  if (error <= analysis.tolerance) {
    add(findings, Verdict::kHolds, Place::kFamily, "family",
        fmt::format("coefficients are those of {}: B({}), C({}), D({})", family.title, orders.p, orders.q, orders.r));
  } else {
    contradict(Place::kFamily,
               fmt::format("coefficients differ from those of {} by up to {:.3g}", family.title, error));
  }
}

void checkFamily(const Subject& subject, Findings& findings) {
  const Family* family = findFamily(subject.tableau.family);
  const Index s = subject.tableau.stages();
  if (family == nullptr) {
    add(findings, Verdict::kNote, Place::kFamily, "family",
        fmt::format("'{}' is not one of the suite's families: only its coefficients are checked",
                    subject.tableau.family));
  } else if (s < family->minStages() || s > kMaxStages) {
    add(findings, Verdict::kContradiction, Place::kFamily, "family",
        fmt::format("{} has {} to {} stages, not {}", family->title, family->minStages(), kMaxStages, s));
  } else {
    checkFamilyMember(subject, *family, findings);
  }
}

void checkProof(const Subject& subject, Findings& findings) {
  const auto& [tableau, analysis] = subject;
  const int declared = tableau.order;
  if (declared > analysis.p) return;                             // checkConditions reports this contradiction
  const bool of_family = findFamily(tableau.family) != nullptr;  // its order is known from theory
  if (declared > analysis.proven_order) {
    add(findings, Verdict::kUnproven, Place::kOrder, "order",
        fmt::format("order {} is not proven: B, C, D prove order {} only; it may be true", declared,
                    analysis.proven_order));
  } else if (declared == analysis.proven_order || of_family) {
    add(findings, Verdict::kHolds, Place::kOrder, "order", fmt::format("order {} is proven by B, C, D", declared));
  } else {
    add(findings, Verdict::kNote, Place::kOrder, "order",
        fmt::format("order {} is declared, but B, C, D prove order {} within the tolerance", declared,
                    analysis.proven_order));
  }
}

std::string residualsText(const Vec<double>& residuals) {
  std::string text = "worst residual per order:";
  for (const double residual : residuals) text += fmt::format(" {:.1e}", residual);
  return text;
}

// Rooted trees give necessary and sufficient conditions (B, C, D only sufficient ones), up to the largest trees.
void checkTrees(const Subject& subject, Findings& findings) {
  const int declared = subject.tableau.order;
  const auto [order, residuals] = treeConditions(subject.tableau, subject.analysis);
  const std::string numbers = residualsText(residuals);
  if (order == kMaxTreeOrder) {
    add(findings, Verdict::kHolds, Place::kOrder, "trees",
        fmt::format("the conditions of all rooted trees hold up to order {}, the largest that is checked"
                    "; {}",
                    order, numbers));
  } else if (declared > order) {
    add(findings, Verdict::kContradiction, Place::kOrder, "trees",
        fmt::format("order {} is contradicted by a rooted tree of order {}: the order is {}; {}", declared, order + 1,
                    order, numbers));
  } else {
    add(findings, declared == order ? Verdict::kHolds : Verdict::kNote, Place::kOrder, "trees",
        fmt::format("by the conditions of all rooted trees the order is {}; {}", order, numbers));
  }
}

std::string atInfinityText(const Tableau<BigFloat>& hat, double tolerance) {
  if (hat.stages() > kMaxAnalyzedStages) return "";
  const double limit = stabilityFunction(hat, tolerance).atInfinity();
  return fmt::format("; R_hat(inf) = {:.6g}", limit) +
         (std::isinf(limit) ? ", unbounded for stiff components: estimates need their filter" : "");
}

// Embedded weights are a method of their own in the same stages.
void checkEmbedded(const Subject& subject, Findings& findings) {
  const auto& [tableau, analysis] = subject;
  if (tableau.b_hat.size() == 0) return;
  const auto contradict = [&](Place place, const std::string& text) {
    add(findings, Verdict::kContradiction, place, "b_hat", text);
  };
  if ((tableau.b_hat - tableau.b).cwiseAbs().maxCoeff() <= analysis.tolerance) {
    return contradict(Place::kWeightsHat, "b_hat equals b: the difference of their results is no estimate");
  }
  const BigFloat sum = tableau.b_hat.sum();
  if (abs(sum - 1) > analysis.tolerance) {
    return contradict(Place::kWeightsHat,
                      fmt::format("not consistent: the sum of b_hat is {:.6g}", static_cast<double>(sum)));
  }
  Tableau<BigFloat> hat = tableau;
  hat.b = tableau.b_hat;
  hat.order = tableau.order_hat;
  const auto [order, residuals] = treeConditions(hat, analyzeTableau(hat, analysis.tolerance));
  const std::string numbers = residualsText(residuals) + atInfinityText(hat, analysis.tolerance);
  if (hat.order > order && order < kMaxTreeOrder) {
    return contradict(Place::kOrderHat, fmt::format("order_hat {} is contradicted by a rooted tree: it is {}; {}",
                                                    hat.order, order, numbers));
  }
  add(findings, hat.order == order ? Verdict::kHolds : Verdict::kNote, Place::kOrderHat, "b_hat",
      fmt::format("b_hat: the sum is 1, by all rooted trees the order is {}; {}", order, numbers));
}

// In the order of printing. A file is refused because of its first contradiction.
constexpr Check kChecks[] = {checkWeights, checkRowSums, checkConditions, checkFamily,
                             checkProof,   checkTrees,   checkEmbedded};

std::string_view verdictName(Verdict verdict) {
  switch (verdict) {
    case Verdict::kHolds:
      return "ok";
    case Verdict::kNote:
      return "note";
    case Verdict::kUnproven:
      return "unproven";
    case Verdict::kContradiction:
      return "WRONG";
  }
  return "";
}

std::string analysisText(const TableauAnalysis& analysis) {
  const auto condition = [&](char name, const Vec<double>& residuals, int holds) {
    std::string text = fmt::format("  {}({})", name, holds);
    text += holds == 0 ? "" : fmt::format(", residual {:.2g}", residuals.head(holds).maxCoeff());
    text += holds == residuals.size() ? "" : fmt::format("; {}({}) fails by {:.2g}", name, holds + 1, residuals[holds]);
    return text + "\n";
  };
  return condition('B', analysis.residuals.B, analysis.p) + condition('C', analysis.residuals.C, analysis.q) +
         condition('D', analysis.residuals.D, analysis.r);
}

std::string reportText(const Tableau<BigFloat>& tableau, const TableauReport& report) {
  std::string text = fmt::format("{}: family {}, {} stages, order {}, stage order {}\n", tableau.id, tableau.family,
                                 tableau.stages(), tableau.order, tableau.stage_order);
  text += analysisText(report.analysis);
  for (const Finding& finding : report.findings) {
    text += fmt::format("  {:<9} {}\n", verdictName(finding.verdict), finding.text);
  }
  return text + fmt::format("{}, within a tolerance of {:.1g}\n",
                            report.ok ? "agrees with its declarations" : "CONTRADICTS its declarations",
                            report.analysis.tolerance);
}

}  // namespace

template <class Real>
TableauReport checkTableau(const Tableau<Real>& tableau, double tolerance) {
  const WorkingDigits digits(kAnalysisDigits);
  const Tableau<BigFloat> wide = tableau.template cast<BigFloat>();
  TableauReport report{tableau.id, analyzeTableau(wide, tolerance), {}, true, ""};
  for (const Check check : kChecks) check({wide, report.analysis}, report.findings);
  report.ok = std::ranges::find(report.findings, Verdict::kContradiction, &Finding::verdict) == report.findings.end();
  report.text = reportText(wide, report);
  return report;
}

template TableauReport checkTableau(const Tableau<double>&, double);
template TableauReport checkTableau(const Tableau<BigFloat>&, double);

}  // namespace irk
