// A run in multiprecision.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "experiments/runs/run.h"
#include "irk/multiprecision.h"

namespace irk {

/// A run whose thread works in the run's own number of digits, while the run is prepared and whenever it is called.
class InDigits final : public PreparedRun {
 public:
  /// `make` prepares the run.
  InDigits(int digits, const auto& make)
      : digits_(digits), run_(inDigits([&]() -> std::unique_ptr<PreparedRun> { return make(); })) {}

  RunRecord execute(const Watch& watch) override {
    return inDigits([&] { return run_->execute(watch); });
  }
  void integrate() override {
    inDigits([&] { run_->integrate(); });
  }
  void setUp() override {
    inDigits([&] { run_->setUp(); });
  }
  void wholeCall() override {
    inDigits([&] { run_->wholeCall(); });
  }
  std::vector<std::string> columns() const override { return run_->columns(); }

 private:
  auto inDigits(const auto& call) const {
    const WorkingDigits digits(digits_);
    return call();
  }

  int digits_;
  std::unique_ptr<PreparedRun> run_;
};

}  // namespace irk
