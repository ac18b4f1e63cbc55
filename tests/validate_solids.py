#!/usr/bin/env python3
# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""validate_solids.py: runs the cases of solids and holds them against Gray (2001), finite elements and exact solutions.

usage: validate_solids.py [--quick] [--jobs N] [--only WORD] [--keep] [--tool build/sph]
As validate.py, whose runs and table it shares; writes build/validate_solids.csv. Each group of cases is a function in GROUPS
that takes add(name, unit, target, runs, figure): the figure is called with the finished runs and returns a number; a target is
None, a number that the figure may not exceed, or a pair such as (">=", 3). Long studies: --only WORD --keep goes on where an
earlier call was ended. Times are in cm/c0 and lengths in cm unless a row says otherwise.
"""
import sys

from validate import Run, interpolate, main, read_table, slope


GROUPS = []


def cases(quick):
    rows = []
    for group in GROUPS:
        group(quick, lambda name, unit, target, runs, figure: rows.append((name, unit, target, runs, figure)))
    return rows


if __name__ == "__main__":
    sys.exit(main(cases, "validate_solids", __doc__))
