#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Charts of records of build/bench/gravity, each with a CSV of what it shows; without matplotlib only those.

    python3 bench/gravity_charts.py record.json [more.json ...] --out DIR

P4 error of the acceleration (rms, p99, max) against time per particle, P5 momentum drift and error of the potential
against time per particle, P6 time against size at a fixed tolerance, and where the automatic choice switches.
"""

import argparse
import json
import pathlib
import statistics

from charts import Chart, pyplot

MILLISECONDS = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}
METHODS = {0: "auto", 1: "direct", 2: "walk", 3: "fmm"}
MARKERS = {"direct": "*", "walk": "o", "fmm": "s"}
STATISTICS = ("rms", "p99", "max")


def read(paths):
    """Contexts, and {name: {counter: median of the repetitions}} with the time as `ms`."""
    contexts, runs = [], {}
    for path in paths:
        record = json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
        contexts.append(record["context"])
        for run in record["benchmarks"]:
            if run.get("run_type") == "iteration" and not run.get("error_occurred"):
                run["ms"] = run["real_time"] * MILLISECONDS[run["time_unit"]]
                runs.setdefault(run["name"].removesuffix("/real_time"), []).append(run)
    return contexts, {name: {key: statistics.median(r[key] for r in repeated)
                             for key, value in repeated[0].items() if isinstance(value, (int, float))}
                      for name, repeated in runs.items()}


def machine(contexts, cases):
    threads = sorted({int(case["threads_used"]) for case in cases.values()})
    context = contexts[0]
    return (f"{context['host_name']}, {context['num_cpus']} processors of {context['mhz_per_cpu']} MHz, "
            f"{'/'.join(map(str, threads))} threads, {context['date'][:10]}")


def work_cases(cases):
    """{(scene, particles): {series: [(epsilon, counters), ...]}}"""
    found = {}
    for name, case in cases.items():
        kind, scene, n, *rest = name.split("/")
        if kind != "work":
            continue
        method, order, acceptance, near, epsilon, *symmetric = rest
        series = " ".join([method] + ([order, acceptance] if method != "direct" else []) +
                          (["float"] if near == "float32" else []) + symmetric)
        found.setdefault((scene, int(n)), {}).setdefault(series, []).append((float(epsilon), case))
    return found


def ns(case):
    return 1e6 * case["ms"] / case["particles"]


def panels(chart, series, quantities, caption, floor):
    """One panel for each of {counter: label}, time per particle along x; what is below `floor` is drawn there."""
    if pyplot is None:
        return
    figure, all_axes = pyplot.subplots(1, len(quantities), figsize=(5.2 * len(quantities), 6), squeeze=False)
    colours = pyplot.get_cmap("tab20").colors
    for axes, (counter, label) in zip(all_axes[0], quantities.items()):
        for k, (legend, points) in enumerate(series.items()):
            at = [(ns(case), max(case[counter], floor)) for _, case in points]
            axes.plot(*zip(*at), marker=MARKERS[legend.split()[0]], markersize=4, linewidth=1, label=legend,
                      color=colours[k % len(colours)], linestyle="--" if "float" in legend else "-")
        axes.set(xscale="log", yscale="log", xlabel="ns per particle", ylabel=label)
        axes.grid(alpha=0.3, which="both")
    figure.legend(*all_axes[0][0].get_legend_handles_labels(), fontsize=7, ncol=6, loc="upper center")
    figure.text(0.01, 0.01, caption, fontsize=7, wrap=True, va="bottom")
    figure.tight_layout(rect=(0, 0.06, 1, 0.9))
    figure.savefig(chart.path.with_suffix(".png"), dpi=130)
    pyplot.close(figure)
    chart.path.with_suffix(".txt").write_text(caption + "\n", encoding="utf-8")


def fastest(series, counter, bound):
    """Least time per particle with this error, and who; None if nobody has it."""
    return min(((ns(case), legend) for legend, points in series.items() for _, case in points
                if case[counter] <= bound), default=None)


def rows_of(series, counters):
    return [[legend, epsilon, ns(case)] + [case[c] for c in counters]
            for legend, points in series.items() for epsilon, case in points]


def work_precision(cases, out, where):
    counters = [f"force_{s}" for s in STATISTICS]
    for (scene, n), series in work_cases(cases).items():
        chart = Chart(out, f"P4_{scene}_{n}", ["series", "epsilon", "ns_per_particle"] + counters,
                      rows_of(series, counters))
        tail, legend, epsilon = max((case["force_max"] / max(case["force_p99"], 1e-16), legend, epsilon)
                                    for legend, points in series.items() for epsilon, case in points)
        worst, bad, wide = max((case["force_max"], legend, epsilon)
                               for legend, points in series.items() for epsilon, case in points)
        best = [f"{bound:g} by {found[1]} ({found[0]:.0f} ns)" for bound in (1e-2, 1e-4, 1e-6)
                if (found := fastest(series, "force_p99", bound))]
        panels(chart, series, {f"force_{s}": f"{s} of |error of a| / |a|" for s in STATISTICS},
               f"P4: error of accelerations of {scene}, {n} particles, by method, order and acceptance, epsilon along each "
               f"line (error of 1000 particles); fails where epsilon is wide: {bad} at {wide:g} is off by {worst:.2g}, and "
               f"the tail is longest, {tail:.0f} times the p99, for {legend} at {epsilon:g}; p99 fastest: "
               f"{', '.join(best)}; no other code took part. {where}.", 1e-13)


def conservation(cases, out, where):
    counters = ["drift", "potential_rms", "potential_p99", "potential_max"]
    for (scene, n), series in work_cases(cases).items():
        chart = Chart(out, f"P5_{scene}_{n}", ["series", "epsilon", "ns_per_particle"] + counters,
                      rows_of(series, counters))
        drift, legend, epsilon = max((case["drift"], legend, epsilon) for legend, points in series.items()
                                     for epsilon, case in points)
        kept = [case["drift"] for legend, points in series.items() if "symmetric" in legend or legend == "direct"
                for _, case in points]
        promise = (f"symmetric and direct sums drift by {max(kept):.1g} at most" if kept else
                   "no symmetric sum was measured")
        panels(chart, series, {"drift": "|sum m a| / sum m|a|", "potential_p99": "p99 of |error of phi| / sum m/r"},
               f"P5: momentum drift and error of the potential of {scene}, {n} particles; {promise}; momentum is not "
               f"conserved by one-sided acceptance, worst by {legend} at {epsilon:g}: {drift:.1g}. {where}.", 1e-18)


def time_cases(cases):
    """{(scene, tolerance): {method: [(particles, counters), ...]}}; direct sums serve all tolerances."""
    found, direct = {}, {}
    for name, case in cases.items():
        kind, scene, n, *rest = name.split("/")
        if kind == "time" and rest[0] == "direct":
            direct.setdefault(scene, []).append((int(n), case))
        elif kind == "time":
            found.setdefault((scene, float(rest[1])), {}).setdefault(rest[0], []).append((int(n), case))
    for (scene, _), curves in found.items():
        curves["direct"] = direct.get(scene, [])
        for points in curves.values():
            points.sort(key=lambda point: point[0])
    return found


def switches(points):
    """[(particles between which it switches), methods] of the automatic choice."""
    changes = []
    for (n, case), (next_n, next_case) in zip(points, points[1:]):
        if case["method"] != next_case["method"]:
            changes.append(((n * next_n) ** 0.5, METHODS[case["method"]], METHODS[next_case["method"]]))
    return changes


def crossovers(cases, out, where):
    for (scene, tolerance), curves in time_cases(cases).items():
        rows = [[method, n, case["ms"], METHODS[case["method"]], case["force_p99"], case["force_max"]]
                for method, points in curves.items() for n, case in points]
        chart = Chart(out, f"P6_{scene}_{tolerance:.0e}", ["asked", "particles", "ms", "method", "force_p99", "force_max"], rows)
        changes = switches(curves.get("auto", []))
        at = {n: {row[0]: row[2] for row in rows if row[1] == n} for n in {row[1] for row in rows}}
        slower = max(((times["auto"] / min(t for m, t in times.items() if m != "auto"), n) for n, times in at.items()
                      if "auto" in times and len(times) > 1), default=None)
        missed = [f"{row[0]} at {row[1]} ({row[4]:.1g})" for row in rows if row[0] != "direct" and row[4] > tolerance]
        caption = (f"P6: time of {scene} to p99 <= {tolerance:g}, check on a sample of 300 included; automatic switches "
                   + ("; ".join(f"from {a} to {b} near {n:.0f} particles" for n, a, b in changes) or "nowhere here")
                   + (f"; it is furthest from the best method at {slower[1]} particles, {slower[0]:.2f} times" if slower else "")
                   + ("; p99 of 1000 particles is above the tolerance for " + ", ".join(missed) if missed
                      else "; no case misses the tolerance") + f". {where}.")
        if pyplot is None:
            continue
        figure, axes = pyplot.subplots(figsize=(7, 5))
        for method, points in curves.items():
            if points:
                axes.plot([n for n, _ in points], [case["ms"] for _, case in points], marker=MARKERS.get(method, "x"),
                          label=method, linewidth=3 if method == "auto" else 1, alpha=0.5 if method == "auto" else 1)
        for n, before, after in changes:
            axes.axvline(n, color="black", linewidth=0.7, linestyle=":")
            axes.annotate(f"{before} | {after}", (n, 0.97), xycoords=("data", "axes fraction"), ha="center", va="top", fontsize=7)
        axes.set(xscale="log", yscale="log", xlabel="particles", ylabel="ms")
        axes.grid(alpha=0.3, which="both")
        axes.legend(fontsize=8)
        chart.save(figure, caption)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("records", nargs="+")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("charts"))
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    contexts, cases = read(arguments.records)
    for chart in (work_precision, conservation, crossovers):
        chart(cases, arguments.out, machine(contexts, cases))
    print(f"{arguments.out}: " + ("CSV and PNG" if pyplot else "CSV only, matplotlib (python3-matplotlib) is missing"))


if __name__ == "__main__":
    main()
