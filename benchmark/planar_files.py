# Copyright (c) 2026 The Quadrille authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads planar domains from the kinds of files that are around, and writes them as files that the program reads.

A file gives a `Domain`: rings (for outlines) or polygons (for meshes), and curves with tags and end points. Geometry
files are turned into a mesh by Gmsh, with triangles of about 1/60 of the diagonal, only to learn what they contain.
"""

import json
import math
import os
import re
import subprocess


class Unreadable(Exception):
    """The file is none of the kinds below, or holds no planar domain at all; the message says why."""


class Curve:
    """Points from the first to the last one (equal ones for a closed curve), known to the program as `tag`."""

    def __init__(self, tag, points):
        self.tag = tag
        self.points = points


class Domain:
    def __init__(self, kind):
        self.kind = kind  # "outline" (rings), "mesh" (points, polygons) or "geometry" (the same, by Gmsh)
        self.rings = []
        self.points = []
        self.polygons = []
        self.curves = []
        self.fine_border = []  # of geometry files: the border as short segments
        self.notes = []
        self.problem = None  # what the reader noticed to be wrong with the domain

    def border(self):
        """The border as pairs of points."""
        if self.kind == "outline":
            return [(ring[i - 1], ring[i]) for ring in self.rings for i in range(len(ring))]
        return [(self.points[a], self.points[b]) for a, b in border_edges(self.polygons)]

    def box(self):
        points = [p for ring in self.rings for p in ring] or [self.points[v] for f in self.polygons for v in f]
        xs, ys = [p[0] for p in points], [p[1] for p in points]
        return min(xs), min(ys), max(xs), max(ys)

    def diagonal(self):
        box = self.box()
        return math.hypot(box[2] - box[0], box[3] - box[1])


def border_edges(polygons):
    """Directed edges without a partner, and (whichever way they run) edges that have more than one."""
    count = {}
    for polygon in polygons:
        for i, b in enumerate(polygon):
            key = (min(polygon[i - 1], b), max(polygon[i - 1], b))
            count[key] = count.get(key, 0) + 1
    return [(polygon[i - 1], b) for polygon in polygons for i, b in enumerate(polygon)
            if count[(min(polygon[i - 1], b), max(polygon[i - 1], b))] == 1]


def loops(edges):
    """Closed sequences of vertices; None if the edges do not form any."""
    following = {}
    for a, b in edges:
        if a in following:
            return None
        following[a] = b
    result = []
    while following:
        start, vertex = following.popitem()
        loop = [start]
        while vertex != start:
            loop.append(vertex)
            vertex = following.pop(vertex, None)
            if vertex is None:
                return None
        result.append(loop)
    return result


# ---- outlines ----

def outline_domain(rings):
    domain = Domain("outline")
    for ring in rings:
        kept = [tuple(map(float, p[:2])) for i, p in enumerate(ring) if list(p[:2]) != list(ring[i - 1][:2])]
        if len(kept) < len(ring) - 1:
            domain.notes.append("{} repeated points left out".format(len(ring) - len(kept)))
        domain.rings.append(kept)
    return domain


def read_json(path):
    with open(path, encoding="utf-8") as file:
        data = json.load(file)
    if isinstance(data, dict) and "features" in data:
        polygons = []
        for feature in data["features"]:
            coordinates = feature["geometry"]["coordinates"]
            polygons += [coordinates] if feature["geometry"]["type"] == "Polygon" else coordinates
        return [outline_domain(rings) for rings in polygons]
    return [outline_domain(data)]


def numbers_of(text):
    return [float(x) for x in text.replace(",", " ").split()]


def read_dat(path):
    with open(path, encoding="utf-8") as file:
        return [outline_domain([[numbers_of(line) for line in file if line.strip()]])]


def read_poly(path):
    """The format of the program Triangle: vertices, segments, points in holes."""
    with open(path, encoding="utf-8") as file:
        rows = [numbers_of(line.split("#")[0]) for line in file]
    rows = [row for row in rows if row]
    n_points = int(rows[0][0])
    points = {int(row[0]): tuple(row[1:3]) for row in rows[1:1 + n_points]}
    n_segments = int(rows[1 + n_points][0])
    neighbours = {v: [] for v in points}
    for row in rows[2 + n_points:2 + n_points + n_segments]:
        neighbours[int(row[1])].append(int(row[2]))
        neighbours[int(row[2])].append(int(row[1]))
    n_holes = int(rows[2 + n_points + n_segments][0])
    rings, done = [], set()
    for start in points:
        if start in done:
            continue
        ring, v = [], start
        while v is not None:
            if len(neighbours[v]) != 2:
                domain = outline_domain([])
                domain.problem = "point {} has {} segments: the outline is not closed".format(v, len(neighbours[v]))
                return [domain]
            ring.append(points[v])
            done.add(v)
            v = next((w for w in neighbours[v] if w not in done), None)
        rings.append(ring)
    rings.sort(key=lambda ring: -abs(signed_area(ring)))
    domain = outline_domain(rings)
    if n_holes != len(rings) - 1:
        domain.problem = "{} holes are marked, but there are {} inner rings".format(n_holes, len(rings) - 1)
    return [domain]


def signed_area(ring):
    return 0.5 * sum(ring[i - 1][0] * p[1] - ring[i - 1][1] * p[0] for i, p in enumerate(ring))


# ---- meshes ----

def mesh_domain(points, polygons):
    """Meshes with other polygons than triangles are no input of the program; their outlines are."""
    if not polygons:
        raise Unreadable("there are no polygons")
    used = [points[v] for polygon in polygons for v in polygon]
    extent = max(max(p[i] for p in used) - min(p[i] for p in used) for i in range(2))
    if len(used[0]) > 2 and max(p[2] for p in used) - min(p[2] for p in used) > 1e-9 * extent:
        raise Unreadable("not planar")
    if all(len(polygon) == 3 for polygon in polygons):
        domain = Domain("mesh")
        domain.points = [tuple(p[:2]) for p in points]
        domain.polygons = polygons
        add_curves_between_corners(domain)
        return domain
    rings = loops(border_edges(polygons))
    if rings is None:
        domain = outline_domain([])
        domain.problem = "the border is not made of simple loops"
        return domain
    rings = [[points[v][:2] for v in ring] for ring in rings]
    rings.sort(key=lambda ring: -abs(signed_area(ring)))
    domain = outline_domain(rings)
    domain.notes.append("the outline of a mesh of other polygons than triangles")
    return domain


def turn_degrees(a, b, c):
    u, v = (b[0] - a[0], b[1] - a[1]), (c[0] - b[0], c[1] - b[1])
    return math.degrees(abs(math.atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1])))


def add_curves_between_corners(domain):
    """Border loops, cut where they turn by more than 40 degrees."""
    for loop in loops(border_edges(domain.polygons)) or []:
        at = lambda i: domain.points[loop[i % len(loop)]]
        corners = [i for i in range(len(loop)) if turn_degrees(at(i - 1), at(i), at(i + 1)) > 40] or [0]
        for k, first in enumerate(corners):
            last = corners[(k + 1) % len(corners)]
            last += len(loop) if last <= first else 0
            curve = Curve(len(domain.curves) + 1, [at(i) for i in range(first, last + 1)])
            curve.vertices = [loop[i % len(loop)] for i in range(first, last + 1)]
            domain.curves.append(curve)


def read_obj(path):
    points, polygons = [], []
    with open(path, encoding="utf-8") as file:
        for line in file:
            words = line.split()
            if words and words[0] == "v":
                points.append(tuple(map(float, words[1:4])))
            elif words and words[0] == "f":
                polygons.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    return [mesh_domain(points, polygons)]


def read_medit(path):
    with open(path, encoding="utf-8") as file:
        words = re.sub(r"#[^\n]*", "", file.read()).split()
    dimension, points, polygons, i = 3, [], [], 0
    while i < len(words):
        key = words[i]
        if key == "Dimension":
            dimension = int(words[i + 1])
            i += 2
        elif key in ("Vertices", "Triangles", "Quadrilaterals"):
            width = {"Vertices": dimension, "Triangles": 3, "Quadrilaterals": 4}[key] + 1
            n = int(words[i + 1])
            rows = [words[i + 2 + width * k:i + 1 + width * (k + 1)] for k in range(n)]
            if key == "Vertices":
                points = [tuple(map(float, row)) for row in rows]
            else:
                polygons += [[int(v) - 1 for v in row] for row in rows]
            i += 2 + width * n
        else:
            i += 1
    return [mesh_domain(points, polygons)]


def read_vtk(path):
    with open(path, encoding="utf-8", errors="replace") as file:
        words = file.read().split()
    i = words.index("POINTS")
    n = int(words[i + 1])
    values = list(map(float, words[i + 3:i + 3 + 3 * n]))
    points = [tuple(values[3 * k:3 * k + 3]) for k in range(n)]
    i = words.index("CELLS")
    n, i = int(words[i + 1]), i + 3
    polygons = []
    for _ in range(n):
        size = int(words[i])
        if size in (3, 4):
            polygons.append([int(v) for v in words[i + 1:i + 1 + size]])
        i += 1 + size
    return [mesh_domain(points, polygons)]


def read_fluent(path):
    """Polygons of a two-dimensional ASCII case, from the faces (edges) around its cells."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    points, edges = [], {}
    for header, body in re.findall(r"\((?:10|13) \(([^)]*)\)\s*\(([^)]*)\)", text):
        fields = [int(word, 16) for word in header.split()]
        lines = [line.split() for line in body.splitlines() if line.strip()]
        if all("." in line[0] for line in lines):
            points += [tuple(map(float, line)) for line in lines]
            continue
        for line in lines:
            row = [int(word, 16) for word in (line if fields[4] == 2 else line[1:])]
            a, b, right, left = row
            for cell, edge in ((right, (a, b)), (left, (b, a))):
                if cell > 0:
                    edges.setdefault(cell, []).append((edge[0] - 1, edge[1] - 1))
    polygons = []
    for cell in sorted(edges):
        ring = loops(edges[cell])
        if ring is None or len(ring) != 1:
            raise Unreadable("cell {} is not a polygon".format(cell))
        polygons.append(ring[0])
    return [mesh_domain(points, polygons)]


# ---- geometry, by Gmsh ----

def read_geometry(path, gmsh, folder, seconds):
    mesh = os.path.join(folder, "classified.msh")
    files = [os.path.abspath(path)] + without_fields(path, folder)

    def run(*options):
        if os.path.exists(mesh):
            os.remove(mesh)
        try:
            done = subprocess.run([gmsh] + files + ["-format", "msh41", "-o", mesh, "-v", "2",
                                   "-setnumber", "Mesh.SaveAll", "1", "-setnumber", "Mesh.Binary", "0"] + list(options),
                                  cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, universal_newlines=True, errors="replace",
                                  timeout=seconds, check=False)
        except subprocess.TimeoutExpired:
            return "no end within {} s".format(seconds)
        return done.stdout.strip()

    messages = run("-1", "-clmin", "1e20")
    errors = [line for line in messages.splitlines() if re.match(r"Error +: .*[a-z]{4}", line) and
              "Unknown option" not in line]  # of size fields
    entities, _ = read_msh(mesh) if os.path.exists(mesh) else (None, None)
    if not entities or not entities.nodes:
        raise Unreadable("Gmsh finds no curves in it")
    if entities.n_volumes:
        raise Unreadable("a 3D model")
    if not entities.surfaces:
        raise Unreadable("Gmsh finds no surfaces in it")
    xs, ys, zs = zip(*entities.nodes.values())
    diagonal = math.hypot(max(xs) - min(xs), max(ys) - min(ys))
    if max(zs) - min(zs) > 1e-9 * diagonal:
        raise Unreadable("not planar")
    messages = run("-2", "-clmin", repr(diagonal / 120), "-clmax", repr(diagonal / 40), "-setnumber",
                   "Mesh.RecombineAll", "0")
    entities, elements = read_msh(mesh) if os.path.exists(mesh) else (None, None)
    domain = Domain("geometry")
    if errors:
        domain.problem = "Gmsh cannot read it: " + errors[0]
        return [domain]
    if not elements or not elements[2]:
        domain.problem = "Gmsh cannot mesh it: " + (messages.splitlines() or ["no message"])[-1]
        return [domain]
    grouped = any(entities.surfaces.values())
    index = {tag: i for i, tag in enumerate(entities.nodes)}
    domain.points = [xyz[:2] for xyz in entities.nodes.values()]
    for surface, polygon in elements[2]:
        if entities.surfaces[surface] or not grouped:
            domain.polygons.append([index[v] for v in polygon])
    known = {frozenset((a, b)) for f in domain.polygons for a, b in zip(f, f[1:] + f[:1])}
    chains = {}
    for curve, (a, b) in elements[1]:
        if frozenset((index[a], index[b])) in known:
            chains.setdefault(curve, []).append((index[a], index[b]))
    for curve, edges in sorted(chains.items()):
        vertices = [edges[0][0]] + [b for _, b in edges]
        domain.curves.append(Curve(curve, [domain.points[v] for v in vertices]))
        domain.curves[-1].vertices = vertices
    border = {frozenset(edge) for edge in border_edges(domain.polygons)}
    on_border = {curve for curve, edges in chains.items() if frozenset(edges[0]) in border}
    run("-1", "-clmin", repr(diagonal / 4000), "-clmax", repr(diagonal / 1000))
    entities, elements = read_msh(mesh) if os.path.exists(mesh) else (None, None)
    if elements:
        domain.fine_border = [(entities.nodes[a][:2], entities.nodes[b][:2]) for curve, (a, b) in elements[1]
                              if curve in on_border]
    return [domain]


def without_fields(path, folder):
    """A file for Gmsh to read afterwards that takes away the size fields of a .geo file: they do not matter to the
    domain, and Gmsh crashes on some."""
    if not path.endswith(".geo"):
        return []
    with open(path, encoding="utf-8", errors="replace") as file:
        fields = sorted(set(re.findall(r"^\s*Field\s*\[\s*(\d+)\s*\]\s*=", file.read(), re.MULTILINE)), key=int)
    if not fields:
        return []
    after = os.path.join(folder, "without_fields.geo")
    with open(after, "w", encoding="utf-8") as file:
        file.write("".join("Delete Field [{}];\n".format(field) for field in fields) + "Background Field = -1;\n")
    return [after]


class Entities:
    def __init__(self):
        self.nodes = {}
        self.surfaces = {}  # tag -> number of physical groups
        self.n_volumes = 0


def read_msh(path):
    """Entities, and by dimension (entity, vertices) of the lines and polygons of an ASCII MSH 4.1 file."""
    with open(path, encoding="utf-8", errors="replace") as file:
        lines = file.read().splitlines()
    entities, elements = Entities(), {0: [], 1: [], 2: [], 3: []}

    def section(name):
        return iter(lines[lines.index("$" + name) + 1:]) if "$" + name in lines else None

    rows = section("Entities")
    if rows:
        n_points, n_curves, n_surfaces, entities.n_volumes = map(int, next(rows).split())
        for _ in range(n_points + n_curves):
            next(rows)
        for _ in range(n_surfaces):
            words = next(rows).split()
            entities.surfaces[int(words[0])] = int(words[7])
    rows = section("Nodes")
    if rows:
        for _ in range(int(next(rows).split()[0])):
            n = int(next(rows).split()[3])
            tags = [int(next(rows)) for _ in range(n)]
            for tag in tags:
                entities.nodes[tag] = tuple(map(float, next(rows).split()[:3]))
    rows = section("Elements")
    if rows:
        for _ in range(int(next(rows).split()[0])):
            dimension, entity, _, n = map(int, next(rows).split())
            for _ in range(n):
                elements[dimension].append((entity, [int(v) for v in next(rows).split()[1:]]))
    return entities, elements


# ---- all kinds ----

READERS = {".json": read_json, ".dat": read_dat, ".poly": read_poly, ".obj": read_obj, ".mesh": read_medit,
           ".vtk": read_vtk, ".cas": read_fluent}
GEOMETRY = (".geo", ".step", ".stp", ".brep", ".iges", ".igs")
READ_BY_PROGRAM = GEOMETRY + (".msh", ".obj", ".vtk")


def read_domains(path, gmsh, folder, seconds):
    extension = os.path.splitext(path)[1].lower()
    if extension in READERS:
        return READERS[extension](path)
    if extension == ".msh" or extension in GEOMETRY:
        return read_geometry(path, gmsh, folder, seconds)
    raise Unreadable("no kind of file that can hold a planar domain")


def write_outline(path, domain, size_at=None):
    """The rings as a .geo file, with element sizes at the points if there is a function for them."""
    text, first, loops_text = [], 1, []
    for r, ring in enumerate(domain.rings):
        for i, p in enumerate(ring):
            size = "" if size_at is None else ", {!r}".format(size_at(p))
            text.append("Point({}) = {{{!r}, {!r}, 0{}}};".format(first + i, p[0], p[1], size))
        for i in range(len(ring)):
            text.append("Line({}) = {{{}, {}}};".format(first + i, first + i, first + (i + 1) % len(ring)))
        text.append("Curve Loop({}) = {{{}:{}}};".format(r + 1, first, first + len(ring) - 1))
        loops_text.append(str(r + 1))
        first += len(ring)
    text.append("Plane Surface(1) = {" + ", ".join(loops_text) + "};")
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(text) + "\n")


def write_mesh(path, domain):
    """Triangles and curves as an MSH 2.2 file; in one surface, so triangles of surfaces that Gmsh sees from the other
    side are turned."""

    def counterclockwise(polygon):
        a, b, c = (domain.points[v] for v in polygon)
        return polygon if (b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0]) else polygon[::-1]

    rows = ["1 2 0 {} {} {}".format(curve.tag, a + 1, b + 1) for curve in domain.curves
            for a, b in zip(curve.vertices, curve.vertices[1:])]
    rows += ["2 2 0 1 {} {} {}".format(*(v + 1 for v in counterclockwise(polygon))) for polygon in domain.polygons]
    with open(path, "w", encoding="utf-8") as file:
        file.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n".format(len(domain.points)))
        for i, p in enumerate(domain.points):
            file.write("{} {!r} {!r} 0\n".format(i + 1, p[0], p[1]))
        file.write("$EndNodes\n$Elements\n{}\n".format(len(rows)))
        for i, row in enumerate(rows):
            file.write("{} {}\n".format(i + 1, row))
        file.write("$EndElements\n")
