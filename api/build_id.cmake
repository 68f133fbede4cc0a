# Writes the commit of the sources to a header: at each build, but the header changes with the commit alone.
# Run by cmake -P with SOURCE (folder), HEADER, VERSION, TARGET, GIVEN (commit to write; may be empty).
set(build "${GIVEN}")
find_package(Git QUIET)
if(NOT build AND GIT_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} -C ${SOURCE} rev-parse --short=12 HEAD OUTPUT_VARIABLE build
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  execute_process(COMMAND ${GIT_EXECUTABLE} -C ${SOURCE} diff --quiet HEAD -- api clients/c server solver migrations
    RESULT_VARIABLE differs ERROR_QUIET)
  if(build AND differs)
    set(build "${build}+")
  endif()
endif()
if(NOT build)
  set(build "unknown")
endif()
file(CONFIGURE OUTPUT ${HEADER} @ONLY CONTENT [[#pragma once
#define SNAPTHROUGH_VERSION "@VERSION@"
#define SNAPTHROUGH_BUILD "@build@"
#define SNAPTHROUGH_TARGET "@TARGET@"
]])
