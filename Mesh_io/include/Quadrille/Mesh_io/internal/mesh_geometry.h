// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_MESH_GEOMETRY_H
#define QUADRILLE_MESH_IO_INTERNAL_MESH_GEOMETRY_H

#include <Quadrille/Mesh_io/internal/Gmsh_session.h>
#include <Quadrille/Mesh_io/internal/Volume_content.h>
#include <Quadrille/Mesh_io/internal/open_geometry.h>
#include <Quadrille/Mesh_io/internal/read_msh_volume.h>
#include <Quadrille/Mesh_io/internal/run_in_child_process.h>
#include <Quadrille/Mesh_io/internal/tetrahedron_counts.h>
#include <Quadrille/fill_with_tetrahedra.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Algorithms of Gmsh, by its numbers.
struct Gmsh_algorithms {
  int of_surfaces = 0, of_volumes = 0;
};

/// A mesh, or why there is none.
struct Geometry_mesh {
  Tetrahedral_mesh mesh;
  std::string failure;
};

template <class Archive> void exchange(Archive& archive, Geometry_mesh& m) { archive(m.mesh, m.failure); }

/// The volumes of a geometry file in tetrahedra, by Gmsh.
class Geometry_mesher {
public:
  Geometry_mesher(const std::string& path, const Filling_options& options, const Gmsh_algorithms& algorithms)
      : m_path(path), m_options(options), m_algorithms(algorithms)
  {
  }

  /// \throws Invalid_input_error if no algorithms can help
  Geometry_mesh run()
  {
    if (std::optional<Geometry_mesh> result = run(false))
      return std::move(*result);
    // Surfaces that enclose something, as IGES files often have them.
    if (extension_of(m_path) != ".geo")
      if (std::optional<Geometry_mesh> result = run(true))
        return std::move(*result);
    fail("the geometry has no volumes, and its surfaces enclose none; tetrahedra need something to fill");
  }

private:
  [[noreturn]] void fail(const std::string& reason) const { throw Invalid_input_error(m_path + ": " + reason); }

  /// Nothing if the geometry has no volumes.
  std::optional<Geometry_mesh> run(bool sew_surfaces)
  {
    const Gmsh_session session;
    gmsh::option::setNumber("Geometry.OCCSewFaces", sew_surfaces ? 1 : 0);
    gmsh::option::setNumber("Geometry.OCCMakeSolids", sew_surfaces ? 1 : 0);
    open_geometry(m_path, session);
    Geometry_mesh result;
    Gmsh_session::call(m_path, [&] {
      find_volumes();
      if (m_volumes.empty())
        return;
      set_sizes();
      const std::vector<int> curves = feature_curves();
      result.failure = mesh_volumes(session);
      if (result.failure.empty())
        result.mesh = Gmsh_volume(m_path).get(m_volumes, curves);
    });
    if (m_volumes.empty())
      return std::nullopt;
    return result;
  }

  /// As in Gmsh, when there are physical volumes, only they belong to the model.
  void find_volumes()
  {
    gmsh::vectorpair found;
    gmsh::model::getEntities(found, 3);
    std::set<int> grouped;
    gmsh::vectorpair groups;
    gmsh::model::getPhysicalGroups(groups, 3);
    for (const auto& [dimension, tag] : groups) {
      std::vector<int> members;
      gmsh::model::getEntitiesForPhysicalGroup(dimension, tag, members);
      for (const int member : members)
        grouped.insert(std::abs(member));
    }
    m_volumes.clear();
    for (const auto& [dimension, tag] : found)
      if (grouped.empty() || grouped.count(tag))
        m_volumes.push_back(tag);
  }

  /// What the file says about sizes is overruled, and what it says about structured meshes as far as Gmsh allows it.
  void set_sizes() const
  {
    double low[3], high[3];
    gmsh::model::getBoundingBox(-1, -1, low[0], low[1], low[2], high[0], high[1], high[2]);
    const double diagonal = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
    if (!(diagonal > 0) || !std::isfinite(diagonal))
      fail("the geometry has no extent or is not finite");
    const bool is_given = m_options.tetrahedron_size > 0;
    const double size = is_given ? m_options.tetrahedron_size : default_tetrahedron_size(diagonal);
    check_number_of_tetrahedra(volume_inside(), size, m_options, m_path);
    gmsh::model::mesh::field::setAsBackgroundMesh(-1);
    gmsh::model::mesh::removeConstraints();
    const double gmsh_size = size / 1.3; // edges inside become about 1.4 times as long as HXT is asked for
    gmsh::option::setNumber("Mesh.MeshSizeMax", gmsh_size);
    gmsh::option::setNumber("Mesh.MeshSizeMin", is_given ? gmsh_size : gmsh_size / 8);
    gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", is_given ? 0 : 12);
    gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
    gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 1);
    gmsh::option::setNumber("Mesh.MeshSizeFactor", 1);
    for (const char* name : {"Mesh.RecombineAll", "Mesh.Recombine3DAll", "Mesh.SubdivisionAlgorithm",
                             "Mesh.MeshOnlyVisible", "Mesh.MeshOnlyEmpty", "Mesh.SecondOrderIncomplete"})
      gmsh::option::setNumber(name, 0);
    gmsh::option::setNumber("Mesh.ElementOrder", 1);
    gmsh::option::setNumber("Mesh.Optimize", 1);
  }

  /// Zero where the geometry kernel cannot tell.
  double volume_inside() const
  {
    double sum = 0;
    try {
      for (const int volume : m_volumes) {
        double mass = 0;
        gmsh::model::occ::getMass(3, volume, mass);
        sum += mass;
      }
    } catch (...) { // volumes of Gmsh's own kernel; the exceptions' type depends on Gmsh's version
      return 0;
    }
    return sum;
  }

  /// The curves of the volumes' surfaces, and those embedded in them. A seam, where a closed surface meets itself, is
  /// no feature.
  std::vector<int> feature_curves() const
  {
    std::set<int> surfaces, features;
    const auto add_embedded = [&](int dimension, int tag) {
      gmsh::vectorpair embedded;
      gmsh::model::mesh::getEmbedded(dimension, tag, embedded);
      for (const auto& [d, t] : embedded)
        if (d == 1)
          features.insert(std::abs(t));
        else if (d == 2)
          surfaces.insert(std::abs(t));
    };
    for (const int volume : m_volumes) {
      gmsh::vectorpair boundary;
      gmsh::model::getBoundary({{3, volume}}, boundary, false, false);
      for (const auto& [d, t] : boundary)
        surfaces.insert(std::abs(t));
      add_embedded(3, volume);
    }
    std::map<int, std::set<int>> surfaces_of_curve;
    for (const int surface : std::set<int>(surfaces)) {
      gmsh::vectorpair boundary;
      gmsh::model::getBoundary({{2, surface}}, boundary, false, false);
      for (const auto& [d, t] : boundary)
        surfaces_of_curve[std::abs(t)].insert(surface);
      add_embedded(2, surface);
    }
    for (const auto& [curve, around] : surfaces_of_curve)
      if (around.size() > 1)
        features.insert(curve);
    return {features.begin(), features.end()};
  }

  /// Why there are no tetrahedra afterwards; empty if there are.
  std::string mesh_volumes(const Gmsh_session& session) const
  {
    gmsh::option::setNumber("Mesh.Algorithm", m_algorithms.of_surfaces);
    gmsh::option::setNumber("Mesh.Algorithm3D", m_algorithms.of_volumes);
    gmsh::logger::stop(); // asking for the volume may have logged an error
    gmsh::logger::start();
    try {
      Gmsh_session::call("Gmsh", [] { gmsh::model::mesh::generate(3); });
    } catch (const Invalid_input_error& error) {
      return error.what();
    }
    const std::string error = session.first_error();
    if (!error.empty())
      return error;
    return are_filled() ? std::string() : "a volume stayed empty";
  }

  bool are_filled() const
  {
    constexpr int tetrahedron = 4;
    for (const int volume : m_volumes) {
      std::vector<int> types;
      gmsh::model::mesh::getElementTypes(types, 3, volume);
      if (types.empty())
        return false;
      if (types != std::vector<int>{tetrahedron}) // which cannot be overruled everywhere
        fail("the script asks for other cells than tetrahedra in volume " + std::to_string(volume) +
             "; remove Recombine and Layers from it");
    }
    return true;
  }

  const std::string& m_path;
  const Filling_options& m_options;
  Gmsh_algorithms m_algorithms;
  std::vector<int> m_volumes; ///< tags
};

/// A geometry file in tetrahedra. \throws Invalid_input_error
///
/// No algorithm succeeds on every geometry, and some crash. HXT, the first, takes a tenth of the time of Gmsh's
/// Delaunay algorithm, and its worst tetrahedra are better.
inline Tetrahedral_mesh mesh_geometry(const std::string& path, const Filling_options& options)
{
  constexpr int frontal_delaunay_2 = 6, delaunay_2 = 5, mesh_adapt_2 = 1;
  constexpr int hxt_3 = 10, delaunay_3 = 1, frontal_3 = 4;
  const auto start = std::chrono::steady_clock::now();
  std::string first_failure;
  for (const Gmsh_algorithms& algorithms :
       {Gmsh_algorithms{frontal_delaunay_2, hxt_3}, Gmsh_algorithms{frontal_delaunay_2, delaunay_3},
        Gmsh_algorithms{delaunay_2, hxt_3}, Gmsh_algorithms{delaunay_2, delaunay_3},
        Gmsh_algorithms{mesh_adapt_2, hxt_3}, Gmsh_algorithms{mesh_adapt_2, delaunay_3},
        Gmsh_algorithms{frontal_delaunay_2, frontal_3}}) {
    Geometry_mesh result;
    try {
      const auto mesh = [&] { return Geometry_mesher(path, options, algorithms).run(); };
      const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
      result = options.isolate ? run_in_child_process<Geometry_mesh>(mesh, options.time_limit_seconds - passed.count(),
                                                                     path, "Gmsh")
                               : mesh();
    } catch (const Abnormal_end_error& error) {
      result.failure = error.what();
    }
    if (result.failure.empty())
      return std::move(result.mesh);
    if (first_failure.empty())
      first_failure = result.failure;
  }
  throw Invalid_input_error(path + ": Gmsh does not fill the volumes with tetrahedra (" + first_failure +
                            "); smaller tetrahedra often help where parts are thin or curved");
}

} // namespace internal
} // namespace Quadrille

#endif
