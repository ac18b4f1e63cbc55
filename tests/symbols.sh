#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# symbols.sh: what the libraries in BUILD ask of the linker beyond themselves: memcpy, memset, memmove, sqrt and nothing
# else.
set -u
BUILD=${BUILD:-build} NM=${NM:-nm} bad=0
for b in ${BUILDS:-1f 1d 2f 2d 3f 3d}; do
    lib=$BUILD/libsph$b.a
    [ -f "$lib" ] || { echo "symbols: no $lib; make it with: make $lib" >&2; exit 1; }
    "$NM" -g "$lib" >"$BUILD/symbols_$b.txt" 2>/dev/null
    own=$(awk -v p="^sph${b}_" 'NF == 3 && $3 ~ p' "$BUILD/symbols_$b.txt" | wc -l)
    [ "$own" -gt 0 ] || { echo "symbols: $lib defines no sph${b}_ function" >&2; exit 1; }
    extra=$(awk 'NF == 2 && $1 == "U" {print $2}' "$BUILD/symbols_$b.txt" | sort -u |
        grep -vE "^(sph${b}_|memcpy$|memset$|memmove$|sqrt$|sqrtf$|_GLOBAL_OFFSET_TABLE_$)")
    [ -z "$extra" ] || { echo "libsph$b.a asks for:" $extra; bad=1; }
done
[ $bad = 0 ] && echo "symbols: memcpy, memset, memmove, sqrt and nothing else"
exit $bad
