// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_FILL_WITH_TETRAHEDRA_IMPL_H
#define QUADRILLE_MESH_IO_INTERNAL_FILL_WITH_TETRAHEDRA_IMPL_H

#include <Quadrille/Mesh_io/internal/Closed_surface.h>
#include <Quadrille/Mesh_io/internal/fill_by_tetgen.h>
#include <Quadrille/Mesh_io/internal/mesh_geometry.h>
#include <Quadrille/Mesh_io/internal/read_labelled_mesh.h>
#include <Quadrille/Mesh_io/internal/read_tetrahedral_mesh_impl.h>
#include <Quadrille/Mesh_io/internal/run_in_child_process.h>
#include <Quadrille/Mesh_io/internal/tetrahedron_counts.h>
#include <Quadrille/Support/internal/separate_compilation.h>
#include <Quadrille/fill_with_tetrahedra.h>
#include <Quadrille/read_tetrahedral_mesh.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace Quadrille {
namespace internal {

inline void check_options(const Filling_options& options)
{
  if (!(options.tetrahedron_size >= 0) || !std::isfinite(options.tetrahedron_size))
    throw Invalid_argument_error("the size of tetrahedra must be a positive number, or 0 for the default");
  if (!(options.time_limit_seconds > 0))
    throw Invalid_argument_error("the time limit must be positive");
}

#ifdef QUADRILLE_WITH_TETGEN

inline Tetgen_sizes tetgen_sizes(const Closed_surface& surface, const Filling_options& options)
{
  const CGAL::Bbox_3 box = surface.bbox();
  const double diagonal = std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
  Tetgen_sizes sizes;
  if (options.tetrahedron_size > 0) {
    // TetGen bounds the volume, and makes the tetrahedra a good deal smaller than that.
    sizes.largest = 1.2 * options.tetrahedron_size;
    sizes.keeps_surface = false;
  } else {
    // Edges of an equilateral triangle with the mean area.
    const double triangle_size = std::sqrt(surface.area() / double(surface.triangles().size()) * 4 / std::sqrt(3.0));
    sizes.largest = std::max(triangle_size, default_tetrahedron_size(diagonal));
  }
  return sizes;
}

/// Calls TetGen, in a child process if it is to be isolated; a crash is an error of its own kind.
inline Tetgen_result call_tetgen(const Closed_surface& surface, const Tetgen_sizes& sizes, const std::string& path,
                                 const Filling_options& options)
{
  const auto fill = [&] { return tetrahedralize_by_tetgen(surface, sizes); };
  if (!options.isolate)
    return fill();
  try {
    return run_in_child_process<Tetgen_result>(fill, options.time_limit_seconds, path, "TetGen");
  } catch (const Abnormal_end_error&) {
    Tetgen_result result;
    result.error = tetgen_crash;
    return result;
  }
}

#endif

/// \throws Invalid_input_error
inline Tetrahedral_mesh fill_surface(const Labelled_mesh& mesh, const std::string& path, const Filling_options& options)
{
#ifdef QUADRILLE_WITH_TETGEN
  const Closed_surface surface(mesh, path);
  Tetgen_sizes sizes = tetgen_sizes(surface, options);
  check_number_of_tetrahedra(surface.volume(), options.tetrahedron_size > 0 ? options.tetrahedron_size : sizes.largest,
                             options, path);
  Tetgen_result result = call_tetgen(surface, sizes, path, options);
  if (result.error != 0 && !sizes.keeps_surface) {
    sizes.keeps_surface = true; // which is easier between very small triangles
    result = call_tetgen(surface, sizes, path, options);
  }
  if (result.error != 0)
    throw Invalid_input_error(path + ": " + tetgen_error_in_words(result.error));
  if (result.mesh.tetrahedra.empty())
    throw Invalid_input_error(path + ": TetGen made no tetrahedra");
  orient_tetrahedra(result.mesh);
  select_feature_edges(result.mesh);
  return std::move(result.mesh);
#else
  static_cast<void>(mesh);
  static_cast<void>(options);
  throw Invalid_input_error(path + ": this is a surface, and filling it with tetrahedra needs TetGen, without which "
                                   "this program was built (Debian's package libtet1.5-dev); geometry files and "
                                   "tetrahedral meshes are read without it");
#endif
}

/// Whether a file of this name can hold both tetrahedra and surfaces.
inline bool is_volume_or_surface_file(const std::string& path)
{
  const std::string extension = extension_of(path);
  return extension == ".msh" || extension == ".vtk" || extension == ".mesh";
}

inline bool is_surface_file(const std::string& path)
{
  const std::string extension = extension_of(path);
  return extension == ".off" || extension == ".obj" || extension == ".ply" || extension == ".stl";
}

} // namespace internal

QUADRILLE_INLINE Tetrahedral_mesh fill_with_tetrahedra(const std::string& path, const Filling_options& options)
{
  internal::check_options(options);
  if (internal::is_geometry_file(path))
    return internal::mesh_geometry(path, options);
  if (internal::is_surface_file(path))
    return internal::fill_surface(internal::read_labelled_mesh(path, options.isolate, options.time_limit_seconds), path,
                                  options);
  if (!internal::is_volume_or_surface_file(path))
    throw Invalid_input_error(path + ": unknown format '" + internal::extension_of(path) +
                              "' for what is to be filled with tetrahedra; known are geometry (.geo .step .stp .brep "
                              ".iges .igs) and surfaces (.off .obj .ply .stl .msh .vtk .mesh)");
  const internal::Volume_content content =
      internal::read_volume_content(path, options.isolate, options.time_limit_seconds);
  if (!content.volume.tetrahedra.empty())
    throw Invalid_input_error(path + ": the file holds tetrahedra already, " +
                              std::to_string(content.volume.tetrahedra.size()));
  return internal::fill_surface(content.surface, path, options);
}

QUADRILLE_INLINE Tetrahedral_mesh load_tetrahedral_mesh(const std::string& path, const Filling_options& options)
{
  internal::check_options(options);
  if (internal::is_geometry_file(path) || internal::is_surface_file(path))
    return fill_with_tetrahedra(path, options);
  internal::Volume_content content = internal::read_volume_content(path, options.isolate, options.time_limit_seconds);
  if (!content.volume.tetrahedra.empty())
    return std::move(content.volume);
  return internal::fill_surface(content.surface, path, options);
}

} // namespace Quadrille

#endif
