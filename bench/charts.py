#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Charts of records of build/bench/rebuild, each with a CSV of what it shows; without matplotlib only those.

    python3 bench/charts.py record.json [more.json ...] --out DIR

P7 time per node against size, and contestants side by side, P8 search methods on hard scenes, P9 reuse of pairs with a skin, P13 price of deterministic sums, P16 price of features, P17 price of checking the input, P18 small builds.
"""

import argparse
import csv
import math
import pathlib

from record import read

try:
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
except ImportError:
    pyplot = None

FITTED_FROM = 9000  # nodes: what W1@1e4 and its like have at least


class Chart:
    """A table of rows that becomes a CSV and, by `lines` or `bars`, a picture with a caption."""

    def __init__(self, out, name, columns, rows):
        self.path, self.rows = out / name, rows
        with open(self.path.with_suffix(".csv"), "w", newline="", encoding="utf-8") as file:
            csv.writer(file).writerows([columns] + rows)

    def save(self, figure, caption):
        figure.text(0.01, 0.01, caption, fontsize=7, wrap=True, va="bottom")
        figure.tight_layout(rect=(0, 0.09, 1, 1))
        figure.savefig(self.path.with_suffix(".png"), dpi=130)
        pyplot.close(figure)
        self.path.with_suffix(".txt").write_text(caption + "\n", encoding="utf-8")

    def lines(self, curves, labels, caption, log_y=True, log_x=True):
        """curves: {legend: [(x, y), ...]}"""
        if pyplot is None or not curves:
            return
        figure, axes = pyplot.subplots(figsize=(7, 4.8))
        for (legend, points), marker in zip(curves.items(), "osv^D<>ph*dXP+x1234" * 9):
            axes.plot(*zip(*points), marker=marker, markersize=4, linewidth=1, label=legend)
        if log_x:
            axes.set_xscale("log")
        if log_y:
            axes.set_yscale("log")
        axes.set_xlabel(labels[0])
        axes.set_ylabel(labels[1])
        axes.grid(alpha=0.3, which="both")
        axes.legend(fontsize=7, ncol=2)
        self.save(figure, caption)

    def bars(self, groups, labels, caption):
        """groups: {group: {legend: height}}"""
        if pyplot is None or not groups:
            return
        figure, axes = pyplot.subplots(figsize=(9, 4.8))
        legends = list(dict.fromkeys(legend for heights in groups.values() for legend in heights))
        width = 0.8 / len(legends)
        for k, legend in enumerate(legends):
            at = [(x + k * width, heights[legend]) for x, heights in enumerate(groups.values()) if legend in heights]
            axes.bar(*zip(*at), width=width, label=legend)
        axes.set_yscale("log")
        axes.axhline(1, color="black", linewidth=0.5)
        axes.set_xticks([x + 0.4 - width / 2 for x in range(len(groups))], list(groups), rotation=45, fontsize=8)
        axes.set_ylabel(labels)
        axes.legend(fontsize=7, ncol=len(legends))
        self.save(figure, caption)


def slope(points):
    """Of log y against log x, by least squares; nan for fewer than two sizes."""
    logs = [(math.log(x), math.log(y)) for x, y in points if x >= FITTED_FROM]
    if len({x for x, _ in logs}) < 2:
        return math.nan
    mean_x, mean_y = (sum(column) / len(logs) for column in zip(*logs))
    return (sum((x - mean_x) * (y - mean_y) for x, y in logs) / sum((x - mean_x) ** 2 for x, _ in logs))


def curves_of(cases, value, select):
    """{(who, workload, form, threads, variant): [(nodes, value), ...]} of steady builds, by ascending size."""
    curves = {}
    for case, runs in cases.items():
        y = value(runs)
        if not case.first and y and runs.get("nodes") and select(case):
            key = (case.who, case.workload, case.form, case.threads, case.variant)
            curves.setdefault(key, []).append((runs.get("nodes"), y))
    return {key: sorted(points) for key, points in sorted(curves.items())}


def is_plain(case):
    return case.workload[0] == "W" and not case.variant and case.size not in ("1", "10", "100")


def time_per_node(cases, out):
    curves = curves_of(cases, lambda runs: runs.get("ns_per_node"), lambda case: case.who == "ours" and is_plain(case))
    slopes = {key: slope(points) for key, points in curves.items()}
    Chart(out, "P7_time_per_node", ["workload", "form", "threads", "nodes", "ns_per_node", "slope_from_1e4"],
          [[*key[1:4], n, ns, slopes[key]] for key, points in curves.items() for n, ns in points])
    for form in sorted({key[2] for key in curves}):
        mine = {key: p for key, p in curves.items() if key[2] == form and key[3] == max(k[3] for k in curves)}
        known = {key: slopes[key] for key in mine if not math.isnan(slopes[key])}
        worst = max(known, key=lambda key: abs(known[key]), default=None)
        caption = (f"P7: time per node of {form}, {next(iter(mine), '????')[3]} threads, steady state; "
                   + (f"furthest from O(N) on {worst[1]}, where the slope from 1e4 nodes on is {known[worst]:+.3f} "
                      "(0.15 either way allowed)." if worst else "too few sizes for a slope."))
        chart = Chart(out, f"P7_time_per_node_{form}", ["workload", "nodes", "ns_per_node"],
                      [[key[1], n, ns] for key, points in mine.items() for n, ns in points])
        chart.lines({f"{key[1]}  {slopes[key]:+.3f}": points for key, points in mine.items()},
                    ("nodes", "ns per node"), caption)


def beside_peers(cases, out):
    """Whoever took part, relative to ours: the largest size of every workload and form, with most threads."""
    whos = {}
    for case, runs in cases.items():
        if is_plain(case) and not case.first and runs.get("nodes"):
            whos.setdefault(case._replace(who=""), {})[case.who] = runs
    most = max((case.threads for case in whos), default=0)
    for form in sorted({case.form for case in whos}):
        rows, heights, sizes = [], {}, {}
        for case, runs in whos.items():
            if case.form != form or case.threads != most or "ours" not in runs or len(runs) < 2:
                continue
            nodes, ours = runs["ours"].get("nodes"), runs["ours"].ms()
            if nodes > sizes.get(case.workload, 0):
                sizes[case.workload] = nodes
                heights[case.workload] = {who: r.ms() / ours for who, r in sorted(runs.items()) if who != "ours"}
            rows += [[case.workload, nodes, who, r.ms(), r.ms() / ours] for who, r in sorted(runs.items())]
        if not rows:
            continue
        chart = Chart(out, f"P7_beside_peers_{form}", ["workload", "nodes", "who", "ms", "over_ours"], rows)
        ratio, who, workload = min((ratio, who, w) for w, ratios in heights.items() for who, ratio in ratios.items())
        chart.bars(heights, "time / ours", f"P7: {form}, {most} threads, time of other searches over ours, largest size of "
                   f"each workload; closest is {who} on {workload}, {ratio:.2f} times ours. What each of them delivers is "
                   "said in table.md; a missing bar: not able to, or too slow.")


def hard_scenes(cases, out):
    """Automatic choice, the methods by name, and peers, relative to the best method."""
    times = {}
    for case, runs in cases.items():
        method = case.who if case.who != "ours" else case.variant or "automatic"
        hard = case.workload[0] == "A" or case.size == "1e4"
        if hard and case.form == "rows" and case.threads == 2 and method not in ("3lists", "tensor"):
            times.setdefault(case.workload, {})[method] = runs.ms()
    rows, heights = [], {}
    for scene, ms in times.items():
        named = {method: t for method, t in ms.items() if method in ("brute", "cells", "groups")}
        if not named or "automatic" not in ms:
            continue
        best = min(named, key=named.get)
        heights[scene] = {method: t / named[best] for method, t in ms.items()}
        base = times.get(scene + "base", {}).get("automatic")
        rows += [[scene, method, t, t / named[best], best, base and ms["automatic"] / base] for method, t in ms.items()]
    chart = Chart(out, "P8_hard_scenes", ["scene", "method", "ms", "over_best", "best", "automatic_over_base"], rows)
    worst = max(heights, key=lambda scene: heights[scene]["automatic"], default=None)
    chart.bars(heights, "time / best method", worst and (
        "P8: rows of hard scenes, 2 threads, by search method (W1-W7 with 1e4 nodes; no brute or cells in A16: they take "
        f"minutes); the automatic choice is furthest from the best on {worst}, "
        f"{heights[worst]['automatic']:.2f} times (1.2 allowed); cells fail on wide ranges of supports."))


def reuse(cases, out):
    """Steps of a host that rebuilds only where it must, relative to a rebuild each step (skin 0)."""
    rows, curves = [], {}
    for case, runs in cases.items():
        base = cases.get(case._replace(variant="skin0"))
        if case.variant.startswith("skin") and base:
            skin, ratio = float(case.variant[4:]), runs.ms() / base.ms()
            rows.append([case.workload, case.threads, runs.get("nodes"), skin, runs.ms(), ratio, runs.get("rebuilds")])
            curves.setdefault(f"{case.workload}@{case.size}, {case.threads} threads", []).append((skin, ratio))
    chart = Chart(out, "P9_reuse", ["workload", "threads", "nodes", "skin_over_support", "ms_per_step", "over_skin_0",
                                    "rebuilds_per_100_steps"], rows)
    best = min(rows, key=lambda row: row[5], default=None)
    chart.lines({name: sorted(points) for name, points in curves.items()},
                ("skin / mean support", "time of a step / the same without skin"), best and (
        "P9: step of a host (move, ask, rebuild pairs if told, sum densities), mean of 100, nodes 0.005 of the mean "
        f"support a step; fastest on {best[0]} with a skin of {best[3]:g}: {best[5]:.2f} times, {best[6]:.0f} rebuilds; "
        "pairs within the support at the end are those of the definition for all skins."), False, False)


def price_of_determinism(cases, out):
    """Sums over pairs whose bits do not depend on threads, relative to atomic additions."""
    rows, heights = [], {}
    for case, runs in cases.items():
        base = cases.get(case._replace(variant="sumatomic"))
        if case.variant.startswith("sum") and base:
            ratio = runs.ms() / base.ms()
            rows.append([case.workload, case.threads, runs.get("nodes"), case.variant[3:], runs.ms(), ratio])
            heights.setdefault(f"{case.workload}{'@' + case.size if case.size else ''}, {case.threads}", {})[
                case.variant[3:]] = ratio
    chart = Chart(out, "P13_price_of_determinism", ["workload", "threads", "nodes", "way", "ms", "over_atomic"], rows)
    worst = max((row for row in rows if row[3] == "rows"), key=lambda row: row[5], default=None)
    chart.bars(heights, "time / atomic additions", worst and (
        "P13: one stored double a pair summed at both nodes, by scene and threads, nodes in spatial order: gathered along rows "
        f"(same bits with any number of threads) costs most on {worst[0]} with {worst[1]} threads: {worst[5]:.2f} times the "
        "atomic sum (1.2 allowed on 2); lists of entry and colour, made once per rebuild, are not counted."))


def price_of_features(cases, out):
    """Rows, pairs and one more product, relative to rows and pairs."""
    rows, heights = [], {}
    for case, runs in cases.items():
        base = cases.get(case._replace(variant=""))
        if case.variant in ("key", "overlap", "intersection") and base:
            time = runs.ms() / base.ms()
            memory = (runs.get("peak_MiB") or 0) / (base.get("peak_MiB") or math.nan)
            rows.append([case.workload, case.threads, runs.get("nodes"), case.variant, runs.ms(), time, runs.get("peak_MiB"), memory])
            heights.setdefault(f"{case.workload}{'@' + case.size if case.size else ''}, {case.threads}", {})[
                case.variant] = time
    chart = Chart(out, "P16_price_of_features", ["workload", "threads", "nodes", "feature", "ms", "over_base", "peak_MiB",
                                                 "peak_over_base"], rows)
    worst = max(rows, key=lambda row: row[5], default=None)
    chart.bars(heights, "time / rows and pairs alone", worst and (
        "P16: rows and pairs with one more product, relative to rows and pairs alone, by scene and threads; "
        f"{worst[3]} on {worst[0]} with {worst[1]} threads costs most, {worst[5]:.1f} times, at {worst[7]:.1f} times the peak "
        "memory; what is not asked for costs nothing."))


def price_of_checks(cases, out):
    curves = curves_of(cases, lambda runs: runs.get("check_percent"),
                       lambda case: case.who == "ours" and is_plain(case) and case.form == "rows" and case.threads == 2)
    chart = Chart(out, "P17_price_of_checks", ["workload", "nodes", "percent_of_build"],
                  [[key[1], n, share] for key, points in curves.items() for n, share in points])
    highest = max(((share, n, key[1]) for key, points in curves.items() for n, share in points), default=None)
    chart.lines({key[1]: points for key, points in curves.items()}, ("nodes", "% of a build"), highest and (
        "P17: price of reading and checking the input, rows, 2 threads, steady state (3 % allowed); highest "
        f"{highest[0]:.1f} % on {highest[2]} with {highest[1]:.0f} nodes, where a build does least per node."), False)


def small_builds(cases, out):
    curves = curves_of(cases, lambda runs: 1e3 * runs.ms(), lambda case: case.workload == "W1" and case.form == "rows"
                       and case.size in ("1", "10", "100", "1e3", "1e4") and case.variant not in ("3lists", "tensor"))
    chart = Chart(out, "P18_small_builds", ["who", "method", "threads", "nodes", "us_per_build"],
                  [[key[0], key[4] or "automatic", key[3], n, us] for key, p in curves.items() for n, us in p])
    chart.lines({" ".join(filter(None, (key[0], key[4], f"on {key[3]}"))): points for key, points in curves.items()},
                ("nodes", "us per build"), "P18: rows of small W1 lattices, steady state; the start of threads is the "
                "floor for few nodes (compare 1 thread), and brute force loses beyond some dozens of nodes.")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("records", nargs="+")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("charts"))
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    _, cases = read(arguments.records)
    for chart in (time_per_node, beside_peers, hard_scenes, reuse, price_of_determinism, price_of_features, price_of_checks, small_builds):
        chart(cases, arguments.out)
    print(f"{arguments.out}: " + ("CSV and PNG" if pyplot else "CSV only, matplotlib (python3-matplotlib) is missing"))


if __name__ == "__main__":
    main()
