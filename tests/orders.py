#!/usr/bin/env python3
# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""orders.py: orders in space: errors of flows and bars with exact solutions by the number of particles, and the order
from each size to the next.

usage: orders.py [--quick] [--jobs N] [--only WORD] [--keep] [--tool build/sph]
Writes build/orders.csv (name,value,unit,target,ok); `make orders` copies it to tests/results. Causes of what is not of
second order: README, findings. Bars are run by build/orders_bar.
"""
import math, os, subprocess, sys

from validate_water import standing_period
from validation import main, Run


def bars():
    """Errors of the frequency of a bar by form and number of particles, from build/orders_bar."""
    program = os.path.join("build", "orders_bar")
    done = subprocess.run([program], stdout=subprocess.PIPE, text=True, check=True)
    rows = [line.split(",") for line in done.stdout.split()]
    return {(form, int(n)): float(e) for form, n, e in rows}


def cases(quick):
    """Rows to be: (name, unit, target or None, runs, figure)."""
    rows = []

    def add_flow(name, unit, sizes, run_of, error):
        runs = {n: run_of(n) for n in sizes}
        for n in sizes:
            rows.append((f"{name} n={n}", unit, None, [runs[n]], error))
        for a, b in zip(sizes, sizes[1:]):
            rows.append((f"{name} order n={a}..{b}", "-", None, [runs[a], runs[b]],
                         lambda x, y, r=b / a: math.log(abs(error(x)) / abs(error(y))) / math.log(r)))

    for flow in ("poiseuille", "couette"):
        add_flow(f"{flow} rms velocity", "% of the speed", (10, 20, 40) if quick else (10, 20, 40, 80),
                 lambda n, f=flow: Run("channel", n=n, flow=f, frames=4),
                 lambda r: 100 * r.col("velocity_error_rms")[-1])
    add_flow("Taylor-Green Re 100 kinetic energy", "% of exact at the end", (25, 50) if quick else (25, 50, 100),
             lambda n: Run("taylor_green", n=n, re=100),
             lambda r: 100 * (r.col("kinetic_J")[-1] / r.col("kinetic_exact")[-1] - 1))
    add_flow("standing wave period", "% off linear theory", (10, 20) if quick else (10, 20, 40),
             lambda n: Run("standing_wave", n=n), standing_period)
    sizes, e = (10, 20, 40, 80, 160), bars()
    for form in ("updated", "corrected", "total"):
        for n in sizes:
            rows.append((f"bar {form} frequency n={n}", "% off c/2L", None, [], lambda f=form, n=n: 100 * e[f, n]))
        for a, b in zip(sizes, sizes[1:]):
            target = (">=", 1.9) if b == 160 and form != "updated" else None
            rows.append((f"bar {form} order n={a}..{b}", "-", target, [],
                         lambda f=form, a=a, b=b: math.log2(abs(e[f, a] / e[f, b]))))
    return rows


if __name__ == "__main__":
    sys.exit(main(cases, "orders", __doc__))
