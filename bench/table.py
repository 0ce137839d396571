#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Turns records of build/bench/rebuild into Markdown tables: medians with their spread beside the floor, the same
beside every peer that took part, and what lists, tensors, threads and a first build cost.

    build/bench/rebuild --benchmark_out=record.json
    python3 bench/table.py record.json [more.json ...]
"""

import sys

from record import read


def row(cells):
    return "| " + " | ".join(cells) + " |"


def number(value, form=".4g"):
    return "-" if value is None else format(value, form)


def our_cells(runs):
    times, floor = runs.times(), runs.get("floor_ms")
    entries = runs.get("entries_per_s")
    return [f"{runs.ms():.4g} ({times[0]:.4g}-{times[-1]:.4g})", number(runs.get("ns_per_node"), ".0f"),
            number(entries and entries / 1e6, ".0f"), number(runs.get("bytes_per_pair"), ".2f"),
            number(runs.get("peak_MiB"), ".0f"),
            number((runs.get("peak_MiB") or 0) * 1048576 / (runs.get("bytes_returned") or 1), ".2f"),
            number(floor), number(floor and runs.ms() / floor, ".1f")]


def main_table(cases):
    head = ["case", "ours ms", "ns/node", "M entries/s", "B/pair", "peak MiB", "peak / returned", "floor ms", "x floor"]
    lines = [row(head), "|" + "---|" * len(head)]
    lines += [row([case.label()] + our_cells(runs)) for case, runs in cases.items() if case.who == "ours"]
    return lines if len(lines) > 2 else []


def peer_cell(runs, ours):
    if runs is None:
        return "-"
    ratio = f"**{runs.ms() / ours.ms():.2f}**, " if ours else ""
    return f"{runs.ms():.4g} ({ratio}{number(runs.get('peak_MiB'), '.0f')})"


def peer_table(cases):
    """One line per case that somebody else took part in, one column per peer."""
    peers = sorted({case.who for case in cases} - {"ours"})
    lines = [row(["case", "ours ms (peak MiB)"] + peers), "|" + "---|" * (len(peers) + 2)]
    for case in dict.fromkeys(case._replace(who="ours") for case in cases if case.who in peers):
        ours = cases.get(case)
        lines.append(row([case.label(), peer_cell(ours, None)]
                         + [peer_cell(cases.get(case._replace(who=peer)), ours) for peer in peers]))
    return lines if peers else []


def peer_notes(contexts, cases):
    """What each peer delivers, and how far the counts of those in single precision are off."""
    notes = []
    for peer in sorted({case.who for case in cases} - {"ours"}):
        delivers = next((c["peer_" + peer] for c in contexts if "peer_" + peer in c), "")
        off = max(((runs.get("pairs_off") / (runs.get("pairs") or 1), runs.get("pairs_off"), case.label())
                   for case, runs in cases.items() if case.who == peer and runs.get("pairs_off") is not None),
                  default=None)
        if off:
            delivers += f"; counts off by up to {off[0]:.1g} of the pairs ({off[1]:.0f} in {off[2]})"
        if delivers:
            notes.append(f"- {peer}: {delivers}")
    return notes


def ratio_table(cases):
    """One line per workload and form where there is something to compare."""
    lines = [row(["case", "3 lists / 1", "tensor / ball", "1 thread / 2", "step / build", "reordered step / step", "GB/s returned / stores", "first - steady ms",
                  "page faults ms"]), "|" + "---|" * 9]
    for case, runs in cases.items():
        if case.who != "ours" or case.variant or case.first:
            continue

        def over(other):
            return cases[other].ms() / runs.ms() if other in cases else None

        step, reordered = case._replace(variant="step"), over(case._replace(variant="reordered"))
        first = cases.get(case._replace(first=True))
        returned = runs.get("bytes_returned")
        speed = returned / runs.ms() / 1e6 / runs.get("store_GBps")
        cells = [over(case._replace(variant="3lists")), over(case._replace(variant="tensor")),
                 over(case._replace(threads=1)) if case.threads == 2 else None, over(step),
                 reordered and step in cases and reordered / over(step) or None, speed,
                 first and first.ms() - runs.ms(),
                 first and returned / first.get("touch_large_GBps") / 1e6]
        if any(cell is not None for cell in cells[:5] + cells[6:]):
            lines.append(row([case.label()] + [number(cell, ".3g") for cell in cells]))
    return lines if len(lines) > 2 else []


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    contexts, cases = read(sys.argv[1:])
    for context in contexts:
        print(f"{context['date'][:16]}, {context['num_cpus']} x {context.get('cpu', '?')}, "
              f"load {context['load_avg'][0]:.1f} at the start; {context.get('compiler', '?')}; "
              f"{context.get('connectivity', '')}.")
    print("Median (fastest-slowest) of the repetitions. Cases: workload/form/threads[/extra]. Every build sees points "
          "displaced by 0.05 of their support; a yardstick's do not move. Peak: memory the first build added. Floor: 5 ms "
          "per million nodes and the bytes returned at the speed of streaming stores in the same process.\n")
    print("\n".join(main_table(cases)))
    beside = peer_table(cases)
    if beside:
        print("\nPeers, in the same run: ms (**times ours**, peak MiB); above 1 the peer takes longer.\n")
        print("\n".join(beside))
        print("\n" + "\n".join(peer_notes(contexts, cases)))
    ratios = ratio_table(cases)
    if ratios:
        print("\nPage faults: the bytes returned at the speed of first stores into large pages.\n")
        print("\n".join(ratios))


if __name__ == "__main__":
    main()
