#include "experiments/runs/final_states.h"

#include <sstream>
#include <vector>

#include "experiments/base/numbers.h"

namespace irk {

Vec<double> componentsOf(const RunRecord& record) {
  Vec<double> y(record.u.size() + record.v.size() + record.x.size() + record.z.size());
  y << record.u, record.v, record.x, record.z;
  return y;
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
