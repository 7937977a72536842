#include "experiments/runs/peers/sundials.h"

#include <algorithm>
#include <stdexcept>

namespace irk::sundials {

Workspace::Workspace(Index n)
    : y_(N_VNew_Serial(n, context_)),
      matrix_(SUNDenseMatrix(n, n, context_)),
      solver_(SUNLinSol_Dense(y_.get(), matrix_.get(), context_)) {
#if SUNDIALS_VERSION_MAJOR >= 7
  const auto keep = [](int, const char*, const char*, const char* text, SUNErrCode, void* to, SUNContext) {
    *static_cast<std::string*>(to) = text ? text : "";
  };
  SUNContext_ClearErrHandlers(context_);
  SUNContext_PushErrHandler(context_, keep, &message_);
#endif
}

N_Vector Workspace::add(const Vec<double>& values) {
  more_.emplace_back(N_VClone(y_.get()));
  std::copy(values.begin(), values.end(), N_VGetArrayPointer(more_.back().get()));
  return more_.back().get();
}

Outcome outcomeOf(int flag) {
  switch (flag) {
    case -1:
      return Outcome::kMaxSteps;
    case -2:  // more accuracy requested than the machine has
    case -3:
      return Outcome::kStepTooSmall;
    case -4:
      return Outcome::kNewtonFailed;
    case -5:
    case -6:
    case -7:
      return Outcome::kSingular;
    default:
      return flag < 0 ? Outcome::kNotFinite : Outcome::kSuccess;
  }
}

void require(int flag, const char* call) {
  if (flag < 0) throw std::runtime_error(std::string(call) + " = " + std::to_string(flag));
}

void keepMessage(int, const char*, const char*, char* text, void* to) { *static_cast<std::string*>(to) = text; }

}  // namespace irk::sundials
