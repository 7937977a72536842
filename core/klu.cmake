# Defines the target irk_klu for KLU of SuiteSparse; Debian 12 has no CMake package for it. This file is also
# installed, since users of the library need it, too.
find_path(KLU_INCLUDE_DIR klu.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(KLU_LIBRARY klu REQUIRED)
if(NOT TARGET irk_klu)
  add_library(irk_klu UNKNOWN IMPORTED)
  set_target_properties(irk_klu PROPERTIES IMPORTED_LOCATION ${KLU_LIBRARY}
                        INTERFACE_INCLUDE_DIRECTORIES ${KLU_INCLUDE_DIR})
endif()
