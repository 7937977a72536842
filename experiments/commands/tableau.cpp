#include "experiments/commands/commands.h"
#include "tableaus/report.h"

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

int tableauExport(const std::string& id_or_file, Streams streams) {
  streams.out << exportTableau(id_or_file);
  return 0;
}

}  // namespace irk
