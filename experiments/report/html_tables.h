// Tables of results for the page.
#pragma once

#include <filesystem>
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

/// The environments that the rows of a runs.csv name. The memory does not grow with the rows.
std::set<std::string> usedEnvironments(const std::filesystem::path& runs);

/// The machines and builds of all runs, each once.
class Environments {
 public:
  /// `environments`: environments.csv of the study; `used`: the keys of those that its rows name (usedEnvironments).
  void add(const std::string& study, const Table& environments, const std::set<std::string>& used);
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
