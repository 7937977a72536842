#include "experiments/report/explorer/spilled_text.h"

#include <algorithm>
#include <ostream>

namespace irk {

void SpilledText::append(std::string_view text) {
  held_ += text;
  if (held_.size() < kHeld) return;
  if (!file_) file_ = std::make_unique<store::SpillFile>();
  file_->write(held_.data(), held_.size(), in_file_);
  in_file_ += held_.size();
  held_.clear();
}

void SpilledText::write(std::ostream& out) const {
  std::string block;
  for (std::uint64_t at = 0; at < in_file_; at += block.size()) {
    block.resize(std::min<std::uint64_t>(kHeld, in_file_ - at));
    file_->read(block.data(), block.size(), at);
    out << block;
  }
  out << held_;
}

}  // namespace irk
