// Views for differentiating constraints g(t, u) without storing vectors of derivatives. Internal.
#pragma once

#include "irk/system.h"

namespace irk::detail {

// Arguments u of g(t, u(t)) with their time derivatives: u' = v, and u'' = a.
template <class T>
struct VelocityView {
  const ConstVec<T>& u;
  const ConstVec<T>& v;
  Rate<T> operator[](Index i) const { return {u[i], v[i]}; }
};
template <class T>
struct AccelerationView {
  const ConstVec<T>& u;
  const ConstVec<T>& v;
  const ConstVec<T>& a;
  Rate<Rate<T>> operator[](Index i) const { return {{u[i], v[i]}, {v[i], a[i]}}; }
};

// Results: `g[i] = expression` stores only the wanted derivative, dg_i/dt or d2g_i/dt2.
template <class T>
struct RateSink {
  T& out;
  void operator=(const Rate<T>& g) { out = g.d[0]; }
};
template <class T>
struct SecondRateSink {
  T& out;
  void operator=(const Rate<Rate<T>>& g) { out = g.d[0].d[0]; }
};
template <class Sink, class T>
struct SinkRow {
  T* data;
  Sink operator[](Index i) const { return Sink{data[i]}; }
};

// u with unit directions for components first, first + 1, ..., for derivatives of g with respect to u.
template <class T>
struct DirectionView {
  const ConstVec<T>& u;
  Index first;
  Dual<T> operator[](Index i) const {
    Dual<T> value(u[i]);
    if (i >= first && i < first + static_cast<Index>(kChunk)) {
      value.d[static_cast<std::size_t>(i - first)] = T(1.0);
    }
    return value;
  }
};
// `g[k] = expression` adds mu_k dg_k/du_i to the rows i of the present directions.
template <class T>
struct TransposedSink {
  T* rows;
  Index count;
  const ConstVec<T>& mu;
  struct Row {
    const TransposedSink& sink;
    Index k;
    void operator=(const Dual<T>& g) {
      for (Index c = 0; c < sink.count; ++c) {
        sink.rows[c] += sink.mu[k] * g.d[static_cast<std::size_t>(c)];
      }
    }
  };
  Row operator[](Index k) const { return {*this, k}; }
};

}  // namespace irk::detail
