// Tables of results for the page.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "experiments/base/html.h"
#include "experiments/tables/table.h"

namespace irk {

/// The table of orders with verdicts; each row has its verdict as HTML class.
HtmlTable ordersHtml(const Table& orders);

/// The table of the families' properties: tableaus.csv.
HtmlTable tableausHtml(const Table& tableaus);

/// The machines and builds of all runs, each once.
class Environments {
 public:
  /// `environments`: environments.csv of the study; `runs` says which of them made its rows.
  void add(const std::string& study, const Table& environments, const Table& runs);
  /// A column per environment; a value that an older table does not have is missing.
  HtmlTable table() const;

 private:
  struct Environment {
    std::vector<std::string> values;  // in the order of kProperties
    std::set<std::string> studies;
  };
  std::vector<Environment> all_;
};

}  // namespace irk
