#!/usr/bin/env python3
# Copyright (c) 2026 The Quadrille authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes tables and figures of the paper on surfaces again with the program, and writes them into surfaces.md.

Needs the program, rsvg-convert and ImageMagick, and for all but figure 13 a folder with the models (--models), which are
not ours to distribute: MAMBO as in HexMe (i01o_m1.step and so on) and the smooth models of the paper. Rows whose models
are missing are left out.
"""

import argparse
import json
import os
import subprocess
import sys

import pictures
from reproduce import TOP, add_options, make_page, markdown_table, scientific, seconds, singularities

# Model: file, and options that give about the paper's numbers of triangles.
MODELS = {
    "M1": ("i01o_m1.step", ["--triangle-size", "1.77"]),
    "M2": ("i02o_m2.step", ["--triangle-size", "0.29"]),
    "M4": ("i04o_m4.step", ["--triangle-size", "0.33"]),
    "M8": ("i08o_m8.step", ["--triangle-size", "2.3"]),
    "Fertility": ("fertility_input.off", []),
    "Botijo": ("botijo.off", []),
    "Retinal": ("retinal_miq.obj", []),
    "Genus3": ("genus3.off", []),
    "SquareLine": ("square_line.geo", ["--triangle-size", "1.6"]),
    "SquareCurve": ("square_curve.geo", ["--triangle-size", "1.6"]),
    "U-turn": ("u_turn.geo", ["--triangle-size", "1.2"]),
}
# Model, quads asked for; the paper's mean skew in degrees, that of integrable polyvector fields, and time.
TABLE_1 = [("M1", 42279, "3.00", "4.15", "11:54"), ("M2", 16942, "2.39", "5.78", "7:31"),
           ("M4", 33324, "3.22", "3.32", "7:01"), ("M8", 46492, "3.58", "8.98", "8:58")]
# Model, preset; the paper's triangles, quads and time.
TABLE_2 = [("M1", "area", 37766, 42279, "10:57"), ("M1", "angle", 37766, 34454, "3:25"),
           ("M2", "area", 22133, 16942, "12:06"), ("M2", "angle", 22133, 11468, "8:42"),
           ("Fertility", "area", 27954, 13352, "9:13"), ("Fertility", "angle", 27954, 17498, "4:42"),
           ("Botijo", "area", 82332, 33550, "39:23"), ("Botijo", "angle", 82332, 14378, "26:28"),
           ("Retinal", "area", 7282, 10906, "3:58"), ("Retinal", "angle", 7282, 9635, "2:11"),
           ("Genus3", "area", 13312, 19581, "3:58"), ("Genus3", "angle", 13312, 17938, "8:26")]
# Model; the paper's figures for areas and for angles: rectangular surface parametrization, integrable odeco fields.
FIGURE_13 = [("SquareLine", ("0.047", "0.022"), ("0.014", "0.006")),
             ("SquareCurve", ("0.104", "0.017"), ("0.226", "0.019")),
             ("U-turn", ("0.154", "0.061"), ("0.003", "0.004"))]


class Lab:
    """Runs what is asked for, once each, and keeps results and pictures."""

    def __init__(self, arguments, folder):
        self.arguments = arguments
        self.folder = folder
        self.files = {}
        for top in [os.path.join(TOP, "examples", "data")] + arguments.models:
            for path, _, names in os.walk(top):
                for name in names:
                    self.files.setdefault(name, os.path.join(path, name))

    def result(self, model, options):
        """The program's summary with `picture` (SVG text), `valid` and `messages`; None without the model."""
        name, its_options = MODELS[model]
        if name not in self.files:
            print("left out:", model, "since there is no", name, flush=True)
            return None
        run = os.path.join(self.folder, "_".join([model] + options).replace("--", ""))
        mesh, picture, summary, record = (run + ending for ending in (".msh", ".svg", ".json", ".run.json"))
        if not os.path.exists(record):
            print(os.path.basename(run), flush=True)
            done = subprocess.run([self.arguments.program, "quad", self.files[name], "-o", mesh, "--picture", picture,
                                   "--json", summary, "--quiet", "--threads", str(self.arguments.threads)] +
                                  its_options + options,
                                  stderr=subprocess.PIPE, universal_newlines=True, check=False)
            check = subprocess.run([self.arguments.program, "check", mesh, "--against", self.files[name], "--quiet"],
                                   stderr=subprocess.PIPE, universal_newlines=True, check=False)
            with open(record, "w", encoding="utf-8") as file:
                json.dump({"messages": done.stderr.strip(),
                           "valid": done.returncode == 0 and check.returncode == 0}, file)
        result = {"picture": None}
        for part in (record, summary):
            if os.path.exists(part):
                with open(part, encoding="utf-8") as file:
                    result.update(json.load(file))
        if os.path.exists(picture):
            with open(picture, encoding="utf-8") as file:
                result["picture"] = file.read()
        return result

    def write_picture(self, name, picture):
        folder = os.path.join(self.arguments.output, "fig")
        os.makedirs(folder, exist_ok=True)
        pictures.write_png(os.path.join(folder, name + ".png"), picture, 32)


def verdict(result):
    return "valid" if result["valid"] else "not valid: " + result["messages"]


def table_1(lab):
    rows = []
    for model, n_quads, paper, polyvector, time in TABLE_1:
        result = lab.result(model, ["--preset", "sizing", "--quads", str(n_quads)])
        if result is None:
            continue
        row = [model, polyvector, paper]
        if "mesh" in result:
            mesh = result["mesh"]
            row += ["{:.2f}".format(mesh["skew_degrees"]["mean"]), time, seconds(result["seconds"]),
                    result["input"]["faces"], mesh["quads"], "{:.2f}".format(mesh["scaled_jacobian"]["min"]),
                    "{:.1f} %".format(100 * mesh["size_error"]["mean"]), singularities(result)]
        else:
            row += ["", time, seconds(result["seconds"])] + [""] * 5
        rows.append(row + [verdict(result)])
    return markdown_table(("model", "polyvector fields: mean skew", "paper", "ours", "paper: time m:ss", "ours: s",
                           "triangles", "quads", "least scaled Jacobian", "size error", "singularities", "check"), rows)


def table_2(lab):
    rows, drawings = [], {}
    for model, preset, n_triangles, n_quads, time in TABLE_2:
        result = lab.result(model, ["--preset", preset, "--quads", str(n_quads)])
        if result is None:
            continue
        row = [model, preset, n_triangles, result["input"]["faces"], n_quads]
        if "mesh" in result:
            mesh = result["mesh"]
            row += [mesh["quads"], time, seconds(result["field"]["seconds"]), seconds(result["seconds"]),
                    "{:.3f}".format(mesh["area_distortion"]["mean"]),
                    "{:.3f}".format(mesh["aspect_distortion"]["mean"]),
                    "{:.2f}".format(mesh["skew_degrees"]["mean"]), scientific(result["map"]["integration_error"]),
                    singularities(result)]
        else:
            row += ["", time, "", seconds(result["seconds"])] + [""] * 5
        rows.append(row + [verdict(result)])
        drawings.setdefault(model, []).append((result["picture"], "all", ""))
    if drawings:
        lab.write_picture("surface_figures_6_7",
                          pictures.grid(("area", "angle"), list(drawings.items()), 240))
    return markdown_table(("model", "preset", "paper: triangles", "ours", "paper: quads", "ours", "paper: time m:ss",
                           "ours: field s", "whole run s", "area distortion", "aspect distortion", "mean skew",
                           "integration error", "singularities", "check"), rows)


def figure_13(lab):
    rows, drawings = [], []
    for model, areas, angles in FIGURE_13:
        row, panels = [model], []
        for preset, key, paper in (("area", "area_distortion", areas), ("angle", "aspect_distortion", angles)):
            result = lab.result(model, ["--preset", preset, "--size", "1"])
            panels.append((result["picture"], "all", ""))
            row += list(paper)
            row += ["{:.4f}".format(result["mesh"][key]["squared_mean"]), result["mesh"]["quads"],
                    singularities(result)] if "mesh" in result else [verdict(result), "", ""]
        rows.append(row)
        drawings.append((model, panels))
    lab.write_picture("surface_figure_13", pictures.grid(("area", "angle"), drawings, 340))
    return markdown_table(("model", "area: other method", "paper", "ours", "quads", "singularities",
                           "angle: other method", "paper", "ours", "quads", "singularities"), rows)


PARTS = {"table_1": table_1, "table_2": table_2, "figure_13": figure_13}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=os.path.join(TOP, "build", "bin", "quadrille"))
    parser.add_argument("--models", action="append", default=[], metavar="FOLDER", help="with the models; repeatable")
    add_options(parser, "surfaces.md", PARTS)
    arguments = parser.parse_args()
    arguments.program = os.path.abspath(arguments.program)
    make_page("surfaces.md", PARTS, Lab, arguments)
    return 0


if __name__ == "__main__":
    sys.exit(main())
