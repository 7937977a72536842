# Packages of the program: a tarball that runs where it is unpacked, and a Debian package.
#   cmake --workflow --preset package      writes build/package/irkbench-VERSION-Linux-x86_64.tar.gz and .deb
# Both are for any x86-64 processor. The tarball has the shared libraries that the program needs besides those of the
# compiler and of the C library, in lib/irk; the Debian package depends on packages instead.
set(CPACK_GENERATOR TGZ DEB)
set(CPACK_PACKAGE_NAME irkbench)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGE_CONTACT "irkbench authors")
set(CPACK_PACKAGE_FILE_NAME irkbench-${PROJECT_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR})
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_LIST_DIR}/generator.cmake)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Figures need gnuplot, files of users a compiler and the headers that theirs include, the explorer d3.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox, g++, libeigen3-dev, libboost-dev, node-d3")

# A library in lib/irk needs others there: the program's old kind of path serves them, too.
set_target_properties(irk PROPERTIES INSTALL_RPATH "$ORIGIN/../lib/irk")
target_link_options(irk PRIVATE LINKER:--disable-new-dtags)
install(TARGETS irk RUNTIME_DEPENDENCY_SET irk_shared RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(RUNTIME_DEPENDENCY_SET irk_shared
        PRE_EXCLUDE_REGEXES "^lib(c|m|mvec|dl|pthread|rt|gcc_s|stdc\\+\\+)\\.so" "^ld-linux"
        LIBRARY DESTINATION lib/irk COMPONENT bundled)

# The terms of these libraries, as Debian states them.
foreach(library mpfr gmp gsl sundials klu amd colamd btf suitesparseconfig fmt benchmark tomlplusplus sqlite3 gomp)
  file(GLOB copyrights /usr/share/doc/lib${library}*/copyright)
  foreach(copyright IN LISTS copyrights)
    get_filename_component(package ${copyright} DIRECTORY)
    get_filename_component(package ${package} NAME)
    if(NOT package MATCHES "-dev$")
      install(FILES ${copyright} DESTINATION ${CMAKE_INSTALL_DOCDIR}/copyright RENAME ${package} COMPONENT bundled)
    endif()
  endforeach()
endforeach()
include(CPack)
