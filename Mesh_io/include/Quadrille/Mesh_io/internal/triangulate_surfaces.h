// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_TRIANGULATE_SURFACES_H
#define QUADRILLE_MESH_IO_INTERNAL_TRIANGULATE_SURFACES_H

#include <Quadrille/Mesh_io/internal/Byte_archive.h>
#include <Quadrille/Mesh_io/internal/Gmsh_session.h>
#include <Quadrille/Mesh_io/internal/Gmsh_surface_mesh.h>
#include <Quadrille/Mesh_io/internal/Triangle_size_field.h>
#include <Quadrille/Mesh_io/internal/files.h>
#include <Quadrille/Mesh_io/internal/find_surfaces.h>
#include <Quadrille/Mesh_io/internal/point_sizes.h>
#include <Quadrille/Mesh_io/internal/vector_length.h>
#include <Quadrille/Surface_domain.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace Quadrille {
namespace internal {

/// Triangles for the surfaces of Gmsh's current model.
class Surface_triangulator {
public:
  using Point_3 = Surface_domain::Point_3;

  Surface_triangulator(const std::string& path, const Surface_domain_options& options, const Gmsh_session& session)
      : m_path(path), m_options(options), m_session(session)
  {
  }

  /// \param algorithm number of one of Gmsh's algorithms for surfaces
  /// \throws Invalid_input_error if no algorithm can help, Gmsh_failure if another one may
  Geometry_triangulation run(int algorithm)
  {
    m_surfaces = find_surfaces(m_path);
    m_diagonal = diagonal_of_model();
    if (!(m_diagonal > 0) || !std::isfinite(m_diagonal))
      fail("the geometry has no extent or is not finite");
    hide_others();
    if (extension_of(m_path) == ".geo")
      m_point_sizes = read_point_sizes();
    set_options(algorithm);
    const double area = area_of_surfaces();
    const bool is_given = m_options.triangle_size > 0;
    const double size = is_given ? m_options.triangle_size : std::sqrt(area / (default_number * triangle_area));
    mesh_with_size(size, std::max(double(m_options.max_triangles), 3 * area / (size * size * triangle_area)));
    gmsh::model::mesh::removeSizeCallback();
    Geometry_triangulation result = Gmsh_surface_mesh(m_surfaces).get(m_point_sizes);
    result.triangle_size = size;
    result.notes = std::move(m_notes);
    return result;
  }

private:
  static constexpr double default_number = 10000, triangle_area = 0.433; ///< with edges of length 1
  static constexpr double degenerate_length = 1e-7;                      ///< of curves, relative to the model

  [[noreturn]] void fail(const std::string& reason) const { throw Invalid_input_error(m_path + ": " + reason); }

  /// Gmsh is told to mesh what is visible: what does not belong could fail.
  void hide_others() const
  {
    gmsh::vectorpair all, wanted;
    gmsh::model::getEntities(all);
    gmsh::model::setVisibility(all, 0);
    for (const int surface : m_surfaces)
      wanted.emplace_back(2, surface);
    gmsh::model::setVisibility(wanted, 1, true);
  }

  static double diagonal_of_model()
  {
    double low[3], high[3];
    gmsh::model::getBoundingBox(-1, -1, low[0], low[1], low[2], high[0], high[1], high[2]);
    return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  }

  /// What the file says about sizes is overruled, and what it says about structured meshes as far as Gmsh allows it.
  void set_options(int algorithm) const
  {
    gmsh::model::mesh::field::setAsBackgroundMesh(-1);
    gmsh::model::mesh::removeConstraints();
    gmsh::option::setNumber("Mesh.Algorithm", algorithm);
    gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 1);
    gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", m_options.refine_locally ? m_options.edges_per_circle : 0);
    gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
    gmsh::option::setNumber("Mesh.MeshSizeFactor", 1);
    // Curvature is noisy on surfaces of Gmsh's own kernel; by default, it integrates sizes so exactly that this takes
    // nearly for ever.
    gmsh::option::setNumber("Mesh.LcIntegrationPrecision", 1e-4);
    gmsh::option::setNumber("Mesh.MeshOnlyVisible", 1);
    for (const char* name : {"Mesh.RecombineAll", "Mesh.SubdivisionAlgorithm", "Mesh.MeshOnlyEmpty",
                             "Mesh.SecondOrderIncomplete", "Mesh.AlgorithmSwitchOnFailure"})
      gmsh::option::setNumber(name, 0);
    gmsh::option::setNumber("Mesh.ElementOrder", 1);
  }

  /// From the geometry kernel or, where it cannot tell, from a coarse triangulation.
  double area_of_surfaces()
  {
    double area = 0;
    try {
      for (const int surface : m_surfaces) {
        double mass = 0;
        gmsh::model::occ::getMass(2, surface, mass);
        area += mass;
      }
    } catch (...) { // surfaces of Gmsh's own kernel; the exceptions' type depends on Gmsh's version
      area = 0;
    }
    if (!(area > 0)) {
      generate(m_diagonal / 20, m_diagonal / 20);
      area = Gmsh_surface_mesh(m_surfaces).area();
    }
    if (!(area > 0) || !std::isfinite(area))
      fail("the surfaces have no area");
    return area;
  }

  /// With triangles as small as details need, unless they become too many.
  void mesh_with_size(double size, double max_triangles)
  {
    if (!m_options.refine_locally)
      return generate(size, size);
    double factor = 1;
    for (const double next : {2.0, 4.0, 8.0}) {
      generate(size / next, size);
      if (double(Gmsh_surface_mesh(m_surfaces).number_of_triangles()) > max_triangles) {
        m_notes.push_back("details are too small for " + std::to_string(m_options.max_triangles) +
                          " triangles and not fully resolved; a smaller triangle size allows more");
        return generate(size / factor, size);
      }
      if (m_shortest_edge > 1.5 * size / next)
        return; // nothing asks for smaller ones
      factor = next;
    }
  }

  /// Triangles grow gradually with the distance from curves, starting with the edges that curvature and lengths ask
  /// for.
  void generate(double smallest, double largest)
  {
    gmsh::model::mesh::removeSizeCallback();
    gmsh::model::mesh::clear();
    set_sizes(smallest, largest);
    if (smallest < largest) {
      call_gmsh(1);
      const std::vector<Triangle_size_field<Point_3>::Source> edges = edges_on_curves();
      m_shortest_edge = largest;
      for (const auto& edge : edges)
        m_shortest_edge = std::min(m_shortest_edge, edge.size);
      m_field.emplace(largest, m_options.size_gradation, edges);
      gmsh::model::mesh::setSizeCallback(
          [this](int, int, double x, double y, double z) { return (*m_field)(Point_3(x, y, z)); });
      gmsh::model::mesh::clear();
    }
    call_gmsh(2);
    for (const int surface : m_surfaces) {
      constexpr int triangle = 2;
      std::vector<int> types;
      gmsh::model::mesh::getElementTypes(types, 2, surface);
      if (types.empty())
        throw Gmsh_failure("surface " + std::to_string(surface) + " stayed empty");
      if (types != std::vector<int>{triangle}) // which cannot be overruled everywhere
        fail("the script asks for other elements than triangles on surface " + std::to_string(surface) +
             "; remove Recombine and Layers from it");
    }
  }

  std::vector<Triangle_size_field<Point_3>::Source> edges_on_curves() const
  {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters, -1, -1, false, false);
    std::map<std::size_t, Point_3> points;
    for (std::size_t i = 0; i < tags.size(); ++i)
      points[tags[i]] = Point_3(coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]);
    std::vector<Triangle_size_field<Point_3>::Source> edges;
    for (const int curve : curves_of(m_surfaces)) {
      constexpr int line = 1;
      std::vector<std::size_t> elements, nodes;
      gmsh::model::mesh::getElementsByType(line, elements, nodes, curve);
      for (std::size_t i = 0; i + 1 < nodes.size(); i += 2) {
        const Point_3 &p = points[nodes[i]], &q = points[nodes[i + 1]];
        if (const double length = length_of(q - p); length > degenerate_length * m_diagonal)
          edges.push_back({p, q, length});
      }
    }
    return edges;
  }

  /// Gmsh interpolates the sizes at the points along curves, so that short curves make edges small around them.
  void set_sizes(double smallest, double largest) const
  {
    gmsh::option::setNumber("Mesh.MeshSizeMin", smallest);
    gmsh::option::setNumber("Mesh.MeshSizeMax", largest);
    std::map<int, double> size_of_point;
    gmsh::vectorpair points;
    gmsh::model::getEntities(points, 0);
    for (const auto& [dimension, tag] : points)
      size_of_point[tag] = largest;
    if (smallest < largest)
      for (const auto& [curve, length] : lengths_of_curves()) {
        gmsh::vectorpair ends;
        gmsh::model::getBoundary({{1, curve}}, ends, false, false);
        for (const auto& [dimension, tag] : ends) {
          double& size = size_of_point[std::abs(tag)];
          size = std::min(size, std::max(length / m_options.edges_per_curve, smallest));
        }
      }
    for (const auto& [tag, size] : size_of_point)
      gmsh::model::mesh::setSize({{0, tag}}, size);
  }

  /// Of the curves that are not degenerate, as those at the poles of a sphere are.
  std::map<int, double> lengths_of_curves() const
  {
    std::map<int, double> lengths;
    for (const int curve : curves_of(m_surfaces)) {
      const double length = length_of_curve(curve);
      if (length > degenerate_length * m_diagonal)
        lengths[curve] = length;
    }
    return lengths;
  }

  static double length_of_curve(int curve)
  {
    double length = 0;
    const std::vector<double> xyz = sample_curve(curve, 32);
    for (std::size_t i = 3; i + 2 < xyz.size(); i += 3)
      length += std::hypot(xyz[i] - xyz[i - 3], xyz[i + 1] - xyz[i - 2], xyz[i + 2] - xyz[i - 1]);
    return length;
  }

  void call_gmsh(int dimension) const
  {
    gmsh::logger::stop(); // asking for the area may have logged an error
    gmsh::logger::start();
    try {
      Gmsh_session::call("Gmsh", [=] { gmsh::model::mesh::generate(dimension); });
    } catch (const Invalid_input_error& error) {
      throw Gmsh_failure(error.what());
    }
    const std::string error = m_session.first_error();
    if (!error.empty())
      throw Gmsh_failure(error);
  }

  const std::string& m_path;
  const Surface_domain_options& m_options;
  const Gmsh_session& m_session;
  std::vector<int> m_surfaces; ///< tags
  double m_diagonal = 0;       ///< of the bounding box
  std::map<int, double> m_point_sizes;
  std::optional<Triangle_size_field<Point_3>> m_field;
  double m_shortest_edge = 0; ///< on curves, before the sizes were graded
  std::vector<std::string> m_notes;
};

} // namespace internal
} // namespace Quadrille

#endif
