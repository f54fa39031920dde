# cmake -DSOURCE=DIR -DHEADER=FILE -P git_state.cmake
# Writes the commit and whether tracked files differ from it into a header; touches the header only when
# they changed. Outside a checkout, or without git, the commit is "unknown".
set(commit "unknown")
set(dirty "false")
find_program(GIT git)
if(GIT)
  execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse --show-toplevel
                  OUTPUT_VARIABLE top OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  file(REAL_PATH "${SOURCE}" source)
  # A copy of the sources inside another checkout does not take that one's commit for its own.
  if(top AND top STREQUAL source)
    execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse --verify HEAD
                    OUTPUT_VARIABLE head OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(head MATCHES "^[0-9a-f]+$")
      set(commit ${head})
      execute_process(COMMAND ${GIT} -C ${SOURCE} --no-optional-locks status --porcelain --untracked-files=no
                      OUTPUT_VARIABLE changes ERROR_QUIET)
      if(changes)
        set(dirty "true")
      endif()
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT [[
#define VSGLBENCH_GIT_COMMIT "@commit@"
#define VSGLBENCH_GIT_DIRTY @dirty@
]] @ONLY)
