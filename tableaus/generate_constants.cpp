// Writes the table of tableaus/catalogue/constants.h as C++ into the file that the argument names. The build runs it.
#include <fmt/format.h>
#include <fmt/os.h>

#include "tableaus/catalogue/constants.h"

namespace {

// With enough digits to read back exactly the same number.
void write(fmt::ostream& out, const auto& numbers) {
  for (const double number : numbers) out.print("{:a},", number);
  out.print("\n");
}

}  // namespace

int main(int count, char** arguments) {
  using namespace irk;
  if (count != 2) return 2;
  auto out = fmt::output_file(arguments[1]);
  out.print(
      "#include \"tableaus/catalogue/constants.h\"\n\nnamespace irk::detail {{\nconst double kConstants[] = {{\n");
  for (const Family& family : families()) {
    for (Index s = family.minStages(); s <= kConstantStages; ++s) {
      const Tableau<double> tableau = constructFamily(family, s).cast<double>();
      out.print("// {}\n", tableau.id);
      for (Index i = 0; i < s; ++i) write(out, tableau.A.row(i));
      write(out, tableau.b);
      write(out, tableau.c);
    }
  }
  out.print("}};\n}}  // namespace irk::detail\n");
  return 0;
}
