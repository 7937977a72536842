// Axes without behaviour: an enum, or another value, with a table of ids. Strategies: core/options/catalogue.h.
#pragma once

#include <span>
#include <string_view>

#include "core/base/text.h"

/// Declares named, axisName and parseId for the axis E. A file that uses these macros includes irk/options.h as well:
/// options.cpp, which belongs to that header, uses this one, and the check of rooms allows no circle.
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
