// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_FILL_BY_TETGEN_H
#define QUADRILLE_MESH_IO_INTERNAL_FILL_BY_TETGEN_H

#include <Quadrille/Mesh_io/internal/Closed_surface.h>
#include <Quadrille/Mesh_io/internal/Volume_content.h>

#include <string>

#ifdef QUADRILLE_WITH_TETGEN
#ifndef TETLIBRARY
#define TETLIBRARY // errors are thrown, as the library does; otherwise the header's functions call exit()
#endif
#include <tetgen.h>
#undef REAL
#undef FILENAMESIZE
#undef INPUTLINESIZE

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include <dlfcn.h>
#endif

namespace Quadrille {
namespace internal {

/// How a surface is to be filled.
struct Tetgen_sizes {
  double largest = 0;        ///< length of edges inside that is not to be exceeded by much
  bool keeps_surface = true; ///< its triangles are not divided
};

/// What `tetrahedralize_by_tetgen()` gives: without tetrahedra, a code of TetGen instead.
struct Tetgen_result {
  Tetrahedral_mesh mesh;
  int error = 0;
};

template <class Archive> void exchange(Archive& archive, Tetgen_result& r) { archive(r.mesh, r.error); }

#ifdef QUADRILLE_WITH_TETGEN

using Tetgen_function = void (*)(char*, tetgenio*, tetgenio*, tetgenio*, tetgenio*);

/// TetGen's function, from a library that is loaded for itself. It cannot be linked like others: Gmsh's library has
/// another version of TetGen's classes in it, under the same names, and the two would call each other's functions.
inline Tetgen_function load_tetgen()
{
#ifdef RTLD_DEEPBIND
  constexpr int mode = RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND;
#else
  constexpr int mode = RTLD_NOW | RTLD_LOCAL;
#endif
  void* library = ::dlopen(TETGEN_LIBRARY_FILE, mode);
  void* function = library ? ::dlsym(library, "_Z14tetrahedralizePcP8tetgenioS1_S1_S1_") : nullptr;
  if (!function)
    throw Error(std::string("TetGen cannot be loaded from ") + TETGEN_LIBRARY_FILE);
  return reinterpret_cast<Tetgen_function>(function);
}

/// The input for TetGen; numbers are multiplied by `scale`. The arrays belong to TetGen's structure, which deletes
/// them.
inline void copy_to_tetgen(const Closed_surface& surface, double scale, int line_marker, tetgenio& input)
{
  const std::size_t n_points = surface.points().size(), n_triangles = surface.triangles().size();
  input.firstnumber = 0;
  input.numberofpoints = int(n_points);
  input.pointlist = new double[3 * n_points];
  for (std::size_t v = 0; v < n_points; ++v)
    for (int k = 0; k < 3; ++k)
      input.pointlist[3 * v + std::size_t(k)] = scale * surface.points()[v][k];
  input.numberoffacets = int(n_triangles);
  input.facetlist = new tetgenio::facet[n_triangles];
  for (std::size_t t = 0; t < n_triangles; ++t) {
    tetgenio::facet& facet = input.facetlist[t];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    facet.polygonlist[0].numberofvertices = 3;
    facet.polygonlist[0].vertexlist = new int[3];
    std::copy(surface.triangles()[t].begin(), surface.triangles()[t].end(), facet.polygonlist[0].vertexlist);
  }
  const std::size_t n_holes = surface.holes().size(), n_lines = surface.lines().size();
  if (n_holes > 0) {
    input.numberofholes = int(n_holes);
    input.holelist = new double[3 * n_holes];
    for (std::size_t h = 0; h < n_holes; ++h)
      for (int k = 0; k < 3; ++k)
        input.holelist[3 * h + std::size_t(k)] = scale * surface.holes()[h][k];
  }
  if (n_lines > 0) {
    input.numberofedges = int(n_lines);
    input.edgelist = new int[2 * n_lines];
    input.edgemarkerlist = new int[n_lines];
    for (std::size_t e = 0; e < n_lines; ++e) {
      std::copy(surface.lines()[e].begin(), surface.lines()[e].end(), input.edgelist + 2 * e);
      input.edgemarkerlist[e] = line_marker;
    }
  }
}

/// Runs TetGen, which may print, abort or crash: meant for a child process.
inline Tetgen_result tetrahedralize_by_tetgen(const Closed_surface& surface, const Tetgen_sizes& sizes)
{
  constexpr int line_marker = 77;
  const CGAL::Bbox_3 box = surface.bbox();
  const double extent = std::max({box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin()});
  // A power of two changes no digit, and TetGen then meets no numbers that are very large or very small.
  const double scale = std::ldexp(1, -std::ilogb(extent));
  Tetgen_result result;
  tetgenio input, output;
  copy_to_tetgen(surface, scale, line_marker, input);
  const double volume_bound = std::pow(scale * sizes.largest, 3) / (6 * std::sqrt(2));
  char switches[100];
  std::snprintf(switches, sizeof switches, "p%sq1.4a%.10geQ", sizes.keeps_surface ? "Y" : "", volume_bound);
  try {
    load_tetgen()(switches, &input, &output, nullptr, nullptr);
  } catch (int code) {
    result.error = code == 0 ? 2 : code;
    return result;
  }
  Tetrahedral_mesh& mesh = result.mesh;
  const std::size_t n_given = surface.points().size();
  mesh.points.resize(std::size_t(output.numberofpoints));
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k)
      mesh.points[v][k] = v < n_given ? surface.points()[v][int(k)] : output.pointlist[3 * v + k] / scale;
  mesh.tetrahedra.resize(std::size_t(output.numberoftetrahedra));
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    std::copy(output.tetrahedronlist + 4 * t, output.tetrahedronlist + 4 * t + 4, mesh.tetrahedra[t].begin());
  for (int e = 0; !surface.lines().empty() && output.edgemarkerlist && e < output.numberofedges; ++e)
    if (output.edgemarkerlist[e] == line_marker)
      mesh.feature_edges.push_back({output.edgelist[2 * e], output.edgelist[2 * e + 1]});
  return result;
}

#endif

/// Not a code of TetGen: its version 1.5 crashes where it means to report an error.
constexpr int tetgen_crash = -1;

/// What TetGen's codes mean.
inline std::string tetgen_error_in_words(int code)
{
  switch (code) {
  case tetgen_crash:
    return "TetGen failed and did not say why; very small or very thin triangles are a common reason, and so are parts "
           "of the surface that nearly touch";
  case 1:
    return "TetGen ran out of memory";
  case 3:
    return "TetGen found that the surface intersects itself";
  case 4:
    return "TetGen met details that are too small beside the whole surface; they have to be simplified";
  case 5:
    return "TetGen met two parts of the surface that are too close to each other";
  case 10:
    return "TetGen refuses the surface as invalid input";
  default:
    return "TetGen failed with an internal error (" + std::to_string(code) + ")";
  }
}

} // namespace internal
} // namespace Quadrille

#endif
