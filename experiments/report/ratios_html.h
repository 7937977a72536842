// The cost of a study's choices relative to their first choice: ratios.csv as a table of the page and as a sentence.
#pragma once

#include <string>

#include "experiments/base/html.h"
#include "experiments/tables/table.h"

namespace irk {

/// One row for each choice on each scene: medians over the methods and the other choices of its block.
HtmlTable ratiosHtml(const Table& ratios);

/// A sentence about the range of the choices' CPU times; empty without times.
std::string ratiosSentence(const Table& ratios);

}  // namespace irk
