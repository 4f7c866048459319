# Finds the C interface of COIN-OR's integer programming solver CBC (<coin/Cbc_C_Interface.h>) and defines the target
# CBC::CBC. A shared library brings its own dependencies.

find_path(CBC_INCLUDE_DIR coin/Cbc_C_Interface.h)
find_library(CBC_LIBRARY CbcSolver)
mark_as_advanced(CBC_INCLUDE_DIR CBC_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CBC REQUIRED_VARS CBC_LIBRARY CBC_INCLUDE_DIR)

if(CBC_FOUND AND NOT TARGET CBC::CBC)
  add_library(CBC::CBC UNKNOWN IMPORTED)
  set_target_properties(CBC::CBC PROPERTIES
    IMPORTED_LOCATION "${CBC_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${CBC_INCLUDE_DIR}")
endif()
