// The list of the strategies of an axis that come with the library.
#pragma once

#include "core/options/catalogue.h"

/// Defines the catalogue of an axis from functions that each return an entry, the default first. Each function is
/// defined in the file of its strategy and declared by this macro only: a new strategy needs its file and its name in
/// the list.
#define IRK_CATALOGUE(Id, ...)               \
  Strategy<Id> __VA_ARGS__;                  \
  template <>                                \
  Catalogue<Id>& catalogue<Id>() {           \
    static Catalogue<Id> all({__VA_ARGS__}); \
    return all;                              \
  }
