// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_READ_DOMAIN_IMPL_H
#define QUADRILLE_MESH_IO_INTERNAL_READ_DOMAIN_IMPL_H

#include <Quadrille/Mesh_io/internal/Spatial_extent.h>
#include <Quadrille/Mesh_io/internal/read_planar_domain.h>
#include <Quadrille/Mesh_io/internal/read_surface_domain_impl.h>
#include <Quadrille/Support/internal/separate_compilation.h>
#include <Quadrille/read_domain.h>
#include <Quadrille/read_planar_domain.h>
#include <Quadrille/read_surface_domain.h>

#include <string>
#include <variant>

namespace Quadrille {

QUADRILLE_INLINE bool is_planar(const Labelled_mesh& mesh) { return internal::is_flat(mesh); }

QUADRILLE_INLINE std::variant<Planar_domain, Surface_domain> read_domain(const std::string& path,
                                                                         const Planar_domain_options& planar_options,
                                                                         const Surface_domain_options& surface_options)
{
  internal::check_options(planar_options);
  internal::check_options(surface_options);
  internal::check_readable(path);
  if (internal::is_geometry_file(path))
    return internal::read_geometry(path, surface_options, &planar_options);
  const Labelled_mesh mesh =
      internal::read_labelled_mesh(path, surface_options.isolate_geometry_kernel, surface_options.time_limit_seconds);
  if (is_planar(mesh))
    return internal::mesh_domain(mesh, path, planar_options);
  internal::check_triangle_size_of_mesh(surface_options.triangle_size, path);
  return make_surface_domain(mesh, path, surface_options);
}

} // namespace Quadrille

#endif
