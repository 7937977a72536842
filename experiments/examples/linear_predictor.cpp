// Start values of Newton's method: the line through the last two stages of the step before.
#include <irk/strategies.h>

namespace {

class LinearPredictor final : public irk::StagePredictor<double> {
 public:
  explicit LinearPredictor(const irk::Scheme<double>& scheme) : scheme_(scheme) {}

  void fill(const irk::StagePolynomial<double>& past, const irk::State<double>& from, const double& h,
            irk::Mat<double>& W) override {
    const irk::Index last = past.W.cols() - 1;
    if (last == 0) {
      W.colwise() = past.W.col(0);
      return;
    }
    const double first_t = past.t + past.scheme->c[last - 1] * past.h, last_t = past.t + past.scheme->c[last] * past.h;
    for (irk::Index i = 0; i < W.cols(); ++i) {
      const double along = (from.t + scheme_.c[i] * h - last_t) / (last_t - first_t);
      W.col(i) = past.W.col(last) + along * (past.W.col(last) - past.W.col(last - 1));
    }
  }

 private:
  const irk::Scheme<double>& scheme_;
};

}  // namespace

IRK_REGISTER {
  irk::registerStrategy<irk::Predictor>(
      {.id = {"linear"},
       .meaning = "the line through the last two stages",
       .make = {[](const irk::Scheme<double>& scheme, double) { return std::make_unique<LinearPredictor>(scheme); },
                {}}});
}
