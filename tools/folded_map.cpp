// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "folded_map.h"

#include <algorithm>
#include <set>
#include <sstream>
#include <vector>

namespace Quadrille {

namespace {

using Mesh = Surface_domain::Mesh;
using Vertex = Surface_domain::vertex_descriptor;
using Face = Surface_domain::face_descriptor;

std::string name_of(const Entity_label& entity)
{
  return entity.names.empty() ? std::to_string(entity.tag) : "'" + entity.names.front() + "'";
}

/// The vertex and its neighbours.
void add_neighbours(const Mesh& mesh, Vertex v, std::set<Vertex>& vertices)
{
  vertices.insert(v);
  for (const auto h : mesh.halfedges_around_target(mesh.halfedge(v)))
    vertices.insert(mesh.source(h));
}

/// The coordinates of `v`, the surface of `f`, and the curves nearby.
void describe_place(const Surface_domain& domain, Vertex v, Face f, std::ostream& text)
{
  const Surface_domain::Point_3& p = domain.mesh.point(v);
  text << '(' << p.x() << ", " << p.y() << ", " << p.z() << ')';
  const int region = domain.face_region[std::size_t(f.idx())];
  if (region >= 0)
    text << " on surface " << name_of(domain.regions[std::size_t(region)]);
  std::set<Vertex> nearby;
  std::set<int> curves;
  add_neighbours(domain.mesh, v, nearby);
  for (const Vertex w : nearby)
    for (const auto h : domain.mesh.halfedges_around_target(domain.mesh.halfedge(w)))
      if (const int curve = domain.edge_curve[std::size_t(domain.mesh.edge(h).idx())]; curve >= 0)
        curves.insert(curve);
  const char* separator = curves.size() > 1 ? " near curves " : " near curve ";
  for (const int curve : curves) {
    text << separator << name_of(domain.curves[std::size_t(curve)]);
    separator = ", ";
  }
}

/// One face each of connected sets of faces.
std::vector<Face> first_faces(const Mesh& mesh, const std::vector<Face>& faces)
{
  std::vector<Face> first;
  std::set<Vertex> seen;
  for (const Face f : faces) {
    const auto around = mesh.vertices_around_face(mesh.halfedge(f));
    if (std::none_of(around.begin(), around.end(), [&](Vertex v) { return seen.count(v) > 0; }))
      first.push_back(f);
    seen.insert(around.begin(), around.end());
  }
  return first;
}

} // namespace

std::string reason_of_folded_map(const Surface_domain& domain, const Seamless_map<Mesh>& map)
{
  constexpr std::size_t most_places = 3;
  const Mesh& mesh = domain.mesh;
  std::vector<Face> faces = map.flipped_faces;
  std::ostringstream text;
  text.precision(6);
  if (faces.empty()) {
    text << "the map covers the surroundings of " << map.misturned_vertices.size() << " vertices more than once";
    for (const Vertex v : map.misturned_vertices)
      faces.push_back(mesh.face(mesh.is_border(mesh.halfedge(v)) ? mesh.opposite(mesh.halfedge(v)) : mesh.halfedge(v)));
  } else {
    text << faces.size() << (faces.size() == 1 ? " triangle" : " triangles") << " of the map cannot be unfolded";
  }
  const std::vector<Face> places = first_faces(mesh, faces);
  for (std::size_t i = 0; i < std::min(places.size(), most_places); ++i) {
    text << (i == 0 ? ", at " : "; at ");
    describe_place(domain, mesh.target(mesh.halfedge(places[i])), places[i], text);
  }
  if (places.size() > most_places)
    text << "; and at " << places.size() - most_places << " more places";
  return text.str();
}

} // namespace Quadrille
