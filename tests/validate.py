#!/usr/bin/env python3
# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""validate.py: runs every case, of water and of solids, and holds them against experiments, finite elements, exact
solutions.

usage: validate.py [--quick] [--jobs N] [--only WORD] [--keep] [--tool build/sph]
Writes build/validate.csv (name,value,unit,target,ok) and prints the same as a table. Exit code 1 if a row with a target
misses it.
"""
import sys

import validate_edges, validate_solids, validate_water, validate_waves
from validation import main

if __name__ == "__main__":
    parts = (validate_water, validate_waves, validate_solids, validate_edges)
    sys.exit(main(lambda quick: [row for part in parts for row in part.cases(quick)], "validate", __doc__))
