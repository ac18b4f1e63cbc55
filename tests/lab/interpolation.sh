#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# interpolation.sh BUILD: the table of W1 and P1 (tests/lab/interpolation.c) from the programs BUILD/interpolation_1d
# and _2d.
set -e
cat <<END
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# study: interpolation
# title: sums over particles against exact values (W1: Wickramarachchi 2009, figure 2.4; P1: Powell 2012, \
figures 1.2, 1.3)
# figures: what they are stands at the head of tests/lab/interpolation.c
# command: make lab
case,kernel,h,figure,value
END
"$1/interpolation_2d"
"$1/interpolation_1d"
