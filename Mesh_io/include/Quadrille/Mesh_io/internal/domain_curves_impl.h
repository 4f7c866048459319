// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_DOMAIN_CURVES_IMPL_H
#define QUADRILLE_MESH_IO_INTERNAL_DOMAIN_CURVES_IMPL_H

#include <Quadrille/domain_curves.h>
#include <Quadrille/exceptions.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {

template <class Point> std::vector<int> curves_named(const Triangulated_domain<Point>& domain, const std::string& name)
{
  std::vector<int> by_name, by_tag;
  for (std::size_t c = 0; c < domain.curves.size(); ++c) {
    const Entity_label& curve = domain.curves[c];
    if (std::find(curve.names.begin(), curve.names.end(), name) != curve.names.end())
      by_name.push_back(int(c));
    if (std::to_string(curve.tag) == name)
      by_tag.push_back(int(c));
  }
  return by_name.empty() ? by_tag : by_name;
}

template <class Point> std::string list_of_curve_names(const Triangulated_domain<Point>& domain)
{
  std::set<std::string> names;
  std::set<int> tags;
  for (const Entity_label& curve : domain.curves) {
    names.insert(curve.names.begin(), curve.names.end());
    tags.insert(curve.tag);
  }
  std::string text = names.empty() ? "no physical groups of curves" : "physical groups";
  for (const std::string& name : names)
    text += (name == *names.begin() ? " " : ", ") + name;
  text += "; curve tags";
  int n = 0;
  for (const int tag : tags) {
    if (n == 20) {
      text += ", ... (" + std::to_string(tags.size()) + " in all)";
      break;
    }
    text += (n++ == 0 ? " " : ", ") + std::to_string(tag);
  }
  return text;
}

template <class Point> void remove_curves(Triangulated_domain<Point>& domain, const std::vector<int>& curves)
{
  using Domain = Triangulated_domain<Point>;
  std::vector<int> new_index(domain.curves.size(), 0);
  for (const int c : curves) {
    const typename Domain::Curve& curve = domain.curves[std::size_t(c)];
    for (const auto h : curve.path) {
      const auto f = domain.mesh.face(h), g = domain.mesh.face(domain.mesh.opposite(h));
      const bool is_border = f == Domain::Mesh::null_face() || g == Domain::Mesh::null_face();
      if (is_border || domain.face_region[std::size_t(f.idx())] != domain.face_region[std::size_t(g.idx())])
        throw Invalid_argument_error("curve " + std::to_string(curve.tag) + " of " + domain.source + " is " +
                                     (is_border ? "on the border" : "between two regions") +
                                     ", so elements have to follow it");
    }
    new_index[std::size_t(c)] = -1;
  }
  std::vector<typename Domain::Curve> left;
  for (std::size_t c = 0; c < new_index.size(); ++c)
    if (new_index[c] >= 0) {
      new_index[c] = int(left.size());
      left.push_back(std::move(domain.curves[c]));
    }
  domain.curves = std::move(left);
  for (std::size_t e = 0; e < domain.edge_curve.size(); ++e) {
    int& curve = domain.edge_curve[e];
    curve = curve >= 0 ? new_index[std::size_t(curve)] : -1;
    if (curve < 0)
      domain.edge_chain[e] = -1;
  }
}

} // namespace Quadrille

#endif
