// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_QUAD_EXTRACTION_INTERNAL_MOTORCYCLES_H
#define QUADRILLE_QUAD_EXTRACTION_INTERNAL_MOTORCYCLES_H

#include <Quadrille/Quad_extraction/internal/Trace_crossings.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal::extraction {

/// Isolines that leave layout vertices through all ports at the same time and with the same speed, and stop where they
/// meet what another one left behind, a curve or a layout vertex (Eppstein et al., "Motorcycle graphs: canonical quad
/// mesh partitioning", 2008).
///
/// Who comes first is decided by exact map lengths, then by index. Opposite isolines from two layout vertices to each
/// other are one trace. A perpendicular isoline stops the one that arrives later only if it goes on beyond the crossing
/// itself: otherwise it has ended there on another isoline, the one that the arriving one runs along.
class Motorcycles {
public:
  /// All arguments must outlive the object.
  Motorcycles(const Seamless_map& map, const Layout_vertices& vertices, const Isoline_tracer& tracer)
      : m_map(map), m_vertices(vertices), m_tracer(tracer), m_steps_in(std::size_t(map.mesh().number_of_faces()))
  {
  }

  /// Lets those of the vertices from `first_vertex` on ride, after all earlier ones. Complexity: the number of
  /// triangles passed times the logarithm of the number of traces, plus the pairs of traces met in a triangle.
  void ride(int first_vertex)
  {
    for (int v = first_vertex; v < m_vertices.size(); ++v)
      for (const Layout_vertices::Port& port : m_vertices[v].ports) {
        auto [trace, front] = m_tracer.start(v, port);
        at_port(v, port.slot) = size_of(m_riders);
        m_riders.push_back({std::move(trace), front, m_round, std::numeric_limits<double>::infinity(), false});
        add_step(size_of(m_riders) - 1);
      }
    while (!m_events.empty()) {
      const Event event = m_events.top();
      m_events.pop();
      if (event.is_meeting)
        meet(event);
      else if (at(m_riders, event.rider).length > event.time)
        add_step(event.rider);
    }
    ++m_round;
  }

  /// The traces, each between two vertices once. The object is empty afterwards.
  std::vector<Trace> take_traces()
  {
    std::vector<Trace> traces;
    for (int r = 0; r < size_of(m_riders); ++r) {
      Rider& rider = at(m_riders, r);
      if (rider.stopped) {
        rider.trace.length = rider.length;
        rider.trace.target = -1;
      } else if (rider.trace.target >= 0) {
        const int reverse = at_port(rider.trace.target, rider.trace.target_slot);
        if (reverse >= 0 && reverse < r)
          continue;
      }
      traces.push_back(std::move(rider.trace));
    }
    m_riders.clear();
    return traces;
  }

  /// Calls `f(step)` for the last steps of traces that end on curves.
  template <class Function> void for_each_arrival(Function f) const
  {
    for (const Rider& rider : m_riders)
      if (!rider.stopped && rider.trace.steps.back().exit >= 0)
        f(rider.trace.steps.back());
  }

private:
  struct Rider {
    Trace trace;
    Isoline_tracer::Front front;
    int round;
    double length; ///< infinite as long as it rides
    bool stopped;  ///< by another one
  };
  /// A rider enters its next triangle at `time` or later, or arrives at `time` where another one was at
  /// `time_of_other`.
  struct Event {
    double time;
    bool is_meeting;
    int round_of_other;
    double time_of_other;
    int rider;
    int other;

    bool operator>(const Event& e) const
    {
      return std::tie(time, is_meeting, round_of_other, time_of_other, other, rider) >
             std::tie(e.time, e.is_meeting, e.round_of_other, e.time_of_other, e.other, e.rider);
    }
  };

  int& at_port(int vertex, int slot) { return m_rider_of_port.emplace(std::pair(vertex, slot), -1).first->second; }

  void add_step(int r)
  {
    Rider& rider = at(m_riders, r);
    const bool goes_on = m_tracer.advance(m_vertices, true, rider.trace, rider.front);
    const int s = size_of(rider.trace.steps) - 1;
    const int face = rider.trace.steps.back().face;
    for (const auto& [other, other_step] : at(m_steps_in, face))
      add_meeting({other, other_step}, {r, s});
    at(m_steps_in, face).emplace_back(r, s);
    if (!goes_on) {
      rider.length = rider.trace.length;
      return;
    }
    double entry = std::numeric_limits<double>::infinity(); // a lower bound, exact
    for (int h = 3 * rider.front.step.face; h < 3 * rider.front.step.face + 3; ++h)
      entry = std::min(entry, rider.front.step.position(m_map.uv(h)));
    m_events.push({entry, false, 0, 0, r, r});
  }

  const Isoline_step& step(const std::pair<int, int>& p) const
  {
    return at(at(m_riders, p.first).trace.steps, p.second);
  }

  void add_meeting(std::pair<int, int> first, std::pair<int, int> second)
  {
    if (second < first)
      std::swap(first, second);
    const auto crossing = crossing_of(m_map, step(first), step(second));
    if (!crossing || crossing->position[0] <= 0 || crossing->position[1] <= 0)
      return;
    auto early = std::tuple(at(m_riders, first.first).round, crossing->position[0], first.first);
    auto late = std::tuple(at(m_riders, second.first).round, crossing->position[1], second.first);
    if (late < early)
      std::swap(early, late);
    m_events.push(
        {std::get<1>(late), true, std::get<0>(early), std::get<1>(early), std::get<2>(late), std::get<2>(early)});
  }

  void meet(const Event& event)
  {
    Rider& rider = at(m_riders, event.rider);
    if (rider.length <= event.time || at(m_riders, event.other).length <= event.time_of_other)
      return;
    rider.length = event.time;
    rider.stopped = true;
  }

  const Seamless_map& m_map;
  const Layout_vertices& m_vertices;
  const Isoline_tracer& m_tracer;
  std::vector<Rider> m_riders;
  std::map<std::pair<int, int>, int> m_rider_of_port;       ///< by vertex and slot
  std::vector<std::vector<std::pair<int, int>>> m_steps_in; ///< by triangle: rider and step
  std::priority_queue<Event, std::vector<Event>, std::greater<>> m_events;
  int m_round = 0;
};

} // namespace internal::extraction
} // namespace Quadrille

#endif
