# Headers that are read once for a whole target rather than in each of its sources: what the standard library, Qt and
# GoogleTest cost. Meant for builds from nothing; ccache does better without, so it is on only where CI asks for it.
# Sources include what they use all the same: a build without finds those that do not.
if("$ENV{CI}" STREQUAL "true")
  set(PRT_PRECOMPILE_DEFAULT ON)
else()
  set(PRT_PRECOMPILE_DEFAULT OFF)
endif()
option(PRT_PRECOMPILE "Precompile headers: faster builds from nothing" ${PRT_PRECOMPILE_DEFAULT})

set(PRT_STANDARD_HEADERS <algorithm> <array> <atomic> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <numeric>
  <optional> <set> <span> <string> <vector>)

# GCC 12 takes precompiled system headers for ours and warns of what it only believes to see in std::string
# (https://gcc.gnu.org/bugzilla/show_bug.cgi?id=105651); builds without precompiled headers have these warnings on.
set(PRT_PRECOMPILE_OPTIONS -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread)

# prt_precompile(TARGET HEADERS...): those of the standard library and these.
function(prt_precompile target)
  if(PRT_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE ${PRT_STANDARD_HEADERS} ${ARGN})
    target_compile_options(${target} PRIVATE ${PRT_PRECOMPILE_OPTIONS})
  endif()
endfunction()

# prt_precompiled_as(TARGET OTHER): the ones that OTHER has; it is compiled with the same options.
function(prt_precompiled_as target other)
  if(PRT_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM ${other})
    target_compile_options(${target} PRIVATE ${PRT_PRECOMPILE_OPTIONS})
  endif()
endfunction()
