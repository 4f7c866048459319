// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_READ_MESH_IMPL_H
#define QUADRILLE_MESH_IO_INTERNAL_READ_MESH_IMPL_H

#include <Quadrille/Mesh_io/internal/read_labelled_mesh.h>
#include <Quadrille/Support/internal/separate_compilation.h>
#include <Quadrille/read_mesh.h>

#include <string>

namespace Quadrille {

QUADRILLE_INLINE Labelled_mesh read_mesh(const std::string& path, bool isolate, double time_limit_seconds)
{
  return internal::read_labelled_mesh(path, isolate, time_limit_seconds);
}

} // namespace Quadrille

#endif
