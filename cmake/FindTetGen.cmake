# Finds TetGen (<tetgen.h> and its library) and defines the target TetGen::TetGen. It does not link the library but
# tells its place in the definition TETGEN_LIBRARY_FILE, for loading it at run time: Gmsh's library has symbols of the
# same names in it, of another version, and a program that is linked with both crashes.

find_path(TetGen_INCLUDE_DIR tetgen.h)
find_library(TetGen_LIBRARY NAMES tet)
mark_as_advanced(TetGen_INCLUDE_DIR TetGen_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(TetGen REQUIRED_VARS TetGen_LIBRARY TetGen_INCLUDE_DIR)

if(TetGen_FOUND AND NOT TARGET TetGen::TetGen)
  add_library(TetGen::TetGen INTERFACE IMPORTED)
  set_target_properties(TetGen::TetGen PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${TetGen_INCLUDE_DIR}"
    INTERFACE_COMPILE_DEFINITIONS "TETGEN_LIBRARY_FILE=\"${TetGen_LIBRARY}\""
    INTERFACE_LINK_LIBRARIES "${CMAKE_DL_LIBS}")
endif()
