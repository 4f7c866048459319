// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_READ_SURFACE_DOMAIN_IMPL_H
#define QUADRILLE_MESH_IO_INTERNAL_READ_SURFACE_DOMAIN_IMPL_H

#include <Quadrille/Mesh_io/internal/files.h>
#include <Quadrille/Mesh_io/internal/open_geometry.h>
#include <Quadrille/Mesh_io/internal/read_labelled_mesh.h>
#include <Quadrille/Mesh_io/internal/read_planar_domain.h>
#include <Quadrille/Mesh_io/internal/run_in_child_process.h>
#include <Quadrille/Mesh_io/internal/triangulate_surfaces.h>
#include <Quadrille/Support/internal/separate_compilation.h>
#include <Quadrille/read_surface_domain.h>

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace Quadrille {
namespace internal {

/// What a geometry file becomes.
struct Geometry_content {
  bool is_planar = false;
  Geometry_triangulation triangulation;
  std::string failure; ///< why there are no triangles, which another algorithm may change
};

template <class Archive> void exchange(Archive& archive, Geometry_content& c)
{
  archive(c.is_planar, c.triangulation, c.failure);
}

/// What is tried on a geometry: no algorithm of Gmsh succeeds on every one, and some crash.
struct Geometry_attempt {
  int algorithm = 0; ///< for surfaces, as Gmsh numbers them
  bool sews = true;  ///< surfaces of files without volumes
};

/// Triangulates a geometry file. Runs in the child process.
/// \param planar if given, planar geometries are triangulated for the plane. \throws Invalid_input_error
inline Geometry_content load_geometry(const std::string& path, const Surface_domain_options& options,
                                      const Planar_domain_options* planar, const Geometry_attempt& attempt)
{
  Geometry_content content;
  std::optional<Gmsh_session> session(std::in_place);
  open_geometry(path, *session);
  bool may_need_sewing = false;
  Gmsh_session::call(path, [&] {
    content.is_planar = planar && is_planar_geometry();
    may_need_sewing = extension_of(path) != ".geo" && has_free_curves();
  });
  if (content.is_planar) {
    content.triangulation = triangulate_geometry(path, *planar, session);
    return content;
  }
  if (attempt.sews && may_need_sewing) { // IGES files, above all, have surfaces that only touch
    session.reset();
    session.emplace();
    gmsh::option::setNumber("Geometry.OCCSewFaces", 1);
    open_geometry(path, *session);
  }
  try {
    Gmsh_session::call(
        path, [&] { content.triangulation = Surface_triangulator(path, options, *session).run(attempt.algorithm); });
  } catch (const Gmsh_failure& failure) {
    content.failure = failure.what();
  }
  if (!attempt.sews && may_need_sewing)
    content.triangulation.notes.push_back("the surfaces could not be sewn: those that only touch are not connected");
  return content;
}

/// \param planar if given, planar geometries become planar domains. \throws Invalid_input_error
inline std::variant<Planar_domain, Surface_domain>
read_geometry(const std::string& path, const Surface_domain_options& options, const Planar_domain_options* planar)
{
  check_no_repair_of_geometry(options.repair, path);
  constexpr int frontal_delaunay = 6, delaunay = 5, mesh_adapt = 1;
  const auto start = std::chrono::steady_clock::now();
  std::string first_failure;
  for (const Geometry_attempt& attempt :
       {Geometry_attempt{frontal_delaunay, true}, Geometry_attempt{delaunay, true}, Geometry_attempt{mesh_adapt, true},
        Geometry_attempt{frontal_delaunay, false}}) {
    std::string failure;
    Geometry_content content;
    try {
      const auto load = [&] { return load_geometry(path, options, planar, attempt); };
      const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
      content = options.isolate_geometry_kernel
                    ? run_in_child_process<Geometry_content>(load, options.time_limit_seconds - passed.count(), path)
                    : load();
      failure = content.failure;
    } catch (const Abnormal_end_error& error) {
      failure = error.what();
    }
    if (failure.empty()) {
      if (content.is_planar)
        return geometry_domain(content.triangulation, path, *planar);
      try {
        Surface_domain domain = make_surface(content.triangulation.mesh, path, options, true);
        domain.triangle_size = content.triangulation.triangle_size;
        domain.point_size = content.triangulation.point_size;
        domain.notes.insert(domain.notes.end(), content.triangulation.notes.begin(), content.triangulation.notes.end());
        return domain;
      } catch (const Invalid_input_error& error) {
        failure = error.what() + std::string(" (in the triangles that Gmsh made of the geometry)");
      }
    }
    if (first_failure.empty())
      first_failure = failure;
  }
  if (first_failure.rfind(path, 0) == 0)
    throw Invalid_input_error(first_failure);
  throw Invalid_input_error(path + ": Gmsh does not triangulate the surfaces (" + first_failure +
                            "); another triangle size sometimes helps");
}

} // namespace internal

QUADRILLE_INLINE Surface_domain read_surface_domain(const std::string& path, const Surface_domain_options& options)
{
  internal::check_options(options);
  internal::check_readable(path);
  if (internal::is_geometry_file(path))
    return std::get<Surface_domain>(internal::read_geometry(path, options, nullptr));
  internal::check_triangle_size_of_mesh(options.triangle_size, path);
  return make_surface_domain(
      internal::read_labelled_mesh(path, options.isolate_geometry_kernel, options.time_limit_seconds), path, options);
}

} // namespace Quadrille

#endif
