#!/usr/bin/env python3
# Copyright (c) 2026 The Quadrille authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Time and memory of cross fields of a ball against the number of tetrahedra.

Triangulates the sphere by an icosahedron with divided faces, lets `quadrille cross` fill it (by TetGen), and prints
seconds of the field, peak memory per tetrahedron, the singular graph, and the exponent of the time's growth. The
default sizes are about those of the paper by Chemin et al., which reports 3, 34 and 81 s for its averaging. Other
arguments are handed on to the program.
"""

import argparse
import json
import math
import os
import subprocess
import sys
import tempfile


def write_sphere(path, frequency):
    """An icosahedron whose faces are divided into frequency^2 triangles each, on the unit sphere."""
    t = (1 + math.sqrt(5)) / 2
    corners = [(-1, t, 0), (1, t, 0), (-1, -t, 0), (1, -t, 0), (0, -1, t), (0, 1, t), (0, -1, -t), (0, 1, -t),
               (t, 0, -1), (t, 0, 1), (-t, 0, -1), (-t, 0, 1)]
    faces = [(i, j, k) for i in range(12) for j in range(i + 1, 12) for k in range(j + 1, 12)
             if all(abs(math.dist(corners[a], corners[b]) - 2) < 1e-9 for a, b in ((i, j), (j, k), (i, k)))]
    numbers, points, triangles = {}, [], []

    def vertex(face, i, j):
        weights = sorted((corner, weight) for corner, weight in zip(face, (frequency - i - j, i, j)) if weight > 0)
        key = tuple(weights)
        if key not in numbers:
            numbers[key] = len(points)
            p = [sum(weight * corners[corner][axis] for corner, weight in weights) for axis in range(3)]
            length = math.hypot(*p)
            points.append([x / length for x in p])
        return numbers[key]

    for face in faces:
        for i in range(frequency):
            for j in range(frequency - i):
                triangles.append((vertex(face, i, j), vertex(face, i + 1, j), vertex(face, i, j + 1)))
                if i + j + 1 < frequency:
                    triangles.append((vertex(face, i + 1, j), vertex(face, i + 1, j + 1), vertex(face, i, j + 1)))
    with open(path, "w", encoding="utf-8") as file:
        file.write("OFF\n{} {} 0\n".format(len(points), len(triangles)))
        file.writelines("{!r} {!r} {!r}\n".format(*p) for p in points)
        file.writelines("3 {} {} {}\n".format(*t) for t in triangles)
    return math.sqrt(4 * math.pi / len(triangles) * 4 / math.sqrt(3))


def main():
    top = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=os.path.join(top, "build", "bin", "quadrille"))
    parser.add_argument("--frequencies", type=int, nargs="+", default=[10, 16, 31, 54, 78],
                        help="of the divided icosahedra")
    arguments, extra = parser.parse_known_args()

    print("| tetrahedra | field s | whole run s | bytes per tetrahedron | arcs | nodes | ends | exponent |")
    print("|" + " --- |" * 8)
    last = None
    for frequency in arguments.frequencies:
        with tempfile.TemporaryDirectory() as folder:
            surface, mesh = os.path.join(folder, "sphere.off"), os.path.join(folder, "ball.vtk")
            edge = write_sphere(surface, frequency)
            summary = os.path.join(folder, "summary.json")
            # The mesh is made first, so that the memory of the run is that of the field, with reading and writing.
            for command in ([surface, "-o", mesh, "--tet-size", repr(1.26 * edge)],
                            [mesh, "-o", os.path.join(folder, "field.vtu"), "--json", summary] + extra):
                status = subprocess.run([arguments.program, "cross", "--quiet"] + command, check=False).returncode
                if status != 0:
                    sys.exit("failed: " + " ".join(command))
            with open(summary, encoding="utf-8") as file:
                result = json.load(file)
        n, seconds, graph = result["field"]["tetrahedra"], result["field"]["seconds"], result["graph"]
        exponent = "" if last is None else "{:.2f}".format(math.log(seconds / last[1]) / math.log(n / last[0]))
        last = (n, seconds)
        print("| {} | {:.2f} | {:.2f} | {:.0f} | {} | {} | {} | {} |".format(
            n, seconds, result["seconds"], result["peak_memory_bytes"] / n, graph["arcs"],
            " ".join("{} of degree {}".format(count, degree) for degree, count in graph["nodes"].items()),
            graph["boundary_ends"], exponent), flush=True)


if __name__ == "__main__":
    main()
