#!/usr/bin/env python3
# Copyright (c) 2026 The Quadrille authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the program's quad meshes with Gmsh's recombined ones: same domains, same sizes, same run.

Gmsh runs with its algorithms 6 and 8 (frontal Delaunay, for quads) and its recombinations 1, 2 and 3 (blossom, simple
full-quad, blossom full-quad); of the meshes that are all quads, the one with the least mean skew counts. Sizes are
those at the points of the .geo files; outlines without sizes get a fiftieth of the diagonal everywhere. Both programs'
meshes are measured by `quadrille check --against`. Times are those of whole processes; Gmsh's is that of its best
setting alone.
"""

import argparse
import json
import os
import platform
import statistics
import sys
import tempfile
import time

import planar_files
from run_cases import CASES, commit
from run_planar_domains import run

# Real domains below the data folder, from simple to rugged.
REAL = ("gmsh_2d/IPE.geo", "gmsh_2d/bl42.geo", "gmsh_2d/naca12BL.geo", "frame_field_gen/holes_in_square.geo",
        "frame_field_gen/mushroom.geo", "earcut_fixtures/building.json", "earcut_fixtures/issue29.json",
        "polygons/mesh2d_channel.json", "polygons/ne_50m_Lake_Victoria_318.json",
        "polygons/ne_50m_Lake_Michigan_313.json", "polygons/ne_50m_Aral_Sea_260.json", "polygons/cas_rae2822.json",
        "triangle/A.poly", "triangle/double_hex.poly")

HEADER = ("domain", "program", "quads", "SJ mean", "SJ min", "skew mean", "size error", "irregular", "s")


def measure(program, mesh, domain, summary):
    """The figures of `quadrille check`; None unless the mesh is valid."""
    code, _, _ = run([program, "check", mesh, "--against", domain, "--json", summary, "--quiet"], 300)
    if code != 0:
        return None
    with open(summary, encoding="utf-8") as file:
        return json.load(file)["mesh"]


def timed(command, seconds):
    start = time.monotonic()
    code, _, messages = run(command, seconds)
    return code, time.monotonic() - start, messages


def compare(name, domain, arguments, folder):
    mesh, summary = os.path.join(folder, "mesh.msh"), os.path.join(folder, "check.json")
    result = {"domain": name, "gmsh": None, "settings": []}
    code, seconds, messages = timed([arguments.program, "quad", domain, "-o", mesh, "--quiet"], 10 * arguments.seconds)
    result["quadrille"] = measure(arguments.program, mesh, domain, summary) if code == 0 else None
    if result["quadrille"]:
        result["quadrille"]["seconds"] = seconds
    else:
        result["reason"] = messages
    for algorithm in (6, 8):
        for recombination in (1, 2, 3):
            if os.path.exists(mesh):
                os.remove(mesh)
            code, seconds, _ = timed([arguments.gmsh, "-2", domain, "-o", mesh, "-format", "msh41", "-v", "0", "-algo",
                                      {6: "front2d", 8: "delquad"}[algorithm], "-setnumber", "Mesh.RecombineAll", "1",
                                      "-setnumber", "Mesh.RecombinationAlgorithm", str(recombination)],
                                     arguments.seconds)
            figures = measure(arguments.program, mesh, domain, summary) if os.path.exists(mesh) else None
            setting = {"algorithm": algorithm, "recombination": recombination, "valid": figures is not None}
            result["settings"].append(setting)
            if figures is None:
                continue
            figures.update(setting, seconds=seconds)
            best = result["gmsh"]
            if best is None or figures["skew_degrees"]["mean"] < best["skew_degrees"]["mean"]:
                result["gmsh"] = figures
    return result


def irregular(figures):
    return sum(figures["irregular"].values())


def row(result, key):
    figures = result[key]
    label = key
    if figures and key == "gmsh":
        label += " -algo {} recombination {}".format(figures["algorithm"], figures["recombination"])
    if not figures:
        return [result["domain"], label, "no valid mesh: " + result.get("reason", "")] + [""] * 6
    return [result["domain"], label, figures["quads"], "{:.3f}".format(figures["scaled_jacobian"]["mean"]),
            "{:.3f}".format(figures["scaled_jacobian"]["min"]), "{:.2f}".format(figures["skew_degrees"]["mean"]),
            "{:.3f}".format(figures["size_error"]["mean"]) if "size_error" in figures else "", irregular(figures),
            "{:.2f}".format(figures["seconds"])]


def summarize(results):
    both = [r for r in results if r["quadrille"] and r["gmsh"]]
    if not both:
        return ["no domain has valid meshes of both programs"]
    skew = [r["quadrille"]["skew_degrees"]["mean"] / r["gmsh"]["skew_degrees"]["mean"] for r in both
            if r["gmsh"]["skew_degrees"]["mean"] > 1e-6]
    counts = [irregular(r["quadrille"]) for r in both], [irregular(r["gmsh"]) for r in both]
    lines = ["{} domains with valid meshes of both, of {}".format(len(both), len(results))]
    if skew:
        lines.append("mean skew, quadrille / gmsh: geometric mean {:.3f}, largest {:.3f}".format(
            statistics.geometric_mean([max(s, 1e-3) for s in skew]), max(skew)))
    lines.append("irregular vertices, quadrille : gmsh: {} : {} in all ({:.3f})".format(
        sum(counts[0]), sum(counts[1]), sum(counts[0]) / max(1, sum(counts[1]))))
    return lines


def main():
    top = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=os.path.join(top, "build", "bin", "quadrille"))
    parser.add_argument("--gmsh", default="gmsh")
    parser.add_argument("--examples", default=os.path.join(top, "examples", "data"))
    parser.add_argument("--data", default=os.path.join(top, "..", "shared", "data", "planar"))
    parser.add_argument("--seconds", type=float, default=60, help="limit of each run of Gmsh (default 60)")
    parser.add_argument("--json", help="file for all results")
    parser.add_argument("--markdown", help="file for the table and the summary")
    parser.add_argument("names", nargs="*", metavar="NAME", help="examples or real domains; default: all")
    arguments = parser.parse_args()

    lines, results = [], []

    def emit(line):
        lines.append(line)
        print(line, flush=True)

    emit("| " + " | ".join(HEADER) + " |")
    emit("|" + " --- |" * len(HEADER))
    with tempfile.TemporaryDirectory() as folder:
        for name in arguments.names or list(CASES) + list(REAL):
            path = os.path.join(arguments.examples, name + ".geo") if name in CASES else os.path.join(arguments.data,
                                                                                                  name)
            if not os.path.exists(path):
                print("skipped: there is no file " + path)
                continue
            if not path.endswith(".geo"):
                domain = planar_files.read_domains(path, arguments.gmsh, folder, arguments.seconds)[0]
                path = os.path.join(folder, "domain.geo")
                size = domain.diagonal() / 50
                planar_files.write_outline(path, domain, lambda p, size=size: size)
            results.append(compare(name, path, arguments, folder))
            for key in ("quadrille", "gmsh"):
                emit("| " + " | ".join(str(cell) for cell in row(results[-1], key)) + " |")
    emit("")
    for line in summarize(results):
        emit(line)
    if arguments.markdown:
        with open(arguments.markdown, "w", encoding="utf-8") as file:
            file.write("\n".join(lines) + "\n")
    if arguments.json:
        record = {"commit": commit(top), "machine": platform.platform(), "cores": os.cpu_count(), "results": results}
        with open(arguments.json, "w", encoding="utf-8") as file:
            json.dump(record, file, indent=1)
    return 0


if __name__ == "__main__":
    sys.exit(main())
