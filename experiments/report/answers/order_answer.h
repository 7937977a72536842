// Which order does each component have? Theory as formulas, and the study order as its check.
#pragma once

#include <map>
#include <string>

#include "experiments/claims/result_tables.h"
#include "experiments/report/answers/answer.h"

namespace irk::report {

/// A row per kind of system and component, a column per family: the formula, and how many measured orders agree. The
/// formulas need no runs.
Answer orderAnswer(const claims::ResultTables& tables);

/// How measured orders compare with theory: counts of verdicts of orders.csv, and the largest difference.
struct OrderCheck {
  int agree = 0, differ = 0, not_measurable = 0, no_theory = 0;
  int theorems = 0, theorems_agree = 0;       ///< of those that agree or differ: compared with a theorem
  double worst = 0;                           ///< largest |order - theory| of those that agree or differ
  std::map<int, std::string> differing = {};  ///< by stages, what is measured: `15.54 instead of 15`
};
void add(const Table& orders, const TableRow& row, OrderCheck& check);
OrderCheck checkOf(const Table& orders);
/// `412 of 415 measured orders agree with theory: 300 of 302 with theorems, 112 of 113 with patterns …`
std::string sentenceOf(const OrderCheck& check);

}  // namespace irk::report
