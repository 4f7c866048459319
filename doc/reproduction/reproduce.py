#!/usr/bin/env python3
# Copyright (c) 2026 The Quadrille authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes Table 1 and figures of the papers again with the program, and writes them into reproduction.md.

Needs the program, the benchmark lie_energy_of_singularities and the example singularity_and_epsilon (all of them in the
build folder), rsvg-convert and ImageMagick. One thread, unless --threads says otherwise.
"""

import argparse
import csv
import glob
import json
import math
import os
import re
import resource
import subprocess
import sys
import tempfile

import pictures

HERE = os.path.dirname(os.path.abspath(__file__))
TOP = os.path.dirname(os.path.dirname(HERE))
sys.path.insert(0, os.path.join(TOP, "benchmark"))
from run_cases import CASES, commit  # noqa: E402  triangle sizes that give about the paper's numbers of triangles

ENDS = ["--size", "left=free", "--size", "right=free"]
THIN = ["--size", "boundary=0.15x1.5", "--size", "feature=0.15x1.5"]
# Name of a run: case in examples/data, options.
RUNS = {
    "wing": ("three_component_wing", []),
    "disk": ("disk", []),
    "square_1_2": ("square_1_2", []),
    "square_1_10": ("square_1_10", []),
    "annulus": ("annulus", []),
    "square_ends": ("square_1_2", ENDS),
    "square_ends_aniso": ("square_1_2", ["--anisotropic"] + ENDS),
    "tilted": ("tilted_squares", []),
    "tilted_aniso": ("tilted_squares", ["--anisotropic"]),
    "nautilus": ("nautilus", []),
    "nautilus_aniso": ("nautilus", ["--anisotropic"]),
    "disk_feature": ("disk_feature", ["--anisotropic"] + THIN),
    "annulus_4_1": ("annulus", ["--size", "inner=4", "--size", "outer=1"]),
    "annulus_sides": ("annulus", ["--size", "inner=1", "--size", "20=1", "--size", "21=2", "--size", "22=2", "--size",
                                  "23=1"]),
    "square_1_2_smooth": ("square_1_2", ["--smooth"]),
    "square_1_10_smooth": ("square_1_10", ["--smooth"]),
    "annulus_smooth": ("annulus", ["--smooth"]),
    "annulus_4_1_smooth": ("annulus", ["--smooth", "--size", "inner=4", "--size", "outer=1"]),
    "annulus_sides_smooth": ("annulus", ["--smooth", "--size", "inner=1", "--size", "20=1", "--size", "21=2", "--size",
                                         "22=2", "--size", "23=1"]),
}

# Rows of Table 1: run, model, figure, frames, then the paper's triangles, seconds (field; parametrization, layout and
# quantization; smoothing), quads. That of the anisotropic nautilus is missing in the paper.
TABLE = [
    ("wing", "3-component wing", "1", "iso", "6.9k", "720", "< 1", "208", "9630"),
    ("disk", "disk", "12", "iso", "1.6k", "18", "< 1", "< 1", "704"),
    ("square_1_2", "square 1-2", "13a", "iso", "2.1k", "9", "< 1", "< 1", "196"),
    ("square_1_10", "square 1-10", "13b", "iso", "2.1k", "242", "< 1", "6", "652"),
    ("annulus", "annulus", "13c", "iso", "1.3k", "20", "< 1", "3", "831"),
    ("square_ends_aniso", "square 1-2, ends", "14", "aniso", "2.1k", "298", "< 1", "< 1", "215"),
    ("tilted", "tilted squares", "14", "iso", "1.9k", "36", "< 1", "12", "1704"),
    ("tilted_aniso", "tilted squares", "14", "aniso", "1.9k", "237", "< 1", "11", "1788"),
    ("nautilus", "nautilus", "14", "iso", "7.2k", "157", "< 1", "38", "2152"),
    ("nautilus_aniso", "nautilus", "14", "aniso", "7.2k", "1397", "< 1", "6", ""),
    ("disk_feature", "disk + feature", "15", "aniso", "3.2k", "997", "< 1", "40", "1209"),
]

# Integration errors that planar-2 prints in figures 13 and 14: of the field, and of the smooth one.
PAPER_ERROR = {
    "square_1_2": (7.96e-4, 1.44e-2), "square_1_10": (3.31e-3, 3.12e-1), "annulus": (1.40e-2, 6.03e-2),
    "square_ends": (1.44e-2, None), "square_ends_aniso": (3.90e-4, None), "tilted": (3.85e-3, None),
    "tilted_aniso": (2.67e-3, None), "nautilus": (1.93e-3, None), "nautilus_aniso": (1.01e-3, None),
}

FIGURE_13 = (("square_1_2", "(a) Size 1 at the bottom, 2 at the top, linear on the sides."),
             ("square_1_10", "(b) Size 1 at the bottom, 10 at the top, linear on the sides."),
             ("annulus", "(c) Size 2 on the inside and 1 on the outside."))
PLANAR_1_FIGURE_8 = FIGURE_13[:2] + (
    ("annulus_4_1", "(c) Size 4 on the inside and 1 on the outside."),
    ("annulus_sides", "(d) Size 1 on the inside, 2 on the left outside, 1 on the right."))
FIGURE_14 = (("square_ends", "Size 1 at the bottom, 2 at the top, free on the sides."),
             ("tilted", "Size 1 on the inner square, 2 on the outer one."), ("nautilus", "Size 1 everywhere."))


def cpu_seconds_of_children():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


class Lab:
    """Runs what is asked for, once each, and keeps results and pictures."""

    def __init__(self, arguments, folder):
        self.arguments = arguments
        self.folder = folder
        self.results = {}

    def result(self, name):
        """The summary of a run, with `exit`, `messages`, `cpu_seconds`, `picture` (SVG text or None) and `valid`."""
        if name not in self.results:
            self.results[name] = self.run(name)
        return self.results[name]

    def run(self, name):
        case, options = RUNS[name]
        data = os.path.join(TOP, "examples", "data", case + ".geo")
        mesh, picture, summary, record = (os.path.join(self.folder, name + ending)
                                          for ending in (".msh", ".svg", ".json", ".run.json"))
        if not os.path.exists(record):
            print(name, flush=True)
            command = [self.arguments.program, "quad", data, "-o", mesh, "--picture", picture, "--json", summary,
                       "--quiet", "--threads", str(self.arguments.threads)] + options
            if CASES.get(case):
                command += ["--triangle-size", str(CASES[case])]
            before = cpu_seconds_of_children()
            done = subprocess.run(command, stderr=subprocess.PIPE, universal_newlines=True, check=False)
            cpu_seconds = cpu_seconds_of_children() - before
            check = subprocess.run([self.arguments.program, "check", mesh, "--against", data, "--quiet"],
                                   stderr=subprocess.PIPE, universal_newlines=True, check=False)
            with open(record, "w", encoding="utf-8") as file:
                json.dump({"exit": done.returncode, "messages": done.stderr.strip(), "cpu_seconds": cpu_seconds,
                           "valid": done.returncode == 0 and check.returncode == 0}, file)
        with open(record, encoding="utf-8") as file:
            result = json.load(file)
        if os.path.exists(summary):
            with open(summary, encoding="utf-8") as file:
                result.update(json.load(file))
        result["picture"] = None
        if os.path.exists(picture):
            with open(picture, encoding="utf-8") as file:
                result["picture"] = file.read()
        return result

    def errors_on(self, name, sizes):
        """The errors of a run's mesh against other sizes than it was made with."""
        summary = os.path.join(self.folder, name + ".check.json")
        subprocess.run([self.arguments.program, "check", os.path.join(self.folder, name + ".msh"), "--against",
                        os.path.join(TOP, "examples", "data", RUNS[name][0] + ".geo"), "--json", summary, "--quiet"] +
                       sizes, check=True)
        with open(summary, encoding="utf-8") as file:
            return json.load(file)["mesh"]

    def panel(self, name, kind, with_error=False):
        result = self.result(name)
        label = ""
        if with_error:
            label = "no map"
            if "map" in result:
                label = "integration error " + scientific(result["map"]["integration_error"])
        return (result["picture"], kind, label)

    def write_picture(self, name, picture, n_colors=0):
        folder = os.path.join(self.arguments.output, "fig")
        os.makedirs(folder, exist_ok=True)
        pictures.write_png(os.path.join(folder, name + ".png"), picture, n_colors)


def scientific(value):
    return "{:.2e}".format(value)


def seconds(value):
    return "{:.2f}".format(value) if value < 10 else "{:.0f}".format(value)


def factor(log_error):
    return "{:.2f}".format(math.exp(log_error))


def markdown_table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + " --- |" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows])


def singularities(result):
    return " ".join("{}x{}".format(n, v) for v, n in sorted(result["field"]["singularities"].items())) or "none"


def table_1(lab):
    sizes, quality, missed = [], [], []
    for name, model, figure, frames, n_triangles, field, layout, smoothing, n_quads in TABLE:
        result = lab.result(name)
        title = "{} (fig. {}), {}".format(model, figure, frames)
        paper_error, paper_smooth = PAPER_ERROR.get(name, (None, None))
        if "mesh" not in result:
            sizes.append((title, n_triangles, "", field, result["messages"]) + ("",) * 7)
            quality.append((title, result["messages"]) + ("",) * 8)
            continue
        mesh, its_map = result["mesh"], result["map"]
        between = its_map["seconds"] + result["layout"]["seconds"] + result["quantization"]["seconds"]
        sizes.append((title, n_triangles, result["input"]["faces"], field, seconds(result["field"]["seconds"]), layout,
                      seconds(between), smoothing, seconds(mesh["seconds"]), seconds(result["cpu_seconds"]), n_quads,
                      mesh["quads"]))
        error, smooth = its_map["integration_error"], its_map["smooth_integration_error"]
        if paper_error and error > paper_error:
            missed.append("{} by {:.0f} %".format(title, 100 * (error / paper_error - 1)))
        quality.append((title, scientific(paper_error) if paper_error else "", scientific(error),
                        "{:.1f}".format(paper_smooth / paper_error) if paper_smooth else "",
                        "{:.1f}".format(smooth / error) if smooth > 0 else "",
                        ("missed" if error > paper_error else "met") if paper_error else "",
                        "{:.2f}".format(mesh["skew_degrees"]["mean"]),
                        "{:.1f} %".format(100 * mesh["size_error"]["mean"]), singularities(result),
                        "valid" if result["valid"] else "not valid"))
    header = ("model", "paper: triangles", "ours", "paper: field s", "ours", "paper: map to quantization s", "ours",
              "paper: smoothing s", "ours", "ours: whole run, CPU s", "paper: quads", "ours")
    quality_header = ("model", "paper: error", "ours", "paper: smooth / integrable", "ours", "error", "mean skew",
                      "mean size error", "singularities", "check")
    return (markdown_table(header, sizes) + "\n\n" + markdown_table(quality_header, quality) +
            "\n\nThe paper's integration error is missed on: " + ("; ".join(missed) or "none") + ".")


def figure_9(lab):
    done = subprocess.run([os.path.abspath(lab.arguments.example)], cwd=lab.folder, stdout=subprocess.PIPE,
                          universal_newlines=True, check=True)
    rows = [["{:.3g}".format(float(cell)) for cell in line.split()] for line in done.stdout.splitlines()[1:]]
    fields = {}
    for name in glob.glob(os.path.join(lab.folder, "singularity_*.csv")):
        with open(name, newline="", encoding="utf-8") as file:
            fields[re.search(r"singularity_([\d.]+)\.csv", name).group(1)] = [
                [float(value) for value in row] for row in list(csv.reader(file))[1:]]
    drawings = [pictures.glyphs(fields[epsilon], (0, 0), 1.6, 420, "epsilon = {} h".format(epsilon))
                for epsilon in ("64", "16", "4")]
    lab.write_picture("figure_9", pictures.side_by_side(drawings, 430, 450), 48)
    header = ("epsilon / h", "radius / h where tensors are no frames", "E_Lie", "E_odeco / epsilon^2")
    return markdown_table(header, rows)


def figure_11(lab):
    done = subprocess.run([lab.arguments.benchmark, "--benchmark_format=json"], stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, universal_newlines=True, check=True)
    points = {3: [], 5: []}
    for item in json.loads(done.stdout)["benchmarks"]:
        points[int(re.search(r"valence:(\d)", item["name"]).group(1))].append(item)
    series = [("valence 5", "#22d", points[5]), ("valence 3", "#d22", points[3])]

    def plot(title, key):
        return pictures.log_plot(title, "h", [(label, color, [(item["h"], item[key]) for item in items])
                                              for label, color, items in series])

    lab.write_picture("figure_11", pictures.side_by_side([plot("E_Lie", "energy"), plot("largest H", "largest_H")],
                                                         440, 330))
    return markdown_table(("h", "triangles", "valence 3: E_Lie", "near", "largest H", "valence 5: E_Lie", "near",
                           "largest H"),
                          [["{:g}".format(three["h"]), int(three["triangles"])] +
                           [cell for item in (three, five)
                            for cell in ("{:.4f}".format(item["energy"]), "{:.4f}".format(item["near_energy"]),
                                         scientific(item["largest_H"]))]
                           for three, five in zip(points[3], points[5])])


def comparison(lab, rows):
    """Smooth against integrable fields."""
    lines = []
    for name, caption in rows:
        smooth, integrable = lab.result(name + "_smooth"), lab.result(name)
        paper = PAPER_ERROR.get(name, (None, None))
        row = [caption]
        for result, paper_error in ((smooth, paper[1]), (integrable, paper[0])):
            row += [scientific(paper_error) if paper_error else "",
                    scientific(result["map"]["integration_error"]) if "map" in result else "no map",
                    singularities(result) if "map" in result else "",
                    "{:.1f} %".format(100 * result["mesh"]["size_error"]["mean"]) if "mesh" in result else
                    "no mesh: " + result["messages"]]
        ratio = ""
        if "map" in smooth and "map" in integrable:
            ratio = "{:.1f}".format(smooth["map"]["integration_error"] / integrable["map"]["integration_error"])
        lines.append(row + ["{:.1f}".format(paper[1] / paper[0]) if paper[0] else "", ratio])
    header = ("case", "paper: smooth error", "ours", "singularities", "size error", "paper: integrable error", "ours",
              "singularities", "size error", "paper: ratio", "ours")
    return markdown_table(header, lines)


def figure_13(lab):
    rows = [(caption, [lab.panel(name + "_smooth", "field"), lab.panel(name + "_smooth", "mesh", True),
                       lab.panel(name, "field"), lab.panel(name, "mesh", True)]) for name, caption in FIGURE_13]
    lab.write_picture("figure_13", pictures.grid(("smooth field", "quad mesh", "integrable field", "quad mesh"), rows,
                                                 400))
    return comparison(lab, FIGURE_13)


def planar_1_figure_8(lab):
    rows = [(caption, [lab.panel(name + "_smooth", "field"), lab.panel(name + "_smooth", "map", True),
                       lab.panel(name, "field"), lab.panel(name, "map", True), lab.panel(name, "mesh")])
            for name, caption in PLANAR_1_FIGURE_8]
    titles = ("smooth field", "its map", "integrable field", "its map", "quad mesh")
    lab.write_picture("planar_1_figure_8", pictures.grid(titles, rows, 300))
    errors = [[lab.result(run)["map"]["integration_error"] for run in (name + "_smooth", name)]
              for name, _ in PLANAR_1_FIGURE_8]
    return comparison(lab, PLANAR_1_FIGURE_8) + "\n\nMean of the ratios: {:.1f} (paper: 8.6).".format(
        sum(smooth / integrable for smooth, integrable in errors) / len(errors))


def figure_14(lab):
    rows, lines = [], []
    for name, caption in FIGURE_14:
        rows.append((caption, [lab.panel(name, "map"), lab.panel(name, "mesh", True), lab.panel(name + "_aniso", "map"),
                               lab.panel(name + "_aniso", "mesh", True)]))
        line = [caption]
        for run in (name, name + "_aniso"):
            result = lab.result(run)
            line += [scientific(PAPER_ERROR[run][0]),
                     scientific(result["map"]["integration_error"]) if "map" in result else "no map",
                     singularities(result) if "map" in result else ""]
        lines.append(line)
    titles = ("isotropic: map", "mesh", "anisotropic: map", "mesh")
    lab.write_picture("figure_14", pictures.grid(titles, rows, 400))
    header = ("case", "paper: isotropic error", "ours", "singularities", "paper: anisotropic error", "ours",
              "singularities")
    return markdown_table(header, lines)


def figure_15(lab):
    row = ("", [lab.panel("disk_feature", "field"), lab.panel("disk_feature", "mesh")])
    lab.write_picture("figure_15", pictures.grid(("frame field", "quad mesh"), [row], 700))
    result = lab.result("disk_feature")
    if "mesh" not in result:
        return result["messages"]
    rows = []
    for curve, other in (("boundary", "feature"), ("feature", "boundary")):
        errors = lab.errors_on("disk_feature", ["--size", curve + "=0.15x1.5", "--size", other + "=free"])
        rows.append((curve, factor(errors["size_error"]["mean"]), factor(errors["size_error"]["max"]),
                     factor(errors["aspect_error"]["mean"]), factor(errors["aspect_error"]["max"])))
    return ("{} quads (paper: 1209), singularities {}, integration error {}, mean skew {:.2f} degrees, {}.\n"
            "Factors by which the mesh is off what is prescribed on the curves:\n\n").format(
                result["mesh"]["quads"], singularities(result), scientific(result["map"]["integration_error"]),
                result["mesh"]["skew_degrees"]["mean"], "valid" if result["valid"] else "not valid") + markdown_table(
                    ("curve", "length along: mean", "max", "ratio of across to along: mean", "max"), rows)


PARTS = {"table_1": table_1, "figure_9": figure_9, "figure_11": figure_11, "figure_13": figure_13,
         "figure_14": figure_14, "figure_15": figure_15, "planar_1_figure_8": planar_1_figure_8}


def insert(page, part, content):
    """Replaces what is between the two comments of a part."""
    begin, end = "<!-- begin {} -->".format(part), "<!-- end {} -->".format(part)
    head, rest = page.split(begin)
    return head + begin + "\n\n" + content + "\n\n" + end + rest.split(end)[1]


def add_options(parser, page, parts):
    """Options that the scripts of all pages have."""
    parser.add_argument("--commit", default=commit(TOP), help="of the program; default: of this folder")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--output", default=HERE, help="folder for {} and fig/".format(page))
    parser.add_argument("--runs", help="folder for the program's files; runs that are there already are not repeated")
    parser.add_argument("parts", nargs="*", metavar="PART", help="default: all of " + ", ".join(parts))


def make_page(name, parts, make_lab, arguments):
    """Writes what the chosen `parts` make of a lab (of `make_lab(arguments, folder)`) into the page `name`."""
    unknown = [part for part in arguments.parts if part not in parts]
    if unknown:
        sys.exit("no such part: " + ", ".join(unknown))
    version = subprocess.run([arguments.program, "--version"], stdout=subprocess.PIPE, universal_newlines=True,
                             check=True).stdout.strip()
    contents = {"program": "{}, commit {}, {} thread{} on a machine with {} cores.".format(
        version, (arguments.commit or "unknown")[:10], arguments.threads, "" if arguments.threads == 1 else "s",
        os.cpu_count())}
    os.makedirs(arguments.output, exist_ok=True)
    with tempfile.TemporaryDirectory() as temporary:
        if arguments.runs:
            os.makedirs(arguments.runs, exist_ok=True)
        lab = make_lab(arguments, os.path.abspath(arguments.runs or temporary))
        for part in arguments.parts or parts:
            contents[part] = parts[part](lab)
    target = os.path.join(arguments.output, name)
    with open(target if os.path.exists(target) else os.path.join(HERE, name), encoding="utf-8") as file:
        page = file.read()
    for part, content in contents.items():
        page = insert(page, part, content)
    with open(target, "w", encoding="utf-8") as file:
        file.write(page)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", default=os.path.join(TOP, "build"), help="build folder of program and benchmark")
    parser.add_argument("--program", help="default: bin/quadrille in the build folder")
    parser.add_argument("--benchmark", help="lie_energy_of_singularities, for figure_11")
    parser.add_argument("--example", help="singularity_and_epsilon, for figure_9")
    add_options(parser, "reproduction.md", PARTS)
    arguments = parser.parse_args()
    for name, place in (("program", "bin/quadrille"), ("example", "examples/Odeco_frame_field/singularity_and_epsilon"),
                        ("benchmark", "benchmark/Odeco_frame_field/lie_energy_of_singularities")):
        setattr(arguments, name, os.path.abspath(getattr(arguments, name) or os.path.join(arguments.build, place)))
    make_page("reproduction.md", PARTS, Lab, arguments)
    return 0


if __name__ == "__main__":
    sys.exit(main())
