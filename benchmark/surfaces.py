#!/usr/bin/env python3
# Copyright (c) 2026 The Quadrille authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fields and maps of surfaces by the program, as a table.

Without files, the models of the surface paper's Table 2 and figure 4 that are found below the folder --data (by the
names that they have in public collections: i01o_m1.step, ..., or 01_M1.step; botijo.off, ...), with about its numbers
of triangles and its presets; the paper's seconds are those of a whole run on 12 threads. With files or folders, every
surface among them, with the program's defaults.

"terms" are the energies of the chosen field: curl, odeco, sizes, angles. --lbfgs runs the reference solver, too, and
prints the ratio of the fields' times. "index sum" is compared with the Euler characteristic, counted here from the
numbers of vertices, edges and faces of meshes. Exit code 1 if a run failed that should not have, or an index sum is
wrong.
"""

import argparse
import collections
import json
import math
import os
import shlex
import signal
import subprocess
import sys
import tempfile
import time

Model = collections.namedtuple("Model", "name file arguments paper_triangles paper_seconds")

AREA, ANGLE, SIZING = (["--preset", name] for name in ("area", "angle", "sizing"))

# Triangle sizes that give about the paper's numbers of triangles; meshes are taken as they are.
PAPER_MODELS = [
    Model("M1 area", "i01o_m1.step", AREA + ["--triangle-size", "1.77"], 37766, 657),
    Model("M1 angle", "i01o_m1.step", ANGLE + ["--triangle-size", "1.77"], 37766, 205),
    Model("M2 area", "i02o_m2.step", AREA + ["--triangle-size", "0.297"], 22133, 726),
    Model("M2 angle", "i02o_m2.step", ANGLE + ["--triangle-size", "0.297"], 22133, 522),
    Model("M4", "i04o_m4.step", SIZING + ["--triangle-size", "0.354"], 38928, 421),
    Model("M8", "i08o_m8.step", SIZING + ["--triangle-size", "2.69"], 26637, 538),
    Model("Fertility area", "fertility_input.off", AREA + ["--crease-angle", "180"], 27954, 553),
    Model("Fertility angle", "fertility_input.off", ANGLE + ["--crease-angle", "180"], 27954, 282),
    Model("Botijo area", "botijo.off", AREA + ["--crease-angle", "180"], 82332, 2363),
    Model("Botijo angle", "botijo.off", ANGLE + ["--crease-angle", "180"], 82332, 1588),
    Model("Retinal area", "retinal_miq.obj", AREA + ["--crease-angle", "180"], 7282, 238),
    Model("Retinal angle", "retinal_miq.obj", ANGLE + ["--crease-angle", "180"], 7282, 131),
    Model("Genus3 area", "genus3.off", AREA + ["--crease-angle", "180"], 13312, 238),
    Model("Genus3 angle", "genus3.off", ANGLE + ["--crease-angle", "180"], 13312, 506),
    Model("B0", "B0_surface.obj", ANGLE + ["--crease-angle", "180"], 19964, None),  # no features, as in its figure 4
]
ENDINGS = (".off", ".obj", ".step", ".stp", ".brep", ".iges", ".igs", ".geo", ".ply", ".stl")


def files_below(path):
    if os.path.isfile(path):
        return [path]
    return sorted(os.path.join(root, file) for root, _, files in os.walk(path) for file in files
                  if file.lower().endswith(ENDINGS))


def models_of(arguments, parser):
    if arguments.files:
        return [Model(os.path.relpath(file, os.path.dirname(os.path.abspath(path.rstrip(os.sep)))), file, [], None, None)
                for path in arguments.files for file in files_below(path)]
    found = {os.path.basename(file): file for file in files_below(arguments.data)} if arguments.data else {}
    models = [model._replace(file=found[model.file]) for model in PAPER_MODELS if model.file in found]
    if not models:
        parser.error("no file to run: name some, or the folder with the paper's models by --data")
    return models


def run(command, seconds):
    """Exit code (None: no end within the time), summary, messages, seconds and peak memory in GB of one run."""
    with tempfile.TemporaryDirectory() as folder:
        summary = os.path.join(folder, "summary.json")
        with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as messages:
            start = time.monotonic()
            process = subprocess.Popen(command + ["--json", summary, "--quiet"], stdout=messages, stderr=messages)
            while True:
                pid, status, usage = os.wait4(process.pid, os.WNOHANG)
                if pid:
                    break
                if time.monotonic() - start > seconds:
                    os.kill(process.pid, signal.SIGKILL)
                    os.wait4(process.pid, 0)
                    return None, {}, "no end within {} s".format(seconds), seconds, 0
                time.sleep(0.02)
            taken = time.monotonic() - start
            messages.seek(0)
            code = os.WEXITSTATUS(status) if os.WIFEXITED(status) else -os.WTERMSIG(status)
            result = {}
            if os.path.exists(summary):
                with open(summary, encoding="utf-8") as file:
                    result = json.load(file)
            return code, result, " ".join(messages.read().split()), taken, usage.ru_maxrss / 1024.0 ** 2


def euler_characteristic_of_mesh(path):
    """Counted from the file alone; None for geometry files."""
    edges, vertices, n_faces = set(), set(), 0
    with open(path, encoding="utf-8", errors="replace") as file:
        if path.lower().endswith(".obj"):
            faces = [[int(word.split("/")[0]) for word in line.split()[1:]] for line in file if line.startswith("f ")]
        elif path.lower().endswith(".off"):
            words = [word for line in file for word in line.split("#")[0].split()]
            at = 1 if words[0].endswith("OFF") else 0
            n, m = int(words[at]), int(words[at + 1])
            at += 3 + 3 * n
            faces = []
            for _ in range(m):
                size = int(words[at])
                faces.append([int(word) for word in words[at + 1:at + 1 + size]])
                at += 1 + size
        else:
            return None
    for face in faces:
        n_faces += 1
        vertices.update(face)
        edges.update((min(a, b), max(a, b)) for a, b in zip(face, face[1:] + face[:1]))
    return len(vertices) - len(edges) + n_faces


def row_of(model, code, summary, messages, seconds, memory):
    field, energy_map = summary.get("field", {}), summary.get("map", {})
    if "index_sum" not in field:
        return [model.name, "exit {}".format(code), messages[:150]] + [""] * 9
    singularities = " ".join("{}x{}".format(n, v) for v, n in sorted(field["singularities"].items()))
    terms = " ".join("{:.3g}".format(value) for value in field["energy_terms"].values())
    error = energy_map.get("integration_error")
    return [model.name, summary["input"]["faces"], "{:g}".format(field["index_sum"]), singularities or "none", terms,
            "{:.2e}".format(error) if error is not None else "none", energy_map.get("flipped", ""),
            "{:.3f}".format(energy_map["size_error"]["mean"]) if "size_error" in energy_map else "",
            "{:.1f}".format(field["seconds"]), "{:.1f}".format(seconds), "{:.2f}".format(memory),
            model.paper_seconds or ""]


def print_row(values):
    print("| " + " | ".join(str(value) for value in values) + " |", flush=True)


def main():
    top = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=os.path.join(top, "build", "bin", "quadrille"))
    parser.add_argument("--data", help="folder with the models of the paper")
    parser.add_argument("--only", default="", help="runs only models with this in their names")
    parser.add_argument("--lbfgs", action="store_true", help="the reference solver beside ours")
    parser.add_argument("--seconds", type=float, default=3600, help="limit of one run")
    parser.add_argument("--arguments", default="", help='more arguments of the program, as in --arguments="--starts 1"')
    parser.add_argument("files", nargs="*", metavar="FILE")
    arguments = parser.parse_args()

    print_row(["model", "triangles", "index sum", "singularities", "terms", "error", "flipped", "size error", "field s",
               "run s", "GB", "paper s"])
    print_row(["---"] * 12)
    failed, ratios, index_sums = 0, [], 0
    for model in models_of(arguments, parser):
        if arguments.only not in model.name:
            continue
        command = [arguments.program, "quad", model.file] + model.arguments + shlex.split(arguments.arguments)
        code, summary, *rest = run(command, arguments.seconds)
        print_row(row_of(model, code, summary, *rest))
        field = summary.get("field", {})
        if "index_sum" in field:
            expected = euler_characteristic_of_mesh(model.file)
            index_sums += 1
            if expected is not None and abs(field["index_sum"] - expected) > 1e-9:
                print_row([model.name, "the Euler characteristic is {}".format(expected)])
                failed += 1
        failed += code not in (0, 3)
        if arguments.lbfgs and "index_sum" in field:
            reference, summary, *rest = run(command + ["--solver", "lbfgs"], arguments.seconds)
            print_row(row_of(model._replace(name=model.name + ", L-BFGS"), reference, summary, *rest))
            if "seconds" in summary.get("field", {}):
                ratios.append(summary["field"]["seconds"] / field["seconds"])
                print_row([model.name + ": ratio", "{:.1f}".format(ratios[-1])])
    print("{} index sums; {} runs failed".format(index_sums, failed))
    if ratios:
        print("geometric mean of the ratios: {:.1f}".format(math.exp(sum(map(math.log, ratios)) / len(ratios))))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
