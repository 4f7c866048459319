#!/usr/bin/env python3
# Copyright (c) 2026 The Quadrille authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes every planar domain below a folder with the program, checks the meshes, and prints a table.

Which files are valid domains is decided here and independently of the program (planar_checks.py): one component, simple
border loops that do not touch, for geometry files by a mesh of Gmsh's. Each valid one is meshed twice, with the
program's default sizes and with graded sizes: at a point they are
    g(x) = diagonal / 80 * 4^((x - x_min) / (x_max - x_min)),
so a quarter on the left of what they are on the right; linear along each curve between its ends' g, and the g of its
first point on closed curves. Files that are no valid domains have to be refused with exit code 3 (or meshed, where the
program can do more than it has to; the result is checked in the same way).

Every mesh is checked by `quadrille check --against` and by planar_checks.py. Exit code 1 if a mesh is not valid although
the program said so, or the program crashed.
"""

import argparse
import collections
import concurrent.futures
import copy
import json
import math
import os
import platform
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time

import planar_checks
import planar_files
from run_cases import commit

COLUMNS = ("file", "sizes", "exit", "s", "CPU s", "quads", "skew", "min SJ", "size error", "irregular", "stage: reason")


RUNNING = set()  # processes, each the leader of a group of its own


def stop(number, _):
    for pid in list(RUNNING):
        os.killpg(pid, signal.SIGKILL)
    os._exit(128 + number)


class Case:
    """One run: a file, the arguments that name it and its sizes, and what is known about it."""

    def __init__(self, name, sizes, domain, problem):
        self.name = name
        self.sizes = sizes
        self.domain = domain
        self.problem = problem  # why it is not a valid domain; None if it is one
        self.arguments = []


def graded_size(domain):
    x_min, _, x_max, _ = domain.box()
    smallest = domain.diagonal() / 80
    return lambda p: smallest * 4 ** ((p[0] - x_min) / (x_max - x_min))


def has_clear_tags(path):
    """Whether a script's curves can be named by their tags: not where groups have numbers for names, which come first,
    or where Gmsh meshes other curves than the script defines."""
    with open(path, encoding="utf-8", errors="replace") as file:
        text = file.read()
    return not re.search(r"Physical\s+(Line|Curve)\s*\(\s*\d|Compound\s+(Line|Curve)", text)


def add_arguments(case, path, stem):
    """Converts what the program does not read, and writes down the graded sizes."""
    domain, graded = case.domain, case.sizes == "graded" and case.problem is None
    size_at = graded_size(domain) if graded else None
    if domain.kind == "outline":
        case.arguments = [stem + ".geo"]
        planar_files.write_outline(case.arguments[0], domain, size_at)
        return
    is_read = os.path.splitext(path)[1].lower() in planar_files.READ_BY_PROGRAM
    case.arguments = [os.path.abspath(path)]
    unclear = domain.kind == "geometry" and path.endswith(".geo") and not has_clear_tags(path)
    if graded and unclear:
        case.domain = domain = copy.copy(domain)
        domain.kind, domain.fine_border = "mesh", []
    if domain.kind == "mesh" and (graded or not is_read):
        case.arguments = [stem + ".msh"]
        planar_files.write_mesh(case.arguments[0], domain)
    for curve in domain.curves if graded else ():
        first, last = size_at(curve.points[0]), size_at(curve.points[-1])
        item = "{}={!r}".format(curve.tag, first) if first == last else "{}={!r}:{!r}".format(curve.tag, first, last)
        case.arguments += ["--size", item]


def find_cases(arguments, folder):
    """Yields cases, and names with reasons for files that are none."""
    for root, folders, files in os.walk(arguments.data):
        folders.sort()
        for file in sorted(files):
            path = os.path.join(root, file)
            name = os.path.relpath(path, arguments.data)
            if not all(word in name for word in arguments.only):
                continue
            try:
                domains = planar_files.read_domains(path, arguments.gmsh, folder, arguments.seconds)
            except planar_files.Unreadable as error:
                yield name, str(error)
                continue
            except (ValueError, KeyError, IndexError, UnicodeDecodeError) as error:
                yield name, "cannot be read: {!r}".format(error)
                continue
            for i, domain in enumerate(domains):
                problem = planar_checks.problem_of_domain(domain)
                for sizes in arguments.sizes if problem is None else arguments.sizes[:1]:
                    case = Case(name + ("#{}".format(i) if len(domains) > 1 else ""), sizes, domain, problem)
                    stem = os.path.join(folder, case.name.replace(os.sep, "_") + "_" + sizes)
                    if domain.kind == "outline" and not domain.rings:
                        yield case.name, problem
                        continue
                    add_arguments(case, path, stem)
                    case.stem = stem
                    yield case


def run(command, seconds, busy=False):
    """Exit code (None: no end within the time), CPU seconds, messages. On a busy machine CPU time is what counts."""

    def limit_processor_time():
        resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(seconds), math.ceil(seconds) + 1))

    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as messages:
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=messages, stderr=messages,
                                   start_new_session=True, preexec_fn=limit_processor_time if busy else None)
        RUNNING.add(process.pid)
        deadline = time.monotonic() + (20 * seconds if busy else seconds)
        while True:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if pid:
                break
            if time.monotonic() > deadline:
                os.killpg(process.pid, signal.SIGKILL)
                _, _, usage = os.wait4(process.pid, 0)
                status = None
                break
            time.sleep(0.02)
        process.returncode = 0  # it was waited for
        RUNNING.discard(process.pid)
        messages.seek(0)
        code = None if status is None else os.WEXITSTATUS(status) if os.WIFEXITED(status) else -os.WTERMSIG(status)
        if code == -signal.SIGXCPU:
            code = None
        return code, usage.ru_utime + usage.ru_stime, messages.read().strip()


def run_case(case, arguments):
    result = {"file": case.name, "sizes": case.sizes, "domain": case.problem or "valid", "notes": case.domain.notes}
    mesh, drawn, summary = case.stem + "_mesh.msh", case.stem + "_mesh.obj", case.stem + "_summary.json"
    command = [arguments.program, "quad"] + case.arguments + ["-o", mesh, "-o", drawn, "--json", summary, "--quiet",
                                                              "--threads", str(arguments.threads)] + arguments.options
    if arguments.pictures:
        command += ["--picture", case.stem + ".png"]
    start = time.monotonic()
    result["exit"], result["cpu_seconds"], messages = run(command, arguments.seconds, arguments.busy)
    result["seconds"] = time.monotonic() - start
    result["reason"] = messages.splitlines()[-1] if messages else ""
    if result["exit"] is None:
        result["reason"] = "no end within {:g} s".format(arguments.seconds)
    data = {}
    if os.path.exists(summary):
        with open(summary, encoding="utf-8") as file:
            data = json.load(file)
    if "error" in data:
        result["stage"] = data["error"]["stage"]
        result["reason"] = data["error"]["message"]
    for key in ("input", "field", "map", "layout", "quantization", "mesh"):
        if key in data:
            result[key] = data[key]
    if result["exit"] == 0:
        check_mesh(case, mesh, drawn, arguments, result)
    if not arguments.keep:
        for path in [mesh, drawn, summary] + case.arguments[:1]:
            if path.startswith(case.stem) and os.path.exists(path):
                os.remove(path)
    return result


def check_mesh(case, mesh, drawn, arguments, result):
    summary = case.stem + "_check.json"
    sizes = [a for a in case.arguments[1:]]
    code, _, messages = run([arguments.program, "check", mesh, "--against", case.arguments[0], "--quiet", "--json",
                             summary] + sizes, 4 * arguments.seconds)
    if code != 0:
        result["invalid"] = "check: " + (messages.splitlines()[-1] if messages else "exit {}".format(code))
        return
    with open(summary, encoding="utf-8") as file:
        result["against"] = json.load(file)["against"]
    if not arguments.keep:
        os.remove(summary)
    points, polygons = [], []
    with open(drawn, encoding="utf-8") as file:
        for line in file:
            words = line.split()
            if words and words[0] == "v":
                points.append((float(words[1]), float(words[2])))
            elif words and words[0] == "f":
                polygons.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    found = planar_checks.problem_of_quads(points, polygons, case.domain) if case.problem is None else None
    if found:
        result["invalid"] = "independent check: " + found


def row(result):
    cells = [result["file"], result["sizes"], "-" if result["exit"] is None else result["exit"],
             "{:.1f}".format(result["seconds"]), "{:.1f}".format(result["cpu_seconds"])]
    if result["exit"] == 0:
        mesh = result["mesh"]
        cells += [mesh["quads"], "{:.1f}".format(mesh["skew_degrees"]["mean"]),
                  "{:.3f}".format(mesh["scaled_jacobian"]["min"]), "{:.3f}".format(mesh["size_error"]["mean"])
                  if "size_error" in mesh else "", sum(mesh["irregular"].values())]
    else:
        cells += [""] * 5
    reason = result.get("invalid", result["reason"] if result["exit"] != 0 else "")
    if "stage" in result:
        reason = result["stage"] + ": " + reason
    if result["domain"] != "valid":
        reason += " [not valid: " + result["domain"] + "]"
    return "| " + " | ".join(str(cell).replace("|", "/") for cell in cells + [reason]) + " |"


def verdict(result):
    if result.get("invalid") or (result["exit"] is not None and result["exit"] not in (0, 2, 3, 4)):
        return "wrong"
    if result["domain"] != "valid":
        return "refused" if result["exit"] == 3 else "meshed" if result["exit"] == 0 else "not refused"
    return "meshed" if result["exit"] == 0 else "failed"


def summarize(results):
    lines = []
    for sizes in sorted({r["sizes"] for r in results if r["domain"] == "valid"}):
        chosen = [r for r in results if r["domain"] == "valid" and r["sizes"] == sizes]
        counts = collections.Counter(verdict(r) for r in chosen)
        lines.append("{} sizes: {} of {} valid domains meshed ({:.1f} %), {} failed, {} wrong".format(
            sizes, counts["meshed"], len(chosen), 100 * counts["meshed"] / len(chosen), counts["failed"],
            counts["wrong"]))
    others = collections.Counter(verdict(r) for r in results if r["domain"] != "valid")
    lines.append("files that are no valid domains: {}".format(
        ", ".join("{} {}".format(n, key) for key, n in sorted(others.items())) or "none"))
    return lines


def parse_arguments():
    top = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("data", nargs="?", default=os.path.join(top, "..", "shared", "data", "planar"))
    parser.add_argument("--program", default=os.path.join(top, "build", "bin", "quadrille"))
    parser.add_argument("--gmsh", default="gmsh")
    parser.add_argument("--jobs", type=int, default=min(2, os.cpu_count() or 1), help="runs at a time (default 2)")
    parser.add_argument("--threads", type=int, default=1, help="threads of each run (default 1)")
    parser.add_argument("--seconds", type=float, default=60, help="limit of each run (default 60)")
    parser.add_argument("--busy", action="store_true", help="the limit is on CPU time: for machines with other work")
    parser.add_argument("--only", action="append", default=[], metavar="TEXT", help="files whose names contain TEXT")
    parser.add_argument("--sizes", choices=("default", "graded"), action="append", help="default: both")
    parser.add_argument("--json", help="file for all results")
    parser.add_argument("--markdown", help="file for the table and the summary")
    parser.add_argument("--keep", metavar="FOLDER", help="keep converted inputs, meshes and summaries there")
    parser.add_argument("--pictures", action="store_true", help="with --keep: draw the meshes, too")
    parser.epilog = "What follows -- is handed on to quadrille quad."
    words = sys.argv[1:] + ["--"]
    split = words.index("--")
    arguments = parser.parse_args(words[:split])
    arguments.options = words[split + 1:-1]
    arguments.top = top
    arguments.sizes = arguments.sizes or ["default", "graded"]
    return arguments


def main():
    arguments = parse_arguments()
    if not os.path.isdir(arguments.data):
        print("skipped: there is no folder " + arguments.data)
        return 0
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, stop)
    results, lines = [], []

    def emit(line):
        lines.append(line)
        print(line, flush=True)

    with tempfile.TemporaryDirectory() as temporary:
        folder = arguments.keep or temporary
        os.makedirs(folder, exist_ok=True)
        emit("| " + " | ".join(COLUMNS) + " |")
        emit("|" + " --- |" * len(COLUMNS))
        others = []
        with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
            running = collections.deque()

            def collect():
                results.append(running.popleft().result())
                emit(row(results[-1]))

            for case in find_cases(arguments, folder):
                if isinstance(case, Case):
                    running.append(pool.submit(run_case, case, arguments))
                else:
                    others.append("{}: {}".format(*case))
                while len(running) > 2 * arguments.jobs or (running and running[0].done()):
                    collect()
            while running:
                collect()
    emit("")
    for line in summarize(results):
        emit(line)
    emit("")
    emit("no planar domain:")
    for line in others:
        emit("  " + line)
    if arguments.markdown:
        with open(arguments.markdown, "w", encoding="utf-8") as file:
            file.write("\n".join(lines) + "\n")
    if arguments.json:
        record = {"commit": commit(arguments.top), "machine": platform.platform(), "cores": os.cpu_count(),
                  "jobs": arguments.jobs, "threads": arguments.threads, "seconds": arguments.seconds,
                  "results": results, "no_domain": others}
        with open(arguments.json, "w", encoding="utf-8") as file:
            json.dump(record, file, indent=1)
    return 1 if any(verdict(r) == "wrong" for r in results) else 0


if __name__ == "__main__":
    sys.exit(main())
