#!/usr/bin/env python3
# Copyright (c) 2026 The Quadrille authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes the cases in examples/data with the program and prints a table of what came out.

Background triangulations are about as fine as those of the paper's Table 1 where it has the case. The summaries of all
runs, with commit and machine, are written as JSON to the file given by --json.
"""

import argparse
import json
import os
import platform
import subprocess
import sys
import tempfile

# Triangle sizes that give about the paper's numbers of triangles; None: the program's default.
CASES = {
    "square_1_2": None,
    "square_1_10": None,
    "disk": 1.03,
    "annulus": 2.04,
    "tilted_squares": 2.35,
    "nautilus": 0.857,
    "three_component_wing": 3.45,
    "rotor_stator": None,
    "plate_with_holes": None,
    "l_shape": None,
}

HEADER = ("case", "triangles", "singularities", "error", "quads", "skew mean", "size error", "min SJ", "field s",
          "total s")


def run_case(program, data, name, triangle_size, extra):
    with tempfile.TemporaryDirectory() as folder:
        summary = os.path.join(folder, "summary.json")
        command = [program, "quad", os.path.join(data, name + ".geo"), "-o", os.path.join(folder, "mesh.msh"),
                   "--json", summary, "--quiet"] + extra
        if triangle_size is not None:
            command += ["--triangle-size", str(triangle_size)]
        done = subprocess.run(command, stderr=subprocess.PIPE, universal_newlines=True, check=False)
        result = {"case": name, "command": command[1:], "exit": done.returncode, "messages": done.stderr.strip()}
        if os.path.exists(summary):
            with open(summary, encoding="utf-8") as file:
                result.update(json.load(file))
        return result


def row(result):
    if result["exit"] != 0:
        return (result["case"], "exit {}: {}".format(result["exit"], result["messages"]))
    mesh = result["mesh"]
    singularities = " ".join("{}x{}".format(n, v) for v, n in sorted(result["field"]["singularities"].items()))
    return (result["case"], result["input"]["faces"], singularities or "none",
            "{:.2e}".format(result["map"]["integration_error"]), mesh["quads"],
            "{:.2f}".format(mesh["skew_degrees"]["mean"]), "{:.3f}".format(mesh["size_error"]["mean"]),
            "{:.3f}".format(mesh["scaled_jacobian"]["min"]), "{:.2f}".format(result["field"]["seconds"]),
            "{:.2f}".format(result["seconds"]))


def commit(folder):
    done = subprocess.run(["git", "-C", folder, "rev-parse", "HEAD"], stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, universal_newlines=True, check=False)
    return done.stdout.strip() or None


def main():
    top = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=os.path.join(top, "build", "bin", "quadrille"))
    parser.add_argument("--data", default=os.path.join(top, "examples", "data"))
    parser.add_argument("--json", help="file for the summaries of all runs")
    parser.add_argument("cases", nargs="*", metavar="CASE", help="names of cases; default: all")
    arguments, extra = parser.parse_known_args()
    unknown = [name for name in arguments.cases if name not in CASES]
    if unknown:
        parser.error("no such case: " + ", ".join(unknown))

    results = []
    print("| " + " | ".join(HEADER) + " |")
    print("|" + " --- |" * len(HEADER))
    for name in arguments.cases or CASES:
        results.append(run_case(arguments.program, arguments.data, name, CASES[name], extra))
        print("| " + " | ".join(str(value) for value in row(results[-1])) + " |", flush=True)
    if arguments.json:
        record = {"commit": commit(top), "machine": platform.platform(), "cores": os.cpu_count(), "results": results}
        with open(arguments.json, "w", encoding="utf-8") as file:
            json.dump(record, file, indent=1)
    return 0 if all(result["exit"] == 0 for result in results) else 1


if __name__ == "__main__":
    sys.exit(main())
