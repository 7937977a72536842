#include "experiments/runs/final_states.h"

#include <cmath>
#include <sstream>
#include <vector>

#include "experiments/base/numbers.h"

namespace irk {

Vec<double> componentsOf(const RunRecord& record) {
  Vec<double> y(record.u.size() + record.v.size() + record.x.size() + record.z.size());
  y << record.u, record.v, record.x, record.z;
  return y;
}

Vec<double> barsOf(const RunRecord& record) {
  const RunErrorBar& bar = record.error_bar;
  if (std::isnan(bar.tolerances)) return {};
  Vec<double> all(bar.u.size() + bar.v.size() + bar.x.size() + bar.z.size());
  all << bar.u, bar.v, bar.x, bar.z;
  return all;
}

std::string vectorText(const Vec<double>& y) {
  std::string text;
  for (const double value : y) text += (text.empty() ? "" : " ") + numberText(value);
  return text;
}

Vec<double> parseVector(const std::string& text) {
  std::istringstream in(text);
  std::vector<double> numbers;
  for (std::string word; in >> word;) numbers.push_back(cellNumber(word));
  return Eigen::Map<const Vec<double>>(numbers.data(), static_cast<Index>(numbers.size()));
}

}  // namespace irk
