#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the benchmarks and prints their ratio tables as Markdown; every number of a table is of one run.

    report.py BUILD_DIRECTORY [--json FILE] [--repetitions N] [--filter REGEX]

Times are medians of CPU time (wall time where two threads are compared).
"""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile

SIZES = [20, 200, 2000, 20000, 200000]
ENGINES = ["flann", "tree", "fast"]
# Microseconds per query over those of the FLANN search alone that found as many faces, from runs of CGAL 6.1.1 and
# DGtal (2026) on another machine: 20, 117, 864, 8494 over 3.9, 9.1, 45, 435.
PEERS = {20: 20 / 3.9, 200: 117 / 9.1, 2000: 864 / 45, 20000: 8494 / 435}


def run(program, arguments):
    with tempfile.TemporaryDirectory() as directory:
        out = os.path.join(directory, "out.json")
        subprocess.run([program, "--benchmark_out=" + out, "--benchmark_out_format=json"] + arguments, check=True,
                       stdout=sys.stderr)
        with open(out, encoding="utf-8") as file:
            return json.load(file)


def medians(result):
    """Name -> median over the repetitions."""
    return {b["run_name"]: b for b in result["benchmarks"] if b.get("aggregate_name") == "median"}


class Table:
    def __init__(self, title, *columns):
        self.lines = ["", "### " + title, "", "| " + " | ".join(columns) + " |",
                      "|" + "---|" * len(columns)]

    def row(self, *cells):
        self.lines.append("| " + " | ".join(cells) + " |")

    def print(self):
        print("\n".join(self.lines))


def microseconds(found, name):
    return found[name]["us"] if name in found else math.nan


def show(value, digits=3):
    return "" if math.isnan(value) else f"{value:.{digits}g}"


def sum_name(surface, engine, size, definition="exact", task="sum"):
    return f"{task}/{surface}/{engine}/{size}/{definition}/1"


def ball_table(found, surface, definition):
    if not any(sum_name(surface, e, size, definition) in found for e in ENGINES for size in SIZES):
        return
    table = Table(f"{surface}, {definition} balls: microseconds per query", "faces asked", "faces met",
                  "FLANN search alone", "FlannBallSum", "MeasureTree double", "MeasureTree fast", "FLANN / double", "FLANN / fast")
    for size in SIZES:
        us = {e: microseconds(found, sum_name(surface, e, size, definition)) for e in ENGINES}
        met = found.get(sum_name(surface, "tree", size, definition), {}).get("faces", math.nan)
        search = microseconds(found, f"search/{surface}/flann/{size}")
        table.row(str(size), f"{met:.0f}", show(search), *(show(us[e]) for e in ENGINES),
                  show(us["flann"] / us["tree"]), show(us["flann"] / us["fast"]))
    table.print()


def exponent(found, surface, engine):
    """Slope of log time over log faces met, from 200 to 200,000."""
    points = []
    for size in SIZES[1:]:
        b = found.get(sum_name(surface, engine, size))
        if b:
            points.append((math.log(b["faces"]), math.log(b["us"])))
    if len(points) < 2:
        return math.nan
    mx, my = (sum(p[i] for p in points) / len(points) for i in (0, 1))
    return sum((x - mx) * (y - my) for x, y in points) / sum((x - mx) ** 2 for x, _ in points)


def exponent_table(found):
    table = Table("Exponent of time in the faces of a ball, 200 to 200,000", "surface", *ENGINES)
    for surface in ("torus", "terrain"):
        table.row(surface, *(show(exponent(found, surface, e)) for e in ENGINES))
    table.print()


def over_torus_table(found, title, rows):
    """Time over that of the torus in spatial order, for (label, surface, task)."""
    table = Table(title, "what", "faces asked", *ENGINES)
    for label, surface, task in rows:
        for size in SIZES[:-1]:
            ratios = [microseconds(found, sum_name(surface, e, size, task=task)) /
                      microseconds(found, sum_name("torus", e, size)) for e in ENGINES]
            table.row(label, str(size), *(show(r) for r in ratios))
    table.print()


def hard_tables(found):
    over_torus_table(found, "Faces of unlike sizes: time over that of the torus",
                     [("one face 10^4 times the others", "huge", "sum"),
                      ("one per cent of Pareto(1.2) sizes", "pareto", "sum")])
    over_torus_table(found, "Disorder: time over that of the torus in spatial order",
                     [("queries in random order", "torus", "random"),
                      ("vertices and faces in random order", "shuffled", "sum")])


def radii_table(found):
    table = Table("Five radii (1 to 1/4 by 1/sqrt 2) in one call: time over that of five calls", "faces asked", *ENGINES)
    for size in SIZES[:-1]:
        ratios = [microseconds(found, sum_name("torus", e, size, task="five")) /
                  microseconds(found, sum_name("torus", e, size, task="one_by_one")) for e in ENGINES]
        table.row(str(size), *(show(r) for r in ratios))
    table.print()


def peer_table(found):
    table = Table("Beside peers: time over that of a FLANN search for the same ball, torus", "faces asked",
                  "CGAL 6.1.1", "FlannBallSum", "MeasureTree double", "MeasureTree fast")
    for size, peer in PEERS.items():
        search = microseconds(found, f"search/torus/flann/{size}")
        table.row(str(size), show(peer), *(show(microseconds(found, sum_name("torus", e, size)) / search, 2)
                                           for e in ENGINES))
    table.print()


def build_table(found):
    table = Table("Building, a million triangles", "engine", "ms", "over FLANN",
                  "bytes a triangle, with its measures")
    flann = found.get("build/torus/flann", {}).get("cpu_time", math.nan)
    for e in ENGINES:
        b = found.get(f"build/torus/{e}")
        if b:
            table.row(e, show(b["cpu_time"]), show(b["cpu_time"] / flann), show(b.get("bytes_per_triangle", math.nan)))
    table.print()


def thread_table(found):
    one, two = (next((b for n, b in found.items() if n.startswith(f"threads/torus/tree/2000/exact/{k}")), None)
                for k in (1, 2))
    if one and two:
        print(f"\nTwo threads over one: {one['real_time'] / two['real_time']:.2f} (wall time)")


def measure_table(found):
    table = Table("Local measures, a million faces", "what", "ms", "GB/s", "of the triad", "over the plain loop")
    triad, plain = found["triad"]["bytes_per_second"], found["measures/plain_loop"]["cpu_time"]
    for name, b in found.items():
        times = "" if name == "triad" else show(plain / b["cpu_time"])
        table.row(name, show(b["cpu_time"]), show(b["bytes_per_second"] / 1e9), show(b["bytes_per_second"] / triad),
                  times)
    table.print()


def whole_runs(at):
    return {p: json.loads(subprocess.run([os.path.join(at, "whole_run"), p], check=True, stdout=subprocess.PIPE).stdout)
            for p in ("double", "fast")}


def whole_table(runs):
    table = Table("A whole run: curvatures at all vertices of the torus, balls of 200 faces", "precision", "points",
                  "CPU s", "peak MiB of the process, with the mesh and the result")
    for precision, r in runs.items():
        table.row(precision, str(r["points"]), show(r["cpu_s"]), f"{r['peak_mib']:.0f}")
    table.print()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("--json", help="also write everything measured to this file")
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--filter", default=".", help="of the ball sums to run")
    parser.add_argument("--min-time", type=float, default=0.2, help="seconds a repetition")
    options = parser.parse_args()
    common = [f"--benchmark_repetitions={options.repetitions}", "--benchmark_report_aggregates_only=true",
              "--benchmark_enable_random_interleaving=true",
              f"--benchmark_min_time={options.min_time}"]
    at = os.path.join(options.build, "benchmarks")
    sums = run(os.path.join(at, "ball_sums_benchmark"), common + ["--benchmark_filter=" + options.filter])
    local = run(os.path.join(at, "local_measures_benchmark"), common)
    found = medians(sums)
    print(f"Kernels: {sums['context']['kernels']}")
    for surface in ("torus", "terrain"):
        for definition in ("exact", "fraction"):
            ball_table(found, surface, definition)
    exponent_table(found)
    hard_tables(found)
    radii_table(found)
    peer_table(found)
    build_table(found)
    thread_table(found)
    measure_table(medians(local))
    sys.stdout.flush()
    runs = whole_runs(at)
    whole_table(runs)
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump({"ball_sums": sums, "local_measures": local, "whole_runs": runs}, file, indent=1)


if __name__ == "__main__":
    main()
