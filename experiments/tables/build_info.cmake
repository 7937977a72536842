# Runs at build time: writes OUT with the current commit, and touches it only when something has changed.
# The sources may lie in a folder of another project's repository. An archive of the sources carries its commit: git writes
# it in the place of the format (.gitattributes).
execute_process(COMMAND git -C ${SOURCE_DIR} rev-parse --show-toplevel
                OUTPUT_VARIABLE repository OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
file(REAL_PATH ${SOURCE_DIR} sources)
set(COMMIT "")
if(repository STREQUAL sources)
  execute_process(COMMAND git -C ${SOURCE_DIR} describe --always --dirty
                  OUTPUT_VARIABLE COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
else()
  file(STRINGS ${SOURCE_DIR}/experiments/tables/archived_commit.txt COMMIT LIMIT_COUNT 1)
  if(COMMIT MATCHES "Format")
    set(COMMIT "")
  endif()
endif()
if(NOT COMMIT)
  set(COMMIT unknown)
endif()

# A fingerprint of all sources that determine the numbers of a row; rows with another fingerprint are stale. Compiler
# and flags are not included; they belong to a row's environment.
set(deciding ${SOURCE_DIR}/experiments/study/series_rules.cpp)
foreach(folder core tableaus problems experiments/runs experiments/reference)
  file(GLOB_RECURSE found ${SOURCE_DIR}/${folder}/*.cpp ${SOURCE_DIR}/${folder}/*.h)
  list(APPEND deciding ${found})
endforeach()
file(GLOB found ${SOURCE_DIR}/problems/reference/*.csv)
list(APPEND deciding ${found})
list(SORT deciding)
set(hashes "")
foreach(source IN LISTS deciding)
  file(SHA256 ${source} hash)
  file(RELATIVE_PATH source ${SOURCE_DIR} ${source})
  string(APPEND hashes "${source} ${hash}\n")
endforeach()
string(SHA256 CODE "${hashes}")
string(SUBSTRING ${CODE} 0 12 CODE)
configure_file(${SOURCE_DIR}/experiments/tables/build_info.cpp.in ${OUT} @ONLY)
