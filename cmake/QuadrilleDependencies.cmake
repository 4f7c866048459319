# The libraries that the packages stand on. Found here, in the top directory's scope, so that every folder sees their
# targets; a package names those that it uses in its package_info/dependencies.

# quadrille_dependency(<name> <target> [OPTIONAL] [<argument of find_package>...])
#
# Finds <name> and remembers its target and how an installed Quadrille finds it again. An OPTIONAL one can be switched
# off with QUADRILLE_WITH_<NAME>; packages that use it then compile without the definition of the same name.
macro(quadrille_dependency name target)
  cmake_parse_arguments(_dependency "OPTIONAL" "" "" ${ARGN})
  set(_dependency_find ${name} ${_dependency_UNPARSED_ARGUMENTS})
  set(QUADRILLE_${name}_TARGET "")
  list(JOIN _dependency_find " " QUADRILLE_${name}_FIND)
  if(_dependency_OPTIONAL)
    string(TOUPPER ${name} _dependency_upper)
    option(QUADRILLE_WITH_${_dependency_upper} "Use ${name} where it is installed" ON)
    if(QUADRILLE_WITH_${_dependency_upper})
      find_package(${_dependency_find} QUIET)
      if(${name}_FOUND)
        set(QUADRILLE_${name}_TARGET ${target})
      endif()
    endif()
    if(QUADRILLE_${name}_TARGET)
      message(STATUS "Quadrille: with ${name}")
    else()
      message(STATUS "Quadrille: without ${name}")
    endif()
  else()
    find_package(${_dependency_find} REQUIRED)
    set(QUADRILLE_${name}_TARGET ${target})
  endif()
endmacro()

set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE)
# CONFIG, because CGAL's own find modules for these two define no targets.
quadrille_dependency(Eigen3 Eigen3::Eigen CONFIG)
quadrille_dependency(TBB TBB::tbb CONFIG)
quadrille_dependency(CGAL CGAL::CGAL 5.5)
quadrille_dependency(Boost Boost::headers 1.71)
quadrille_dependency(CHOLMOD CHOLMOD::CHOLMOD OPTIONAL)
quadrille_dependency(ALGLIB ALGLIB::ALGLIB OPTIONAL)
quadrille_dependency(CBC CBC::CBC OPTIONAL)
quadrille_dependency(TetGen TetGen::TetGen OPTIONAL)
quadrille_dependency(Gmsh Gmsh::Gmsh)
