#!/usr/bin/env python3
# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""validate_edges.py: runs Powell's cases (2012) and holds them against finite elements and exact solutions.

usage: validate_edges.py [--quick] [--jobs N] [--only WORD] [--keep] [--tool build/sph]
Writes build/validate_edges.csv and prints the same as a table; validation.py says more. Each group of cases is a
function in GROUPS that takes (quick, add), add(name, unit, target, runs, figure). Times are in us, lengths in cm.
"""
import sys

from validation import Run, interpolate, main, read_table

GROUPS = []
FORMS = ("updated", "normalised_corrected", "stabilised", "total")
HOLDS = ("stabilised", "total")


def worst(run, column, table, ref, last, share=True):
    """Largest difference of a column from a reference until `last` us, in percent of the reference's range; a run that
    ended before has none."""
    rows = [(float(r["t_us"]), float(r[ref])) for r in read_table(table)]
    if run.error or run.col("us")[-1] < last:
        raise ValueError(run.error or "ended early")
    range_ = max(y for _, y in rows) - min(y for _, y in rows)
    off = max(abs(interpolate(run.col("us"), run.col(column), t) - y) for t, y in rows if t <= last)
    return 100 * off / (range_ if share else 1)


def two_blocks(quick, add):
    """P8: halves together and apart; P9: the end of a bar."""
    n = 12 if quick else 20
    for kind, table in (("together", "powell_impact_approach.csv"), ("apart", "powell_impact_separation.csv")):
        for form in FORMS:
            run = Run("two_blocks", form=form, kind=kind, n=n, frames=100)
            tag = f"P8 {kind}, {form}, n={n}"
            target = 3.0 if form in HOLDS else None
            add(f"{tag}: displacement 0.1 cm above the middle, off finite elements", "% of its range", target, [run],
                lambda r, t=table: worst(r, "uy_A", t, "uy_NH", 9.9))
            add(f"{tag}: kinetic energy, off finite elements", "% of the start", None, [run],
                lambda r, t=table: worst(r, "kinetic_share", t, "KE_NH", 9.9, False))
            add(f"{tag}: nearest pair", "dx", (">=", 0.6) if form in HOLDS else None, [run],
                lambda r: min(r.col("closest")))
            add(f"{tag}: widest gap", "dx", 2.0 if form in HOLDS else None, [run], lambda r: max(r.col("gap")))
    total = Run("two_blocks", form="total", kind="bar", n=8, us=30, frames=100)
    for form in FORMS[:-1]:
        run = Run("two_blocks", form=form, kind="bar", n=8, us=30, frames=100)
        add(f"P9 bar, {form}: length after 20 us, off the total-Lagrangian form's", "%", None, [run, total],
            lambda a, b: 100 * abs(interpolate(a.col("us"), a.col("length"), 20) /
                                   interpolate(b.col("us"), b.col("length"), 20) - 1))
        add(f"P9 bar, {form}: widest gap", "dx", None, [run], lambda r: max(r.col("gap")))


GROUPS.append(two_blocks)


def clamped_beam(quick, add):
    """P10: displacement of the middle of a beam that is struck."""
    n = 12
    for form in FORMS:
        run = Run("clamped_beam", form=form, n=n, frames=75)
        for column, ref in (("uy_bottom", "uy_bottom_NH_h_005_l_02"), ("uy_top", "uy_top_NH_h_005_l_02")):
            add(f"P10 {form}, n={n}: {column}, off finite elements", "% of its range", 3.0 if form in HOLDS else None,
                [run], lambda r, c=column, f=ref: worst(r, c, "powell_clamped_beam.csv", f, 14.9))


GROUPS.append(clamped_beam)


def cases(quick):
    rows = []
    for group in GROUPS:
        group(quick, lambda name, unit, target, runs, figure: rows.append((name, unit, target, runs, figure)))
    return rows


if __name__ == "__main__":
    sys.exit(main(cases, "validate_edges", __doc__))
