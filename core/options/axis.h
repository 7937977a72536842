// Axes without behaviour: an enum, or another value, with a table of ids. Strategies: core/options/catalogue.h.
#pragma once

#include <span>
#include <string_view>

#include "core/base/text.h"

/// Declares the functions of irk/options.h for the axis E. (options.cpp includes both, so that this file cannot.)
#define IRK_DECLARE_AXIS(E)             \
  template <>                           \
  std::span<const Named<E>> named<E>(); \
  template <>                           \
  std::string_view axisName<E>();       \
  template <>                           \
  E parseId<E>(std::string_view id)

/// Defines them but for parseId. `table`: an array of Named<E>, the default first.
#define IRK_AXIS_IDS(E, table, axis)     \
  template <>                            \
  std::span<const Named<E>> named<E>() { \
    return table;                        \
  }                                      \
  template <>                            \
  std::string_view axisName<E>() {       \
    return axis;                         \
  }

/// Defines all of them.
#define IRK_AXIS(E, table, axis)                             \
  IRK_AXIS_IDS(E, table, axis)                               \
  template <>                                                \
  E parseId<E>(std::string_view id) {                        \
    return entryNamed(axis, id, table, &Named<E>::id).value; \
  }
