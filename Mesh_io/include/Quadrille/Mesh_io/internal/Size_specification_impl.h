// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_SIZE_SPECIFICATION_IMPL_H
#define QUADRILLE_MESH_IO_INTERNAL_SIZE_SPECIFICATION_IMPL_H

#include <Quadrille/Mesh_io/internal/Round_curve_sizes.h>
#include <Quadrille/Mesh_io/internal/vector_length.h>
#include <Quadrille/Size_specification.h>
#include <Quadrille/domain_curves.h>
#include <Quadrille/exceptions.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <locale>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace Quadrille {
namespace internal {

/// A positive finite number that takes up all of `text`, or 0 for `free`. Decimal point whatever the locale.
inline double parse_size(const std::string& text, const std::string& item)
{
  if (text == "free")
    return 0;
  double value = 0;
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  if (!(stream >> value) || !(stream >> std::ws).eof())
    throw Invalid_argument_error("size '" + item + "': '" + text + "' is not a number");
  if (!std::isfinite(value) || value <= 0)
    throw Invalid_argument_error("size '" + item + "': element sizes must be positive, '" + text + "' is not");
  return value;
}

/// `S` or `NxT`.
inline Frame_size parse_frame_size(const std::string& text, const std::string& item)
{
  const std::size_t times = text.find('x');
  if (times == std::string::npos)
    return parse_size(text, item);
  return {parse_size(text.substr(0, times), item), parse_size(text.substr(times + 1), item)};
}

inline std::string format_number(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// Curves that join end to end, with the direction in which each is passed.
struct Curve_sequence {
  std::vector<std::pair<int, bool>> curves; ///< index, forward
  bool closed = false;
};

/// Arranges some curves of a domain in sequences. \returns false if more than two of them meet in a point.
template <class Point>
bool arrange_in_sequences(const Triangulated_domain<Point>& domain, const std::vector<int>& curves,
                          std::vector<Curve_sequence>& sequences)
{
  using Domain = Triangulated_domain<Point>;
  using Vertex = typename Domain::vertex_descriptor;
  std::map<Vertex, std::vector<int>> curves_at;
  for (const int c : curves) {
    curves_at[domain.curves[std::size_t(c)].first].push_back(c);
    curves_at[domain.curves[std::size_t(c)].last].push_back(c);
  }
  for (const auto& [vertex, incident] : curves_at)
    if (incident.size() > 2)
      return false;
  std::vector<int> by_tag = curves;
  std::stable_sort(by_tag.begin(), by_tag.end(),
                   [&](int a, int b) { return domain.curves[std::size_t(a)].tag < domain.curves[std::size_t(b)].tag; });
  std::set<int> done;
  for (const int seed : by_tag) {
    if (!done.insert(seed).second)
      continue;
    Curve_sequence sequence;
    const auto extend = [&](Vertex at, bool ahead) {
      for (;;) {
        const std::vector<int>& incident = curves_at[at];
        const auto next = std::find_if(incident.begin(), incident.end(), [&](int c) { return !done.count(c); });
        if (next == incident.end())
          return at;
        done.insert(*next);
        const typename Domain::Curve& curve = domain.curves[std::size_t(*next)];
        const bool leaves = curve.first == at;
        if (ahead)
          sequence.curves.emplace_back(*next, leaves);
        else
          sequence.curves.insert(sequence.curves.begin(), {*next, !leaves});
        at = leaves ? curve.last : curve.first;
      }
    };
    sequence.curves.emplace_back(seed, true);
    const Vertex end = extend(domain.curves[std::size_t(seed)].last, true);
    const Vertex begin = extend(domain.curves[std::size_t(seed)].first, false);
    sequence.closed = begin == end;
    sequences.push_back(std::move(sequence));
  }
  return true;
}

/// Writes sizes edge by edge.
template <class Point> class Size_setter {
public:
  using Domain = Triangulated_domain<Point>;

  Size_setter(const Domain& domain, Domain_sizes& sizes) : m_domain(domain), m_sizes(sizes) {}

  /// From `first` to `last`, linear in the arc length of the whole sequence.
  void set_linear(const Curve_sequence& sequence, const Frame_size& first, const Frame_size& last)
  {
    const auto between = [&](double t) {
      return Frame_size(first.normal + (last.normal - first.normal) * t,
                        first.tangential + (last.tangential - first.tangential) * t);
    };
    double length = 0;
    for (const auto& [c, forward] : sequence.curves)
      length += curve_length(c);
    double s = 0;
    for (const auto& [c, forward] : sequence.curves) {
      const auto& path = m_domain.curves[std::size_t(c)].path;
      for (std::size_t i = 0; i < path.size(); ++i) {
        const auto h = forward ? path[i] : m_domain.mesh.opposite(path[path.size() - 1 - i]);
        const double next = s + edge_length(h);
        const bool is_end = c == sequence.curves.back().first && i + 1 == path.size();
        set(h, between(s / length), is_end ? last : between(next / length));
        s = next;
      }
    }
  }

  /// Along all curves. \param at_vertex indexed by the descriptors of the domain's mesh
  void set_at_vertices(const std::vector<double>& at_vertex)
  {
    for (const auto& curve : m_domain.curves)
      for (const auto h : curve.path)
        set(h, at_vertex[std::size_t(m_domain.mesh.source(h).idx())],
            at_vertex[std::size_t(m_domain.mesh.target(h).idx())]);
  }

  void set_constant(int c, const Frame_size& size)
  {
    for (const auto h : m_domain.curves[std::size_t(c)].path)
      set(h, size, size);
  }

  void scale(double factor)
  {
    for (std::array<Frame_size, 2>& ends : m_sizes.of_edge)
      for (Frame_size& size : ends)
        size = {factor * size.normal, factor * size.tangential};
  }

private:
  void set(typename Domain::halfedge_descriptor h, const Frame_size& at_source, const Frame_size& at_target)
  {
    // The halfedge of `mesh.edge(h)` is `h`; sizes follow those of the edges as `mesh.edges()` has them.
    const typename Domain::edge_descriptor e(m_domain.mesh.edge(h).idx());
    std::array<Frame_size, 2>& size = m_sizes.of_edge[std::size_t(e.idx())];
    size = {at_source, at_target};
    if (m_domain.mesh.halfedge(e) != h)
      std::swap(size[0], size[1]);
  }

  double edge_length(typename Domain::halfedge_descriptor h) const
  {
    return length_of(m_domain.mesh.point(m_domain.mesh.target(h)) - m_domain.mesh.point(m_domain.mesh.source(h)));
  }
  double curve_length(int c) const
  {
    double length = 0;
    for (const auto h : m_domain.curves[std::size_t(c)].path)
      length += edge_length(h);
    return length;
  }

  const Domain& m_domain;
  Domain_sizes& m_sizes;
};

/// Whether a name is that of a physical group of curves; otherwise it can only be a tag.
template <class Point> bool is_group_of_curves(const Triangulated_domain<Point>& domain, const std::string& name)
{
  return std::any_of(domain.curves.begin(), domain.curves.end(), [&](const Entity_label& curve) {
    return std::find(curve.names.begin(), curve.names.end(), name) != curve.names.end();
  });
}

/// Sizes that the file gives at points, along curves that have one at both ends.
template <class Point> int apply_point_sizes(const Triangulated_domain<Point>& domain, Size_setter<Point>& setter)
{
  int n = 0;
  for (std::size_t c = 0; c < domain.curves.size(); ++c) {
    const double first = domain.point_size[std::size_t(domain.curves[c].first.idx())];
    const double last = domain.point_size[std::size_t(domain.curves[c].last.idx())];
    if (first > 0 && last > 0) {
      setter.set_linear({{{int(c), true}}, domain.curves[c].closed}, first, last);
      ++n;
    }
  }
  return n;
}

template <class Point> double default_size(const Triangulated_domain<Point>& domain)
{
  decltype(domain.mesh.point({}).bbox()) box;
  for (const auto v : domain.mesh.vertices())
    box += domain.mesh.point(v).bbox();
  return diagonal_of(box) / 40;
}

} // namespace internal

inline void Size_specification::add(const std::string& text)
{
  Item item;
  item.text = text;
  const std::size_t equals = text.rfind('=');
  const std::string value = equals == std::string::npos ? text : text.substr(equals + 1);
  if (equals != std::string::npos) {
    item.name = text.substr(0, equals);
    if (item.name.empty())
      throw Invalid_argument_error("size '" + text + "': there is no name before '='");
  }
  const std::size_t colon = value.find(':');
  if (item.name.empty() && colon != std::string::npos)
    throw Invalid_argument_error("size '" + text + "': A:B needs the name of a curve, as in NAME=" + text);
  item.first = item.last = internal::parse_frame_size(value.substr(0, colon), text);
  if (colon != std::string::npos)
    item.last = internal::parse_frame_size(value.substr(colon + 1), text);
  if ((item.first.normal > 0) != (item.last.normal > 0) || (item.first.tangential > 0) != (item.last.tangential > 0))
    throw Invalid_argument_error("size '" + text + "': what is free at one end has to be free at the other");
  m_items.push_back(std::move(item));
}

template <class Point> double Size_specification::typical_size(const Triangulated_domain<Point>& domain) const
{
  for (const Item& item : m_items)
    if (item.name.empty() && !item.first.is_free())
      return item.first.tangential > 0 ? item.first.tangential : item.first.normal;
  return internal::default_size(domain);
}

inline std::string Size_specification::anisotropic_item() const
{
  for (const Item& item : m_items)
    for (const Frame_size& size : {item.first, item.last})
      if (size.normal != size.tangential && size.normal > 0 && size.tangential > 0)
        return item.text;
  return {};
}

inline std::map<std::string, double> Size_specification::thin_curves() const
{
  std::map<std::string, double> result;
  for (const Item& item : m_items)
    for (const Frame_size& size : {item.first, item.last})
      if (size.normal > 0 && size.normal < size.tangential) {
        const auto place = result.emplace(item.name, size.normal).first;
        place->second = std::min(place->second, size.normal);
      }
  return result;
}

template <class Point>
Domain_sizes Size_specification::apply(const Triangulated_domain<Point>& domain, double factor) const
{
  Domain_sizes sizes;
  sizes.of_edge.resize(domain.mesh.number_of_edges());
  internal::Size_setter<Point> setter(domain, sizes);

  const Item* everywhere = nullptr;
  for (const Item& item : m_items)
    if (item.name.empty()) {
      if (everywhere && !everywhere->is_same_size(item))
        throw Invalid_argument_error("sizes '" + everywhere->text + "' and '" + item.text +
                                     "' contradict each other: both are for every curve");
      everywhere = &item;
    }
  if (everywhere) {
    for (std::size_t c = 0; c < domain.curves.size(); ++c)
      setter.set_constant(int(c), everywhere->first);
  } else if (const int n = internal::apply_point_sizes(domain, setter)) {
    sizes.notes.push_back("element sizes from the points of the file, on " + std::to_string(n) + " of " +
                          std::to_string(domain.curves.size()) + " curves");
  } else if (m_items.empty()) {
    const double size = factor * internal::default_size(domain);
    const std::vector<double> at_vertex = internal::Round_curve_sizes<Point>(domain, size).run();
    setter.set_at_vertices(at_vertex);
    sizes.by_default = true;
    const double least = at_vertex.empty() ? size : *std::min_element(at_vertex.begin(), at_vertex.end());
    sizes.notes.push_back(
        "element size " + internal::format_number(size) + (factor == 1 ? " (bounding box diagonal / 40)" : "") +
        (least < size ? ", at round curves down to " + internal::format_number(least) : " everywhere"));
    return sizes;
  }

  // Groups first: what is said of a curve by its tag is more special.
  std::vector<const Item*> named;
  for (const Item& item : m_items)
    if (!item.name.empty())
      named.push_back(&item);
  const auto first_tag = std::stable_partition(
      named.begin(), named.end(), [&](const Item* item) { return internal::is_group_of_curves(domain, item->name); });
  std::vector<const Item*> item_of_curve(domain.curves.size(), nullptr);
  for (auto place = named.begin(); place != named.end(); ++place) {
    const Item& item = **place;
    if (place == first_tag)
      item_of_curve.assign(domain.curves.size(), nullptr);
    const std::vector<int> curves = curves_named(domain, item.name);
    if (curves.empty())
      throw Invalid_argument_error("size '" + item.text + "': there is no curve named '" + item.name + "' in " +
                                   domain.source + " (" + list_of_curve_names(domain) + ")");
    for (const int c : curves) {
      const Item*& other = item_of_curve[std::size_t(c)];
      if (other && !other->is_same_size(item))
        throw Invalid_argument_error("sizes '" + other->text + "' and '" + item.text +
                                     "' contradict each other: both are for curve " +
                                     std::to_string(domain.curves[std::size_t(c)].tag) + " of " + domain.source);
      other = &item;
    }
    std::vector<internal::Curve_sequence> sequences;
    if (item.is_constant()) {
      for (const int c : curves)
        setter.set_constant(c, item.first);
    } else if (!internal::arrange_in_sequences(domain, curves, sequences)) {
      throw Invalid_argument_error("size '" + item.text + "': the curves named '" + item.name +
                                   "' branch, so that they have no first and last point; name them one by one");
    }
    for (const internal::Curve_sequence& sequence : sequences) {
      if (sequence.closed)
        throw Invalid_argument_error("size '" + item.text + "': the curve is closed, so that two different sizes " +
                                     "would meet in one point; give one size");
      setter.set_linear(sequence, item.first, item.last);
    }
  }
  setter.scale(factor);
  return sizes;
}

} // namespace Quadrille

#endif
