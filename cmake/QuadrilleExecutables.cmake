# What our own executables (program, tests, examples, benchmarks) share. Nothing here reaches the exported targets.

if(NOT CMAKE_CXX_COMPILER_LAUNCHER AND PROJECT_IS_TOP_LEVEL)
  find_program(QUADRILLE_CCACHE ccache)
  mark_as_advanced(QUADRILLE_CCACHE)
  if(QUADRILLE_CCACHE)
    # Without these a compilation that uses a precompiled header is never found in the cache.
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
      CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${QUADRILLE_CCACHE})
    add_compile_options("$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
  endif()
endif()

add_library(quadrille_warnings INTERFACE)
target_compile_options(quadrille_warnings INTERFACE
  $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall -Wextra -Wpedantic -Wconversion -Werror>
  $<$<CXX_COMPILER_ID:MSVC>:/W4>)

add_library(quadrille_executable INTERFACE)
target_link_libraries(quadrille_executable INTERFACE quadrille_warnings)
target_compile_definitions(quadrille_executable INTERFACE QUADRILLE_SEPARATE_COMPILATION)
foreach(package IN LISTS QUADRILLE_PACKAGES)
  target_link_libraries(quadrille_executable INTERFACE Quadrille::${package})
endforeach()
# An executable loads only the libraries that it calls: libgmsh alone takes longer to load than most tests run.
if(CMAKE_SYSTEM_NAME STREQUAL "Linux")
  target_link_options(quadrille_executable INTERFACE LINKER:--as-needed)
endif()

# The expensive headers, parsed once for all executables that do not test and once for those that do.
function(quadrille_add_precompiled_header name)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "// Holds the precompiled header that other targets reuse.\n")
  add_library(${name} OBJECT EXCLUDE_FROM_ALL ${source})
  target_link_libraries(${name} PRIVATE quadrille_executable ${ARGN})
  target_precompile_headers(${name} PRIVATE
    <CGAL/Exact_predicates_inexact_constructions_kernel.h>
    <CGAL/Simple_cartesian.h>
    <CGAL/Surface_mesh.h>
    <Eigen/Core>
    <Eigen/Dense>
    <Eigen/Sparse>
    <algorithm>
    <map>
    <string>
    <vector>)
endfunction()

# Energies of fields are evaluated for four triangles at a time, about 1.5 times as fast with these instructions. Results
# are to be the same without them: so there are no fused multiply-adds, and Eigen, which would add up in another order,
# must not notice. Programs that link packages decide by their own flags.
set(QUADRILLE_HAS_AVX2 OFF)
if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang" AND NOT CMAKE_CROSSCOMPILING)
  include(CheckCXXSourceRuns)
  check_cxx_source_runs("int main() { return __builtin_cpu_supports(\"avx2\") ? 0 : 1; }" QUADRILLE_MACHINE_HAS_AVX2)
  set(QUADRILLE_HAS_AVX2 ${QUADRILLE_MACHINE_HAS_AVX2})
endif()
option(QUADRILLE_AVX2 "Build executables for processors with AVX2, as this machine has it" ${QUADRILLE_HAS_AVX2})
if(QUADRILLE_AVX2)
  target_compile_options(quadrille_executable INTERFACE -mavx2 -U__AVX__ -U__AVX2__ -DQUADRILLE_AVX)
endif()

quadrille_add_precompiled_header(quadrille_precompiled)

# The packages' functions that are no templates (see Support/internal/separate_compilation.h).
set(sources "")
foreach(package IN LISTS QUADRILLE_PACKAGES)
  file(GLOB found CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${package}/src/*.cpp)
  list(APPEND sources ${found})
endforeach()
add_library(quadrille_compiled_functions STATIC EXCLUDE_FROM_ALL ${sources})
target_link_libraries(quadrille_compiled_functions PUBLIC quadrille_executable)
target_precompile_headers(quadrille_compiled_functions REUSE_FROM quadrille_precompiled)

# quadrille_add_executable(<name> SOURCES <file>... [LIBRARIES <target>...] [PRECOMPILED <target>])
#
# An executable of ours with all packages at hand, warnings as errors, and the folders of data as compile definitions.
function(quadrille_add_executable name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "PRECOMPILED" "SOURCES;LIBRARIES")
  if(NOT arg_PRECOMPILED)
    set(arg_PRECOMPILED quadrille_precompiled)
  endif()
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE quadrille_compiled_functions ${arg_LIBRARIES})
  target_precompile_headers(${name} REUSE_FROM ${arg_PRECOMPILED})
  target_compile_definitions(${name} PRIVATE
    QUADRILLE_VERSION="${PROJECT_VERSION}"
    QUADRILLE_EXAMPLE_DATA="${PROJECT_SOURCE_DIR}/examples/data"
    QUADRILLE_TEST_DATA="${PROJECT_SOURCE_DIR}/test/data"
    QUADRILLE_SHARED_DATA="${PROJECT_SOURCE_DIR}/../shared/data")
endfunction()
