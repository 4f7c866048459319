// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_WRITE_VTU_H
#define QUADRILLE_WRITE_VTU_H

#include <Quadrille/Tetrahedral_mesh.h>
#include <Quadrille/exceptions.h>

#include <array>
#include <string>
#include <variant>
#include <vector>

namespace Quadrille {

/// Numbers at the points or the cells of a VTU file: `components` for the first, then for the second, ...
struct Vtu_array {
  std::string name;
  int components = 1;
  std::variant<std::vector<double>, std::vector<float>, std::vector<int>> values;
};

/// What a VTU file says at its points and cells.
struct Vtu_data {
  std::vector<Vtu_array> at_points, at_cells;
};

/// Writes tetrahedra with data as a VTU file (VTK XML, binary, uncompressed): what ParaView opens at once.
///
/// The file is written while it is made, so that it needs little memory, and appears completely, or not at all.
/// \pre the corners of the cells are points; they are not checked.
/// \throws Output_error naming the file if it cannot be written.
/// \throws Invalid_argument_error if the name does not end in .vtu, or an array has the wrong number of values or a
/// name that another one of its kind has.
void write_vtu(const std::string& path, const Tetrahedral_mesh& mesh, const Vtu_data& data = {});

/// The same for polylines, each given by its points; those with one point become vertices.
void write_vtu(const std::string& path, const std::vector<std::array<double, 3>>& points,
               const std::vector<std::vector<int>>& polylines, const Vtu_data& data = {});

} // namespace Quadrille

#include <Quadrille/Mesh_io/internal/write_vtu_impl.h>

#endif
