# The library behind the program, the program `irk`, and the stand-alone kernels.
# Only the peers need SUNDIALS: core, tableaus and problems do not know it.
find_package(SUNDIALS REQUIRED COMPONENTS arkode cvode ida nvecserial sunlinsoldense sunmatrixdense)
irk_library(experiments)
file(GLOB parts CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/experiments/audit/*.cpp
                                  ${CMAKE_SOURCE_DIR}/experiments/commands/*.cpp
                                  ${CMAKE_SOURCE_DIR}/experiments/claims/*.cpp
                                  ${CMAKE_SOURCE_DIR}/experiments/cluster/*.cpp
                                  ${CMAKE_SOURCE_DIR}/experiments/compare/*.cpp
                                  ${CMAKE_SOURCE_DIR}/experiments/peers/*.cpp
                                  ${CMAKE_SOURCE_DIR}/experiments/reference/*.cpp
                                  ${CMAKE_SOURCE_DIR}/experiments/store/*.cpp)
# With an MPI several processes share a study: mpirun -n N irk run STUDY. Without one all else works.
option(IRK_MPI "Use MPI where it is installed" ON)
if(IRK_MPI)
  find_package(MPI COMPONENTS C)
endif()
if(MPI_C_FOUND)
  target_compile_definitions(irk_experiments PRIVATE IRK_HAS_MPI OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
  target_link_libraries(irk_experiments PRIVATE MPI::MPI_C)
else()
  list(FILTER parts EXCLUDE REGEX "mpi_ranks")
endif()
target_sources(irk_experiments PRIVATE ${parts})
target_link_libraries(irk_experiments PUBLIC irk::tableaus irk::problems
                      PRIVATE fmt::fmt GSL::gsl OpenMP::OpenMP_CXX benchmark::benchmark
                              tomlplusplus::tomlplusplus nlohmann_json::nlohmann_json CLI11::CLI11
                              SUNDIALS::arkode SUNDIALS::cvode SUNDIALS::ida SUNDIALS::nvecserial
                              SUNDIALS::sunlinsoldense SUNDIALS::sunmatrixdense)

# The study files travel inside the program.
set(generated ${CMAKE_BINARY_DIR}/experiments)
file(GLOB study_files CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/experiments/studies/*.toml)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${study_files})
set(STUDIES "")
foreach(study_file ${study_files})
  get_filename_component(study_id ${study_file} NAME_WE)
  file(READ ${study_file} study_text)
  string(APPEND STUDIES "    {\"${study_id}\", R\"irk_toml(${study_text})irk_toml\"},\n")
endforeach()
configure_file(experiments/builtin_studies.cpp.in ${generated}/builtin_studies.cpp @ONLY)

string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}}" flags)
if(IRK_NATIVE)
  string(APPEND flags " -march=native")
endif()
add_custom_target(irk_build_info BYPRODUCTS ${generated}/build_info.cpp
  COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${CMAKE_SOURCE_DIR} -DOUT=${generated}/build_info.cpp
          -DVERSION=${PROJECT_VERSION} "-DFLAGS=${flags}"
          "-DCOMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
          -P ${CMAKE_SOURCE_DIR}/experiments/build_info.cmake
  VERBATIM)
target_sources(irk_experiments PRIVATE ${generated}/builtin_studies.cpp
                                       ${generated}/build_info.cpp)
add_dependencies(irk_experiments irk_build_info)

add_executable(irk experiments/main.cpp)
target_link_libraries(irk PRIVATE irk::experiments irk_options)

add_executable(irk_kernels experiments/kernels/stage_solvers.cpp)
target_link_libraries(irk_kernels PRIVATE irk::experiments irk_options benchmark::benchmark)

add_executable(irk_store experiments/kernels/store.cpp)
target_link_libraries(irk_store PRIVATE irk::experiments irk_options benchmark::benchmark fmt::fmt)
