#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Turns records of build/bench/rebuild into a Markdown table: medians, their spread, and the ratio to the peer.

    build/bench/rebuild --benchmark_out=record.json
    python3 bench/table.py record.json [more.json ...]
"""

import json
import statistics
import sys
from collections import defaultdict


def read(paths):
    """Contexts of the records, and for every case (workload, form, threads, extra) the runs of each contestant."""
    contexts, cases = [], defaultdict(lambda: defaultdict(list))
    for path in paths:
        with open(path, encoding="utf-8") as file:
            record = json.load(file)
        contexts.append(record["context"])
        for run in record["benchmarks"]:
            if run.get("run_type") != "iteration" or run.get("error_occurred"):
                continue
            who, *case = run["name"].split("/")
            cases[tuple(case)][who].append(run)
    return contexts, cases


def median(runs, key):
    return statistics.median(run[key] for run in runs)


def milliseconds(runs):
    """Median of the builds' own clocks, with the fastest and the slowest repetition."""
    unit = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}
    times = sorted(run["real_time"] * unit[run["time_unit"]] for run in runs)
    return statistics.median(times), times[0], times[-1]


def table(cases, us="ours"):
    peers = sorted({who for runs in cases.values() for who in runs} - {us})
    head = ["case", f"{us} ms", "ns/node", "M entries/s", "B/pair", "peak MiB"]
    for peer in peers:
        head += [f"{peer} ms", "M entries/s", "B/pair", "peak MiB", f"{peer} / {us}"]
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    for case, runs in cases.items():
        cells = ["/".join(case)]
        for who in [us] + peers:
            if who not in runs:
                cells += ["-"] * 5
                continue
            middle, least, most = milliseconds(runs[who])
            cells.append(f"{middle:.4g} ({least:.4g}-{most:.4g})")
            if who == us:
                cells.append(f"{median(runs[who], 'ns_per_node'):.0f}")
            cells.append(f"{median(runs[who], 'entries_per_s') / 1e6:.0f}")
            cells.append(f"{median(runs[who], 'bytes_per_pair'):.2f}")
            cells.append(f"{median(runs[who], 'peak_MiB'):.0f}")
            if who != us:
                ours = milliseconds(runs[us])[0] if us in runs else float("nan")
                cells.append(f"{middle / ours:.2f}")
        lines.append("| " + " | ".join(cells) + " |")
    return lines


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    contexts, cases = read(sys.argv[1:])
    for context in contexts:
        print(f"{context['date'][:16]}, {context['num_cpus']} x {context.get('cpu', '?')}, "
              f"load {context['load_avg'][0]:.1f} at the start; {context.get('compiler', '?')}; "
              f"{context.get('connectivity', '')}.")
    print("Median (fastest-slowest) of the repetitions. Cases: workload/form/threads[/first]; a ratio above 1 means "
          "that the peer takes longer.\n")
    print("\n".join(table(cases)))


if __name__ == "__main__":
    main()
