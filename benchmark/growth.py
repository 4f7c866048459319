#!/usr/bin/env python3
# Copyright (c) 2026 The Quadrille authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Time and memory of whole runs of the program against the number of triangles.

Meshes the square of side 20 with sizes from 1 to 2 on background triangulations of the wanted numbers of triangles, and
prints seconds of the field and of the whole run, peak memory, and the exponents of their growth: between neighbours, and
fitted over all (least squares on logarithms). Other arguments are handed on to the program.
"""

import argparse
import json
import math
import os
import sys
import tempfile


def run(program, case, triangle_size, extra):
    """Summary of one run with its peak memory; the child is waited for here to get its resources alone."""
    with tempfile.TemporaryDirectory() as folder:
        summary = os.path.join(folder, "summary.json")
        command = [program, "quad", case, "-o", os.path.join(folder, "mesh.msh"), "--json", summary, "--quiet",
                   "--triangle-size", repr(triangle_size)] + extra
        _, status, usage = os.wait4(os.spawnv(os.P_NOWAIT, program, command), 0)
        if status != 0:
            sys.exit("failed: " + " ".join(command))
        with open(summary, encoding="utf-8") as file:
            result = json.load(file)
    result["peak_memory_gb"] = usage.ru_maxrss / 1024.0 ** 2
    return result


def fitted_exponent(points):
    logs = [(math.log(n), math.log(t)) for n, t in points]
    mean_n = sum(n for n, _ in logs) / len(logs)
    mean_t = sum(t for _, t in logs) / len(logs)
    return sum((n - mean_n) * (t - mean_t) for n, t in logs) / sum((n - mean_n) ** 2 for n, _ in logs)


def main():
    top = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=os.path.join(top, "build", "bin", "quadrille"))
    parser.add_argument("--triangles", type=int, nargs="+", default=[1000, 10000, 100000, 1000000])
    arguments, extra = parser.parse_known_args()

    case = os.path.join(top, "examples", "data", "square_1_2.geo")
    field, whole = [], []
    print("| triangles | singularities | error | field s | total s | exponents | peak GB |")
    print("|" + " --- |" * 7)
    for wanted in arguments.triangles:
        # A square of side 20 takes 4 / sqrt(3) (20 / h)^2 equilateral triangles with the edge h.
        result = run(arguments.program, case, 20 * math.sqrt(4 / math.sqrt(3) / wanted), extra)
        n = result["input"]["faces"]
        field.append((n, result["field"]["seconds"]))
        whole.append((n, result["seconds"]))
        exponents = "" if len(field) == 1 else "{:.2f} {:.2f}".format(fitted_exponent(field[-2:]),
                                                                    fitted_exponent(whole[-2:]))
        singularities = " ".join("{}x{}".format(count, valence)
                                 for valence, count in sorted(result["field"]["singularities"].items()))
        print("| {} | {} | {:.2e} | {:.2f} | {:.2f} | {} | {:.2f} |".format(
            n, singularities or "none", result["map"]["integration_error"], field[-1][1], whole[-1][1], exponents,
            result["peak_memory_gb"]), flush=True)
    if len(field) > 1:
        print("exponents over all: field {:.2f}, whole run {:.2f}".format(fitted_exponent(field),
                                                                         fitted_exponent(whole)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
