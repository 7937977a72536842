// A scene behind irk/scene_c.h as a problem struct (irk/problem.h), over double and its dual numbers.
#pragma once

#include <boost/container/small_vector.hpp>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "experiments/own/foreign/foreign_model.h"
#include "irk/problem_system.h"

namespace irk::own {

template <class T>
using Few = boost::container::small_vector<T, 32>;

/// The numbers of a point in the layout of PointLayout; those of a dual point without its derivatives.
template <class T>
Few<double> packed(const PointLayout& layout, const Point<T>& p) {
  Few<double> all;
  all.reserve(layout.size());
  all.push_back(valueOf(p.t));
  for (const auto* part : {&p.u, &p.v, &p.x, &p.z, &p.a, &p.k}) {
    for (Index i = 0; i < part->size(); ++i) all.push_back(valueOf((*part)[i]));
  }
  return all;
}

/// The derivatives of a dual point along one of its directions, in the same layout. Returns whether any differs from 0.
inline bool packDirection(const Point<Dual<double>>& p, std::size_t direction, Few<double>& all) {
  all.clear();
  all.push_back(p.t.d[direction]);
  for (const auto* part : {&p.u, &p.v, &p.x, &p.z, &p.a, &p.k}) {
    for (Index i = 0; i < part->size(); ++i) all.push_back((*part)[i].d[direction]);
  }
  for (const double x : all) {
    if (x != 0) return true;
  }
  return false;
}

template <class T>
Few<double> valuesOf(const ConstVec<T>& numbers) {
  Few<double> all;
  for (Index i = 0; i < numbers.size(); ++i) all.push_back(valueOf(numbers[i]));
  return all;
}

/// The argument of constraints, which ProblemSystem gives with its time derivatives, at which level: g, dg/dt, d2g/dt2.
template <class T>
struct AtLevel {
  static constexpr int kLevel = 0;
  using Inner = T;
  static const Inner& position(const T& x) { return x; }
};
template <class T>
struct AtLevel<Rate<T>> {
  static constexpr int kLevel = 1;
  using Inner = T;
  static const Inner& position(const Rate<T>& x) { return x.value; }
  static const Inner& velocity(const Rate<T>& x) { return x.d[0]; }
};
template <class T>
struct AtLevel<Rate<Rate<T>>> {
  static constexpr int kLevel = 2;
  using Inner = T;
  static const Inner& position(const Rate<Rate<T>>& x) { return x.value.value; }
  static const Inner& velocity(const Rate<Rate<T>>& x) { return x.value.d[0]; }
  static const Inner& acceleration(const Rate<Rate<T>>& x) { return x.d[0].d[0]; }
};

/// kIndex: of the algebraic unknowns that are no multipliers.
template <int kIndex>
struct ForeignProblem {
  static constexpr int kAlgebraicIndex = kIndex;

  std::shared_ptr<const ForeignModel> model;

  Sizes sizes() const { return model->sizes(); }

  void residual(const Point<double>& p, Rows<double> r) const {
    const auto point = packed(model->layout(), p);
    Few<double> rows(model->rows(), std::numeric_limits<double>::quiet_NaN());  // a row that is left out fails the step
    model->evaluate(point.data(), p.d.data(), rows.data());
    distribute(r, [&](std::size_t i) { return rows[i]; });
  }
  void residual(const Point<Dual<double>>& p, Rows<Dual<double>> r) const {
    const auto point = packed(model->layout(), p);
    const auto d = valuesOf(p.d);
    Few<Dual<double>> rows(model->rows());
    Few<double> values(model->rows()), direction;
    model->evaluate(point.data(), d.data(), values.data());
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = values[i];
    for (std::size_t c = 0; c < kChunk; ++c) {
      if (!packDirection(p, c, direction)) continue;
      model->differentiate(point.data(), d.data(), direction.data(), values.data());
      for (std::size_t i = 0; i < rows.size(); ++i) rows[i].d[c] = values[i];
    }
    distribute(r, [&](std::size_t i) -> const Dual<double>& { return rows[i]; });
  }

  /// u: anything with an index, as ProblemSystem passes it. Not for plain vectors, which only GGL uses.
  template <class T, class U, class G>
  requires(!std::is_same_v<U, Vec<double>>) void constraints(const T& t, const U& u, G&& g) const {
    using At = AtLevel<T>;
    using Inner = typename At::Inner;
    const Sizes& n = model->sizes();
    const auto nu = static_cast<std::size_t>(n.nu), y = static_cast<std::size_t>(n.components());
    Few<Inner> point(model->layout().size(), Inner(0));
    point[0] = At::position(t);
    for (std::size_t i = 0; i < nu; ++i) {
      const auto& at = u[static_cast<Index>(i)];
      point[1 + i] = At::position(at);
      if constexpr (At::kLevel > 0) point[1 + nu + i] = At::velocity(at);
      if constexpr (At::kLevel > 1) point[1 + y + i] = At::acceleration(at);
    }
    Few<Inner> values(static_cast<std::size_t>(n.constraints));
    constraintValues(At::kLevel, point, values);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const Inner& value = values[k];
      const auto at = static_cast<Index>(k);
      if constexpr (At::kLevel == 0) {
        g[at] = value;
      } else if constexpr (At::kLevel == 1) {
        g[at] = Rate<Inner>(Inner(0), value);
      } else {
        g[at] = Rate<Rate<Inner>>(Rate<Inner>(Inner(0), Inner(0)), Rate<Inner>(Inner(0), value));
      }
    }
  }

  template <class T>
  void switching(const Point<T>& p, T* g) const {
    if (model->sizes().switches == 0) return;
    const auto point = packed(model->layout(), p);
    const auto d = valuesOf(p.d);
    Few<double> values(static_cast<std::size_t>(model->sizes().switches));
    switchingAt(point.data(), d.data(), values.data());
    for (std::size_t i = 0; i < values.size(); ++i) g[i] = T(values[i]);
  }
  template <class T>
  void onSwitch(Index i, const Point<T>& p, T* d) const {
    changeDiscrete(i, p, d, model->functions().on_switch, "irk_scene_on_switch");
  }
  std::vector<double> times() const;
  template <class T>
  void onTime(Index i, const Point<T>& p, T* d) const {
    if (model->functions().on_time) changeDiscrete(i, p, d, model->functions().on_time, "irk_scene_on_time");
  }
  void jumpAtTime(Index i, const Point<double>& p, double* u, double* v, double* x) const;
  bool completesSteps() const { return model->functions().complete_step != nullptr; }
  bool completeStep(const Point<double>& p, double* u, double* v, double* x, double* d) const;
  std::string switchName(Index i) const;

 protected:
  using Jump = void(void*, int, double, double*, const double*);
  /// Sets u, v and x to what `jump`, the scene's function `name`, makes of those of p.
  void moveTo(Jump* jump, const char* name, Index i, const Point<double>& p, double* u, double* v, double* x) const;

  using Change = void(void*, int, double, const double*, const double*, double*);

  template <class Row, class Value>
  void distribute(Row& r, const Value& value) const {
    std::size_t i = 0;
    for (auto* part : {&r.u, &r.x, &r.z}) {
      for (Index j = 0; j < part->size(); ++j) (*part)[j] = value(i++);
    }
  }
  void constraintValues(int level, const Few<double>& point, Few<double>& g) const {
    model->constraints(level, point.data(), g.data());
  }
  void constraintValues(int level, const Few<Dual<double>>& point, Few<Dual<double>>& g) const {
    Few<double> at, direction(point.size()), values(g.size());
    for (const auto& x : point) at.push_back(x.value);
    model->constraints(level, at.data(), values.data());
    for (std::size_t k = 0; k < g.size(); ++k) g[k] = values[k];
    for (std::size_t c = 0; c < kChunk; ++c) {
      bool moves = false;
      for (std::size_t i = 0; i < point.size(); ++i) moves = (direction[i] = point[i].d[c]) != 0 || moves;
      if (!moves) continue;
      model->differentiateConstraints(level, at.data(), direction.data(), values.data());
      for (std::size_t k = 0; k < g.size(); ++k) g[k].d[c] = values[k];
    }
  }
  void switchingAt(const double* point, const double* d, double* g) const;
  template <class T>
  void changeDiscrete(Index i, const Point<T>& p, T* d, Change* change, const char* name) const {
    const auto point = packed(model->layout(), p);
    Few<double> values = valuesOf(p.d);
    discreteAfter(i, point.data(), values, change, name);
    for (std::size_t j = 0; j < values.size(); ++j) d[j] = T(values[j]);
  }
  void discreteAfter(Index i, const double* point, Few<double>& d, Change* change, const char* name) const;
};

/// One whose state jumps at switches.
template <int kIndex>
struct JumpingForeignProblem : ForeignProblem<kIndex> {
  void jump(Index i, const Point<double>& p, double* u, double* v, double* x) const;
};

/// The system in the formulation that the options name. Throws Misuse for those that such a scene does not have.
std::shared_ptr<const System<double>> makeForeignSystem(const std::shared_ptr<const ForeignModel>& model,
                                                        const SystemOptions& options);

}  // namespace irk::own
