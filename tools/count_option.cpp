// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "count_option.h"

#include <Quadrille/domain_curves.h>
#include <Quadrille/exceptions.h>

#include <charconv>
#include <map>

namespace Quadrille {

Count_request parse_count(const std::string& text)
{
  Count_request request;
  const std::size_t sign = text.rfind('=');
  if (sign != std::string::npos) {
    request.name = text.substr(0, sign);
    const char* end = text.data() + text.size();
    const auto [rest, code] = std::from_chars(text.data() + sign + 1, end, request.count);
    if (code != std::errc() || rest != end)
      request.count = 0;
  }
  if (request.name.empty() || request.count <= 0)
    throw Invalid_argument_error("option --count: '" + text + "' is not NAME=N with a positive whole number N");
  return request;
}

template <class Domain>
std::vector<Curve_count> split_off_counted_curves(const std::vector<Count_request>& requests, Domain& domain)
{
  std::vector<Curve_count> counts;
  std::map<int, std::string> request_of; // by curve
  for (const Count_request& request : requests) {
    const std::vector<int> curves = curves_named(domain, request.name);
    if (curves.empty())
      throw Invalid_argument_error("option --count: there is no curve named '" + request.name + "' in " +
                                   domain.source + " (" + list_of_curve_names(domain) + ")");
    std::map<int, int> new_chain; // by old chain
    for (const int c : curves) {
      const auto [place, is_new] = request_of.emplace(c, request.name);
      typename Domain::Curve& curve = domain.curves[std::size_t(c)];
      if (!is_new)
        throw Invalid_argument_error("option --count: numbers of elements are asked for on '" + place->second +
                                     "' and on '" + request.name + "', which have the curve with tag " +
                                     std::to_string(curve.tag) + " in common");
      curve.chain = new_chain.emplace(curve.chain, domain.number_of_chains + int(new_chain.size())).first->second;
      for (const auto h : curve.path)
        domain.edge_chain[std::size_t(domain.mesh.edge(h).idx())] = curve.chain;
    }
    domain.number_of_chains += int(new_chain.size());
    counts.push_back({{}, request.count, "'" + request.name + "'"});
    for (const auto& [old_chain, chain] : new_chain)
      counts.back().curves.push_back(chain);
  }
  return counts;
}

template std::vector<Curve_count> split_off_counted_curves(const std::vector<Count_request>&, Planar_domain&);
template std::vector<Curve_count> split_off_counted_curves(const std::vector<Count_request>&, Surface_domain&);

} // namespace Quadrille
