#include <fmt/format.h>
#include <fmt/ostream.h>

#include "experiments/analyses/tableau_table.h"
#include "experiments/commands/commands.h"
#include "experiments/report/figure_path.h"
#include "experiments/report/report.h"
#include "experiments/tables/environment.h"
#include "tableaus/catalogue/report.h"

namespace irk {

int tableauShow(const std::string& id_or_file, int digits, Streams streams) {
  streams.out << showTableau(id_or_file, digits);
  return 0;
}

int tableauCheck(const std::string& id_or_file, Streams streams) {
  const TableauReport report = checkTableau(id_or_file);
  streams.out << report.text;
  return report.ok ? 0 : 1;
}

int tableauExport(const std::string& id_or_file, const std::string& format, Streams streams) {
  streams.out << exportTableau(id_or_file, format);
  return 0;
}

int tableauPlot(const std::vector<std::string>& methods, const std::string& figure, Streams streams) {
  const auto home = homeFolder();
  const std::string out = figurePath("--out", figure).string();
  const std::string table = out + ".csv";
  writeTable(table, tableauTables(methods).stability);
  const auto commands = fmt::format("table='{}'; out='{}'; views='region star'", table, out);
  if (!drawFigure("stability.gp", commands, home, streams.err)) return 1;
  fmt::print(streams.out, "{0}.svg, {0}.png, {0}.csv\n", out);
  return 0;
}

int tableauTable(const std::string& results, Streams streams) {
  constexpr int kMaxShownStages = 20;
  const auto folder = std::filesystem::path(results) / "tableaus";
  const TableauTables tables = tableauTables(familyMembers(kMaxShownStages));
  writeTable(folder / "tableaus.csv", tables.properties);
  writeTable(folder / "stability.csv", tables.stability);
  fmt::print(streams.out, "tableaus: {} methods in {}\n", tables.properties.rows.size(), folder.string());
  return 0;
}

}  // namespace irk
