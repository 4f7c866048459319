// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_SEGMENT_MESHER_H
#define QUADRILLE_MESH_IO_INTERNAL_SEGMENT_MESHER_H

#include <Quadrille/Mesh_io/internal/Gmsh_session.h>
#include <Quadrille/Mesh_io/internal/Triangle_size_field.h>
#include <Quadrille/Mesh_io/internal/retriangulate.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// The curves of an outline as line segments between numbered points.
struct Segmented_outline {
  std::vector<Point_2> points; ///< the outline's own points first
  std::vector<Numbered_segment> segments;
  std::vector<int> curve_of_segment;
  std::vector<std::vector<int>> segments_of_curve;
  std::vector<std::array<double, 4>> tangents; ///< per segment, unit vectors at its two ends
};

/// Meshes the surfaces between given segments by Gmsh in a session of its own and in the unit square, so that neither
/// the user's Gmsh options nor absolute tolerances matter.
class Segment_mesher {
public:
  /// All in unit coordinates.
  Segment_mesher(const Outline& outline, const Segmented_outline& segmented, const Triangle_size_field<Point_2>& field,
                 const std::string& path)
      : m_outline(outline), m_segmented(segmented), m_field(field), m_path(path)
  {
  }

  /// Frontal-Delaunay gives the best triangles; where surfaces are hardly wider than rounding errors it sometimes
  /// fails, and then one of the others may do. If none does, at least its points are of use.
  void run(std::vector<Point_2>& points, std::vector<std::array<int, 3>>& triangles, std::vector<int>& regions) const
  {
    constexpr int frontal_delaunay = 6, delaunay = 5, mesh_adapt = 1;
    std::string defect;
    std::vector<Point_2> most_points = m_segmented.points;
    for (const int algorithm : {frontal_delaunay, delaunay, mesh_adapt}) {
      try {
        run(algorithm, points, triangles, regions);
        defect = orient_and_find_defect(points, triangles, regions);
      } catch (const Invalid_input_error& error) {
        defect = error.what();
      }
      if (defect.empty())
        return;
      if (points.size() > most_points.size())
        most_points = points;
    }
    points = std::move(most_points);
    Retriangulation(points, m_segmented.segments, surfaces_of_segments()).collect(triangles, regions);
    defect = orient_and_find_defect(points, triangles, regions);
    if (defect.empty())
      return;
    throw Invalid_input_error(m_path + ": the surfaces cannot be triangulated: " + defect);
  }

private:
  void run(int algorithm, std::vector<Point_2>& points, std::vector<std::array<int, 3>>& triangles,
           std::vector<int>& regions) const
  {
    const Gmsh_session session;
    Gmsh_session::call("Gmsh", [&] {
      add_model();
      set_options(algorithm);
      gmsh::model::mesh::generate(2);
      gmsh::model::mesh::removeSizeCallback();
      collect(points, triangles, regions);
    });
    const std::string error = session.first_error();
    if (!error.empty())
      throw Invalid_input_error(error);
  }

  /// Turns surfaces whose triangles are all clockwise; says what is wrong with the triangles otherwise.
  std::string orient_and_find_defect(const std::vector<Point_2>& points, std::vector<std::array<int, 3>>& triangles,
                                     const std::vector<int>& regions) const
  {
    std::vector<CGAL::Orientation> of_surface(m_outline.surfaces.size(), CGAL::COLLINEAR);
    std::set<std::pair<int, int>> edges;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      std::array<int, 3>& corners = triangles[t];
      const CGAL::Orientation orientation = CGAL::orientation(
          points[std::size_t(corners[0])], points[std::size_t(corners[1])], points[std::size_t(corners[2])]);
      CGAL::Orientation& expected = of_surface[std::size_t(regions[t])];
      expected = expected == CGAL::COLLINEAR ? orientation : expected;
      if (orientation == CGAL::COLLINEAR || orientation != expected)
        return "degenerate or inverted triangles in surface " + tag_text(regions[t]);
      if (orientation == CGAL::CLOCKWISE)
        std::swap(corners[1], corners[2]);
      for (std::size_t i = 0; i < 3; ++i)
        if (!edges.emplace(corners[i], corners[(i + 1) % 3]).second)
          return "surface " + tag_text(regions[t]) + " overlaps itself or another surface";
    }
    for (std::size_t s = 0; s < m_segmented.segments.size(); ++s) {
      const std::array<int, 2>& ends = m_segmented.segments[s].ends;
      if (!edges.count({ends[0], ends[1]}) && !edges.count({ends[1], ends[0]}))
        return "a part of curve " +
               std::to_string(m_outline.curves[std::size_t(m_segmented.curve_of_segment[s])].label.tag) + " is lost";
    }
    return {};
  }

  std::vector<std::vector<int>> surfaces_of_segments() const
  {
    std::vector<std::vector<int>> surfaces(m_segmented.segments.size());
    for (std::size_t f = 0; f < m_outline.surfaces.size(); ++f)
      for (const int c : m_outline.surfaces[f].boundary)
        for (const int s : m_segmented.segments_of_curve[std::size_t(c)])
          surfaces[std::size_t(s)].push_back(int(f));
    return surfaces;
  }

  std::string tag_text(int surface) const { return std::to_string(m_outline.surfaces[std::size_t(surface)].label.tag); }

  void add_model() const
  {
    gmsh::model::add("outline");
    for (std::size_t i = 0; i < m_segmented.points.size(); ++i)
      gmsh::model::geo::addPoint(m_segmented.points[i].x(), m_segmented.points[i].y(), 0, 0, int(i) + 1);
    for (std::size_t s = 0; s < m_segmented.segments.size(); ++s) {
      const std::array<int, 2>& ends = m_segmented.segments[s].ends;
      gmsh::model::geo::addLine(ends[0] + 1, ends[1] + 1, int(s) + 1);
      gmsh::model::geo::mesh::setTransfiniteCurve(int(s) + 1, 2);
    }
    int n_loops = 0;
    for (std::size_t f = 0; f < m_outline.surfaces.size(); ++f) {
      std::vector<int> loop_tags;
      for (const std::vector<int>& loop : loops_of(m_outline.surfaces[f])) {
        gmsh::model::geo::addCurveLoop(loop, ++n_loops);
        loop_tags.push_back(n_loops);
      }
      gmsh::model::geo::addPlaneSurface(loop_tags, int(f) + 1);
    }
    gmsh::model::geo::synchronize();
    for (std::size_t f = 0; f < m_outline.surfaces.size(); ++f) {
      std::vector<int> embedded;
      for (const int c : m_outline.surfaces[f].embedded)
        for (const int s : m_segmented.segments_of_curve[std::size_t(c)])
          embedded.push_back(s + 1);
      if (!embedded.empty())
        gmsh::model::mesh::embed(1, embedded, 2, int(f) + 1);
    }
  }

  /// Closed loops of signed segment tags that use each boundary segment once, the one with the largest box first.
  std::vector<std::vector<int>> loops_of(const Outline::Surface& surface) const
  {
    std::map<int, std::vector<int>> leaving; // point -> signed segment tags
    std::vector<int> order;
    for (const int c : surface.boundary)
      for (const int s : m_segmented.segments_of_curve[std::size_t(c)]) {
        leaving[m_segmented.segments[std::size_t(s)].ends[0]].push_back(s + 1);
        leaving[m_segmented.segments[std::size_t(s)].ends[1]].push_back(-(s + 1));
        order.push_back(s + 1);
      }
    std::map<int, bool> used;
    std::vector<std::pair<double, std::vector<int>>> loops;
    for (const int seed : order) {
      if (used[seed])
        continue;
      std::vector<int> loop{seed};
      used[seed] = true;
      CGAL::Bbox_2 box;
      const int start = end(-seed);
      for (int point = end(seed); point != start; point = end(loop.back())) {
        box += m_segmented.points[std::size_t(point)].bbox();
        const std::vector<int>& candidates = leaving[point];
        const auto next = std::find_if(candidates.begin(), candidates.end(),
                                       [&](int candidate) { return !used[std::abs(candidate)]; });
        used[std::abs(*next)] = true; // exists: every point has an even number of segments
        loop.push_back(*next);
      }
      box += m_segmented.points[std::size_t(start)].bbox();
      loops.emplace_back((box.xmax() - box.xmin()) + (box.ymax() - box.ymin()), std::move(loop));
    }
    std::stable_sort(loops.begin(), loops.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<std::vector<int>> result;
    for (auto& [size, loop] : loops)
      result.push_back(std::move(loop));
    return result;
  }

  /// The point where a signed segment ends.
  int end(int signed_tag) const
  {
    return m_segmented.segments[std::size_t(std::abs(signed_tag) - 1)].ends[signed_tag > 0 ? 1 : 0];
  }

  void set_options(int algorithm) const
  {
    gmsh::option::setNumber("Mesh.Algorithm", algorithm);
    gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
    gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
    gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", 0);
    gmsh::option::setNumber("Mesh.MaxNumThreads2D", 1);
    gmsh::model::mesh::setSizeCallback([this](int, int, double x, double y, double) { return m_field(Point_2(x, y)); });
  }

  void collect(std::vector<Point_2>& points, std::vector<std::array<int, 3>>& triangles,
               std::vector<int>& regions) const
  {
    points = m_segmented.points;
    triangles.clear();
    regions.clear();
    std::map<std::size_t, int> index;
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parameters;
    for (std::size_t i = 0; i < points.size(); ++i) {
      gmsh::model::mesh::getNodes(tags, coordinates, parameters, 0, int(i) + 1);
      if (!tags.empty())
        index[tags[0]] = int(i);
    }
    for (std::size_t f = 0; f < m_outline.surfaces.size(); ++f) {
      gmsh::model::mesh::getNodes(tags, coordinates, parameters, 2, int(f) + 1);
      for (std::size_t i = 0; i < tags.size(); ++i) {
        index[tags[i]] = int(points.size());
        points.emplace_back(coordinates[3 * i], coordinates[3 * i + 1]);
      }
      std::vector<std::size_t> elements, nodes; // Gmsh takes vectors that are not empty as preallocated
      gmsh::model::mesh::getElementsByType(2, elements, nodes, int(f) + 1);
      for (std::size_t i = 0; i + 2 < nodes.size(); i += 3) {
        std::array<int, 3> triangle;
        for (std::size_t k = 0; k < 3; ++k) {
          const auto found = index.find(nodes[i + k]);
          if (found == index.end())
            throw Invalid_input_error("a boundary segment of surface " + tag_text(int(f)) + " was split");
          triangle[k] = found->second;
        }
        triangles.push_back(triangle);
        regions.push_back(int(f));
      }
    }
  }

  const Outline& m_outline;
  const Segmented_outline& m_segmented;
  const Triangle_size_field<Point_2>& m_field;
  const std::string& m_path;
};

} // namespace internal
} // namespace Quadrille

#endif
