# Finds CHOLMOD, the sparse Cholesky factorization of SuiteSparse, and defines the target CHOLMOD::CHOLMOD.
#
# A shared library brings its own dependencies; a static one is linked with the other parts of SuiteSparse and with
# LAPACK and BLAS.

find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(CHOLMOD_LIBRARY cholmod)
mark_as_advanced(CHOLMOD_INCLUDE_DIR CHOLMOD_LIBRARY)

if(CHOLMOD_INCLUDE_DIR AND EXISTS "${CHOLMOD_INCLUDE_DIR}/cholmod.h")
  set(_cholmod_header "")
  foreach(_cholmod_file cholmod.h cholmod_core.h)
    if(EXISTS "${CHOLMOD_INCLUDE_DIR}/${_cholmod_file}")
      file(STRINGS "${CHOLMOD_INCLUDE_DIR}/${_cholmod_file}" _cholmod_lines
        REGEX "#define CHOLMOD_(MAIN|SUB|SUBSUB)_VERSION +[0-9]+")
      list(APPEND _cholmod_header ${_cholmod_lines})
    endif()
  endforeach()
  string(REGEX MATCHALL "_VERSION +[0-9]+" _cholmod_numbers "${_cholmod_header}")
  list(TRANSFORM _cholmod_numbers REPLACE "_VERSION +" "")
  list(JOIN _cholmod_numbers "." CHOLMOD_VERSION)
endif()

set(_cholmod_required CHOLMOD_LIBRARY CHOLMOD_INCLUDE_DIR)
set(_cholmod_parts "")
if(CHOLMOD_LIBRARY MATCHES "\\${CMAKE_STATIC_LIBRARY_SUFFIX}$")
  foreach(_cholmod_part amd colamd ccolamd camd suitesparseconfig)
    find_library(CHOLMOD_${_cholmod_part}_LIBRARY ${_cholmod_part})
    mark_as_advanced(CHOLMOD_${_cholmod_part}_LIBRARY)
    list(APPEND _cholmod_required CHOLMOD_${_cholmod_part}_LIBRARY)
    list(APPEND _cholmod_parts ${CHOLMOD_${_cholmod_part}_LIBRARY})
  endforeach()
  find_package(LAPACK QUIET)
  list(APPEND _cholmod_required LAPACK_FOUND)
  list(APPEND _cholmod_parts ${LAPACK_LIBRARIES})
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CHOLMOD REQUIRED_VARS ${_cholmod_required} VERSION_VAR CHOLMOD_VERSION)

if(CHOLMOD_FOUND AND NOT TARGET CHOLMOD::CHOLMOD)
  add_library(CHOLMOD::CHOLMOD UNKNOWN IMPORTED)
  set_target_properties(CHOLMOD::CHOLMOD PROPERTIES
    IMPORTED_LOCATION "${CHOLMOD_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${CHOLMOD_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${_cholmod_parts}")
endif()
