# Finds ALGLIB (<libalglib/optimization.h>) and defines the target ALGLIB::ALGLIB.

find_path(ALGLIB_INCLUDE_DIR libalglib/optimization.h)
find_library(ALGLIB_LIBRARY alglib)
mark_as_advanced(ALGLIB_INCLUDE_DIR ALGLIB_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(ALGLIB REQUIRED_VARS ALGLIB_LIBRARY ALGLIB_INCLUDE_DIR)

if(ALGLIB_FOUND AND NOT TARGET ALGLIB::ALGLIB)
  add_library(ALGLIB::ALGLIB UNKNOWN IMPORTED)
  set_target_properties(ALGLIB::ALGLIB PROPERTIES
    IMPORTED_LOCATION "${ALGLIB_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${ALGLIB_INCLUDE_DIR}")
endif()
