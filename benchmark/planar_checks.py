# Copyright (c) 2026 The Quadrille authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks of planar domains and quad meshes that share no code with the program. Every decision is exact."""

import math
from fractions import Fraction

import planar_files


def orientation(a, b, c):
    """1 if a, b, c turn left, -1 if right, 0 if they are collinear."""
    left, right = (b[0] - a[0]) * (c[1] - a[1]), (b[1] - a[1]) * (c[0] - a[0])
    if abs(left - right) > 1e-15 * (abs(left) + abs(right)):
        return 1 if left > right else -1
    a, b, c = (tuple(map(Fraction, p)) for p in (a, b, c))
    value = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return (value > 0) - (value < 0)


def on_segment(p, a, b):
    """Whether p, collinear with a and b, lies between them (ends included)."""
    return min(a[0], b[0]) <= p[0] <= max(a[0], b[0]) and min(a[1], b[1]) <= p[1] <= max(a[1], b[1])


def conflict(a, b, c, d):
    """What is wrong with two segments of an outline: they may share one end and nothing else."""
    shared = {a, b} & {c, d}
    if len(shared) == 2:
        return "overlap"
    if len(shared) == 1:
        common = shared.pop()
        p, q = (b if a == common else a), (d if c == common else c)
        if orientation(common, p, q) == 0 and (on_segment(p, common, q) or on_segment(q, common, p)):
            return "overlap"
        return None
    turns = orientation(a, b, c), orientation(a, b, d), orientation(c, d, a), orientation(c, d, b)
    if turns[0] * turns[1] < 0 and turns[2] * turns[3] < 0:
        return "cross"
    for turn, p, s in zip(turns, (c, d, a, b), ((a, b), (a, b), (c, d), (c, d))):
        if turn == 0 and on_segment(p, *s):
            return "touch"
    return None


def find_conflict(segments):
    """The first two segments that cross, touch or overlap, as a sentence; None if there are none."""
    order = sorted(segments, key=lambda s: min(s[0][0], s[1][0]))
    active = []
    for s in order:
        x = min(s[0][0], s[1][0])
        low, high = min(s[0][1], s[1][1]), max(s[0][1], s[1][1])
        active = [t for t in active if t[0] >= x]
        for _, other_low, other_high, other in active:
            if other_low <= high and low <= other_high:
                kind = conflict(s[0], s[1], other[0], other[1])
                if kind:
                    return "segments {} near ({:.6g}, {:.6g})".format(kind, *s[0])
        active.append((max(s[0][0], s[1][0]), low, high, s))
    return None


def is_inside(p, ring):
    """Even-odd rule; p is not on the ring."""
    inside = False
    for i, b in enumerate(ring):
        a = ring[i - 1]
        if (a[1] > p[1]) != (b[1] > p[1]) and (orientation(a, b, p) > 0) == (b[1] > a[1]):
            inside = not inside
    return inside


def bounds(ring):
    return min(p[0] for p in ring), min(p[1] for p in ring), max(p[0] for p in ring), max(p[1] for p in ring)


def problem_of_rings(rings):
    if not rings or any(len(ring) < 3 for ring in rings):
        return "a ring with fewer than three points"
    seen = set()
    for ring in rings:
        for p in ring:
            if not (math.isfinite(p[0]) and math.isfinite(p[1])):
                return "a coordinate that is not finite"
            if p in seen:
                return "rings touch, or a ring touches itself, in ({:.6g}, {:.6g})".format(*p)
            seen.add(p)
    found = find_conflict([(ring[i - 1], ring[i]) for ring in rings for i in range(len(ring))])
    if found:
        return found
    boxes = [bounds(ring) for ring in rings]
    for h, hole in enumerate(rings[1:], 1):
        if not is_inside(hole[0], rings[0]):
            return "ring {} is not inside ring 0".format(h)
        for k in range(1, len(rings)):
            box = boxes[k]
            if k != h and box[0] < hole[0][0] < box[2] and box[1] < hole[0][1] < box[3] and is_inside(hole[0], rings[k]):
                return "hole {} is inside hole {}".format(h, k)
    return None


def components(polygons):
    parent = {}

    def root(v):
        parent.setdefault(v, v)
        while parent[v] != v:
            parent[v] = parent[parent[v]]
            v = parent[v]
        return v

    for polygon in polygons:
        for v in polygon[1:]:
            parent[root(v)] = root(polygon[0])
    return len({root(v) for v in list(parent)})


def problem_of_polygons(points, polygons):
    """Of a mesh of convex polygons: manifold, one component, consistently oriented, no overlaps."""
    used = {v for f in polygons for v in f}
    if not all(math.isfinite(x) for v in used for x in points[v]):
        return "a coordinate that is not finite"
    turns = [{orientation(points[f[i - 2]], points[f[i - 1]], points[f[i]]) for i in range(len(f))} for f in polygons]
    for f, signs in enumerate(turns):
        if len(signs) != 1 or 0 in signs:
            return "polygon {} is degenerate or not convex".format(f)
    polygons = [f if 1 in signs else f[::-1] for f, signs in zip(polygons, turns)]
    uses = set()
    for f in polygons:
        for i, b in enumerate(f):
            if (f[i - 1], b) in uses:
                return "an edge is in two polygons on its same side: the mesh is folded or not manifold"
            uses.add((f[i - 1], b))
    border = planar_files.border_edges(polygons)
    if planar_files.loops(border) is None:
        return "parts of the domain touch in a single point"
    if len({points[v] for v in used}) < len(used):
        return "two vertices have the same coordinates"
    found = find_conflict([(points[a], points[b]) for a, b in border])
    if found:
        return "border: " + found
    n = components(polygons)
    return "{} components".format(n) if n != 1 else None


def problem_of_domain(domain):
    if domain.problem:
        return domain.problem
    if domain.kind == "outline":
        return problem_of_rings(domain.rings)
    return problem_of_polygons(domain.points, domain.polygons)


# ---- quad meshes ----

class Segment_finder:
    """Distance from points to a set of segments, by a grid of cells."""

    def __init__(self, segments):
        xs = [p[0] for s in segments for p in s]
        ys = [p[1] for s in segments for p in s]
        self.low = min(xs), min(ys)
        extent = max(max(xs) - self.low[0], max(ys) - self.low[1])
        self.n = max(1, min(400, int(math.sqrt(len(segments)))))
        self.cell = extent / self.n or 1.0
        self.cells = {}
        for s in segments:
            (i0, j0), (i1, j1) = (self._index(min(s[0][k], s[1][k]) for k in range(2)),
                                  self._index(max(s[0][k], s[1][k]) for k in range(2)))
            for i in range(i0, i1 + 1):
                for j in range(j0, j1 + 1):
                    self.cells.setdefault((i, j), []).append(s)

    def _index(self, p):
        return tuple(max(0, min(self.n, int((x - low) / self.cell))) for x, low in zip(p, self.low))

    def nearest(self, p):
        """Distance, and the nearest segment."""
        i, j = self._index(p)
        best = (math.inf, None)
        for ring in range(self.n + 2):
            if best[0] <= (ring - 1) * self.cell:
                break
            for x in range(i - ring, i + ring + 1):
                for y in range(j - ring, j + ring + 1):
                    if max(abs(x - i), abs(y - j)) == ring:
                        for s in self.cells.get((x, y), ()):
                            d = distance_to_segment(p, s)
                            if d < best[0]:
                                best = (d, s)
        return best


def distance_to_segment(p, segment):
    a, b = segment
    ab, ap = (b[0] - a[0], b[1] - a[1]), (p[0] - a[0], p[1] - a[1])
    squared = ab[0] * ab[0] + ab[1] * ab[1]
    t = max(0.0, min(1.0, (ab[0] * ap[0] + ab[1] * ap[1]) / squared)) if squared > 0 else 0.0
    return math.hypot(ap[0] - t * ab[0], ap[1] - t * ab[1])


def problem_of_quads(points, polygons, domain):
    """Of a mesh that should be a valid quad mesh of `domain`: all quads, conforming, convex, its border on that of the
    domain, as many loops, the same area up to what chords cut off, and (for outlines) a vertex at every corner."""
    if any(len(f) != 4 for f in polygons):
        return "not all polygons are quads"
    found = problem_of_polygons(points, polygons)
    if found:
        return found
    border = planar_files.border_edges(polygons)
    segments = domain.border()
    finder = Segment_finder(domain.fine_border or segments)
    diagonal = domain.diagonal()
    for a, _ in border:
        distance, segment = finder.nearest(points[a])
        # Between its points a geometry file's border is known only up to the height of the arcs.
        slack = 0.15 * math.dist(*segment) if domain.kind == "geometry" else 0.0
        if distance > 1e-9 * diagonal + slack:
            return "border vertex {} is {:.3g} away from the domain's border".format(points[a], distance)
    found, wanted = len(planar_files.loops(border)), count_loops(segments)
    if found != wanted:
        return "{} border loops instead of {}".format(found, wanted)
    on_border = {points[a] for a, _ in border}
    if domain.kind == "outline":
        for ring in domain.rings:
            for i, p in enumerate(ring):
                if planar_files.turn_degrees(ring[i - 2], ring[i - 1], p) > 41 and not has_near(
                        on_border, ring[i - 1], 1e-9 * diagonal):
                    return "no vertex at the corner {}".format(ring[i - 1])
    return None


def has_near(points, p, distance):
    return p in points or any(math.dist(p, q) <= distance for q in points)


def count_loops(segments):
    return components([list(s) for s in segments])


def area_of(points, polygons):
    return abs(sum(planar_files.signed_area([points[v] for v in f]) for f in polygons))
