#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# install.sh: a fresh copy of the tree is installed under a prefix and used from there, by pkg-config, from C and from
# C++17 (g++ and clang++); all of sph/ compiles as one translation unit in every build and gives the same hash; a BUILD
# with a space is refused. Takes seconds: nothing is optimised. Compilers that are not here are left out and said so;
# STRICT=1: that is a failure.
set -u
CC=${CC:-cc} MAKE=${MAKE:-make} STRICT=${STRICT:-0}
tmp=$(mktemp -d) && [ -n "$tmp" ] || exit 1
trap 'rm -rf "$tmp"' EXIT
tree=$tmp/tree usr="$tmp/usr" bad=0 ran=0
export PKG_CONFIG_PATH="$usr/lib/pkgconfig"
mkdir -p "$tree" && cp -R Makefile LICENSE sph port examples tools tests "$tree" && cd "$tree" || exit 1

wrong() { echo "install: $*" >&2; bad=$((bad + 1)); }
fine() {
    ran=$((ran + 1))
    "$@" >"$tmp/log" 2>&1 || { wrong "$*"; sed 's/^/  /' "$tmp/log" | head -20 >&2; return 1; }
}
here() { command -v "$1" >/dev/null 2>&1 || { echo "install: no $1: left out"; bad=$((bad + STRICT)); return 1; }; }
# flags of a build: by pkg-config, or read from its file
flags() {
    if command -v pkg-config >/dev/null 2>&1; then
        pkg-config "--$2" "sph$1"
    else
        sed -n "s|\${prefix}|$usr|g; s|\${includedir}|$usr/include|g; s|\${libdir}|$usr/lib|g; s/^$3: //p" \
            "$usr/lib/pkgconfig/sph$1.pc"
    fi
}

fine $MAKE -s -j2 install PREFIX="$usr" BUILD="$tmp/build" INSTALL_BUILDS="2f 3d" INSTALL_TOOL= OPT=-O0 CC="$CC" ||
    exit 1
cp examples/cpp/tank.cpp "$tmp/tank.cpp"
cd "$tmp" || exit 1
rm -rf "$tmp/build"

# the same program in C++ by each compiler and in C (it is C++ but for a few words), of each build: one hash
use() { # label, command of the compiler
    for b in 2f 3d; do
        # shellcheck disable=SC2046,SC2086
        fine $2 -Wall -Wextra -Werror $(flags $b cflags Cflags) "$tmp/tank.cpp" $(flags $b libs Libs) -o "$tmp/tank" &&
            "$tmp/tank" >"$tmp/said.$b.$1" || wrong "$1 $b does not run"
        grep -q 'hash [0-9a-f]\{16\}$' "$tmp/said.$b.$1" || wrong "$1 $b says: $(cat "$tmp/said.$b.$1")"
        echo "  $1 $b: $(cat "$tmp/said.$b.$1")"
    done
}
here g++ && use g++ "g++ -std=c++17"
here clang++ && use clang++ "clang++ -std=c++17"
for b in 2f 3d; do
    [ "$(cat "$tmp"/said.$b.* 2>/dev/null | sort -u | wc -l)" -le 1 ] ||
        wrong "hashes of $b differ: $(cat "$tmp"/said.$b.*)"
done

# a C program without -fno-math-errno: the library of the .pc is enough
printf '%s\n' '#include <sph/sph.h>' 'int main(void)' \
    '{ sph_config c = sph_config_default(); return sph_arena_bytes(&c) != 0; }' >"$tmp/small.c"
# shellcheck disable=SC2046
fine $CC -std=c11 $(flags 2f cflags Cflags) "$tmp/small.c" $(flags 2f libs Libs) -o "$tmp/small" && fine "$tmp/small"

# one translation unit: no two files use a name twice
for f in "$tree"/sph/*.c; do echo "#include \"$f\""; done >"$tmp/one.c"
for compiler in gcc clang; do
    here $compiler || continue
    for dim in 1 2 3; do
        for double in 0 1; do
            fine $compiler -std=c11 -ffp-contract=off -Wall -Wextra -Wno-unused-function -Werror -fsyntax-only \
                -DSPH_DIM=$dim -DSPH_DOUBLE=$double "$tmp/one.c"
        done
    done
done
if here g++; then
    fine $CC -std=c11 -O0 -ffp-contract=off -fno-math-errno -DSPH_DIM=2 -c "$tmp/one.c" -o "$tmp/one.o" &&
        fine g++ -std=c++17 -I"$usr/include" -DSPH_DIM=2 "$tmp/tank.cpp" "$tmp/one.o" -lm -o "$tmp/one" &&
        "$tmp/one" | cmp -s - "$tmp/said.2f.g++" || wrong "sph/ as one translation unit gives another hash"
fi

ran=$((ran + 1))
$MAKE -C "$tree" -n BUILD="$tmp/a b" all >"$tmp/log" 2>&1 && wrong "a BUILD with a space is not refused"
grep -q "BUILD is '.* b'" "$tmp/log" || wrong "a BUILD with a space: $(head -1 "$tmp/log")"

echo "install: $ran checks, $bad wrong"
[ $bad = 0 ] && [ $ran -gt 10 ]
