# Run at build time: writes OUT with today's commit, and touches it only when something changed.
execute_process(COMMAND git -C ${SOURCE_DIR} describe --always --dirty
                OUTPUT_VARIABLE COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT COMMIT)
  set(COMMIT unknown)
endif()

# The fingerprint of all sources that decide the numbers of a row: rows of another one are stale. Neither compiler
# nor flags are in it; they belong to a row's environment.
file(GLOB deciding RELATIVE ${SOURCE_DIR}
     ${SOURCE_DIR}/core/*.cpp ${SOURCE_DIR}/core/*.h ${SOURCE_DIR}/problems/*.cpp ${SOURCE_DIR}/problems/*.h
     ${SOURCE_DIR}/problems/reference/*.csv ${SOURCE_DIR}/tableaus/*.cpp ${SOURCE_DIR}/tableaus/*.h
     ${SOURCE_DIR}/experiments/peers/*.cpp ${SOURCE_DIR}/experiments/peers/*.h
     ${SOURCE_DIR}/experiments/run.cpp ${SOURCE_DIR}/experiments/run_errors.cpp
     ${SOURCE_DIR}/experiments/run_spec.cpp ${SOURCE_DIR}/experiments/run_key.cpp ${SOURCE_DIR}/experiments/series_rules.cpp)
list(SORT deciding)
set(hashes "")
foreach(source IN LISTS deciding)
  file(SHA256 ${SOURCE_DIR}/${source} hash)
  string(APPEND hashes "${source} ${hash}\n")
endforeach()
string(SHA256 CODE "${hashes}")
string(SUBSTRING ${CODE} 0 12 CODE)
configure_file(${SOURCE_DIR}/experiments/build_info.cpp.in ${OUT} @ONLY)
