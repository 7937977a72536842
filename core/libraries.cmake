# Defines targets for libraries that have no CMake package: irk_klu for KLU of SuiteSparse, irk_mpfr for MPFR. This file
# is also installed, since users of the library need it, too.
find_path(KLU_INCLUDE_DIR klu.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(KLU_LIBRARY klu REQUIRED)
find_path(MPFR_INCLUDE_DIR mpfr.h REQUIRED)
find_library(MPFR_LIBRARY mpfr REQUIRED)
foreach(library KLU MPFR)
  string(TOLOWER irk_${library} target)
  if(NOT TARGET ${target})
    add_library(${target} UNKNOWN IMPORTED)
    set_target_properties(${target} PROPERTIES IMPORTED_LOCATION ${${library}_LIBRARY}
                          INTERFACE_INCLUDE_DIRECTORIES ${${library}_INCLUDE_DIR})
  endif()
endforeach()
