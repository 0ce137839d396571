# SPDX-License-Identifier: BSD-3-Clause
"""Reads records of build/bench/rebuild: cases by name, medians of their repetitions."""

import json
import statistics
from collections import namedtuple

MILLISECONDS = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}
VARIANTS = ("3lists", "tensor", "brute", "cells", "groups", "device", "step", "reordered",
            "sumatomic", "sumrows", "sumcolours", "key", "overlap", "intersection", "skin0", "skin0.05", "skin0.1", "skin0.2", "skin0.3", "skin0.5")


class Case(namedtuple("Case", "who workload form threads size first variant")):
    """<who>/<workload>/<form>/<threads>[/<size>-first-<variant>]"""

    @classmethod
    def parse(cls, name):
        who, workload, form, threads, *rest = name.split("/")
        words = rest[0].split("-") if rest else []
        variant = next((word for word in words if word in VARIANTS), "")
        size = next((word for word in words if word != "first" and word != variant), "")
        return cls(who, workload, form, int(threads), size, "first" in words, variant)

    def label(self):
        extra = "-".join(w for w in (self.size, "first" if self.first else "", self.variant) if w)
        return f"{self.workload}/{self.form}/{self.threads}" + (f"/{extra}" if extra else "")


class Runs:
    """The repetitions of one case."""

    def __init__(self):
        self.runs = []

    def times(self):
        """Milliseconds of a build in each repetition, ascending."""
        return sorted(run["real_time"] * MILLISECONDS[run["time_unit"]] for run in self.runs)

    def ms(self):
        return statistics.median(self.times())

    def get(self, counter):
        """Median of a counter; None where the contestant does not tell."""
        values = [run[counter] for run in self.runs if counter in run]
        return statistics.median(values) if values else None


def read(paths):
    """Contexts of the records, and the runs of every case."""
    contexts, cases = [], {}
    for path in paths:
        with open(path, encoding="utf-8") as file:
            record = json.load(file)
        if record["context"]:
            contexts.append(record["context"])
        for run in record["benchmarks"]:
            if run.get("run_type") == "iteration" and not run.get("error_occurred"):
                cases.setdefault(Case.parse(run["name"]), Runs()).runs.append(run)
    # Contestants of a group take turns at random: groups stay in order, in them plain cases come first.
    groups = {case: k for k, case in reversed(list(enumerate(case._replace(who="", variant="") for case in cases)))}
    in_order = sorted(cases, key=lambda case: (groups[case._replace(who="", variant="")], case.variant, case.who))
    return contexts, {case: cases[case] for case in in_order}
