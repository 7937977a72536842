// The list of the strategies of an axis that come with the library.
#pragma once

#include "core/options/catalogue.h"

/// Defines the catalogue of an axis by functions that each return an entry, the default first. A function is defined in
/// the file of its strategy, and needs no other declaration: a new strategy is that file and its name here.
#define IRK_CATALOGUE(Id, ...)               \
  Strategy<Id> __VA_ARGS__;                  \
  template <>                                \
  Catalogue<Id>& catalogue<Id>() {           \
    static Catalogue<Id> all({__VA_ARGS__}); \
    return all;                              \
  }
