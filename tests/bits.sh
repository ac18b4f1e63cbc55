#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# bits.sh: builds the golden runner many ways and compares every hash with the committed tests/golden.csv.
#   sh tests/bits.sh                    every level and vector width of this machine by each of COMPILERS (gcc and clang unless
#                                       said otherwise), which must be there
#   sh tests/bits.sh --quick            the default compiler, with and without vector lanes
#   sh tests/bits.sh --mint "reason"    rewrites tests/golden.csv, with the reason in its header; all ways must agree first
set -u
BUILD=${BUILD:-build} GCC=${GCC:-gcc} CLANG=${CLANG:-clang} CC=${CC:-cc} MAKE=${MAKE:-make}
JOBS=${JOBS:-$(nproc 2>/dev/null || echo 2)} COMPILERS=${COMPILERS:-gcc clang}
golden=tests/golden.csv dir=$BUILD/bits
mode=${1:-all} reason=${2:-}
mkdir -p "$dir"
if [ "$mode" = --mint ] && [ -z "$reason" ]; then
    echo "bits.sh: --mint needs a reason, in quotes: it goes into the header of $golden" >&2
    exit 2
fi

has() { grep -qw "$1" /proc/cpuinfo 2>/dev/null; }

# name | compiler | level | more flags
ways() {
    if [ "$mode" = --quick ]; then
        echo "default|$CC|-O2|"
        echo "default-scalar|$CC|-O2|-DSPH_VECTOR_BYTES=0"
        return
    fi
    for c in $COMPILERS; do
        [ "$c" = gcc ] && cc=$GCC || cc=$CLANG
        for o in -O0 -O1 -O2 -O3; do echo "$c$o|$cc|$o|"; done
        echo "$c-O3-native|$cc|-O3|-march=native"
        echo "$c-O2-scalar|$cc|-O2|-DSPH_VECTOR_BYTES=0"
        has avx2 && echo "$c-O2-32|$cc|-O2|-mavx2 -DSPH_VECTOR_BYTES=32"
        echo "$c-O2-no-fast-paths|$cc|-O2|-DSPH_WITH_FAST_PATHS=0"
    done
    case " $COMPILERS " in *" gcc "*) echo "gcc-O2-lto|$GCC|-O2|-flto" ;; esac
}

# one way: build, run; the hashes land in $dir/NAME.csv
one() {
    IFS='|' read -r name cc level more <<END
$1
END
    ar=ar
    case $more in *-flto*) ar=gcc-ar ;; esac
    if ! $MAKE --no-print-directory -s golden BUILD="$dir/$name" CC="$cc" OPT="$level" CFLAGS="$more" AR=$ar \
        >"$dir/$name.log" 2>&1; then
        echo "$name: does not build, see $dir/$name.log"
        return 1
    fi
    ${EXEC:-} "$dir/$name/golden" >"$dir/$name.csv" || { echo "$name: a case failed: $(grep -m1 failed "$dir/$name.csv")"; return 1; }
}

# compares $dir/NAME.csv with the rows of $2
compare() {
    sed '/^#/d' "$2" | diff - "$dir/$1.csv" >"$dir/$1.diff" && return 0
    echo "$1: $(grep -c '^>' "$dir/$1.diff") of $(wc -l <"$dir/$1.csv") hashes differ, first: $(grep -m1 '^>' "$dir/$1.diff" | cut -c3-)"
    return 1
}

for c in $COMPILERS; do
    case $c in gcc) cc=$GCC ;; clang) cc=$CLANG ;; *) echo "bits.sh: COMPILERS has '$c'; allowed are gcc, clang" >&2; exit 2 ;; esac
    [ "$mode" = --quick ] || command -v "$cc" >/dev/null 2>&1 ||
        { echo "bits.sh: no $cc; as root: apt-get install $c; or leave it out by name: COMPILERS=..." >&2; exit 1; }
done
list=$(ways) bad=0 n=0 first=
if [ "$mode" != --mint ] && [ ! -f $golden ]; then
    echo "bits.sh: no $golden; make it with: sh tests/bits.sh --mint \"reason\"" >&2
    exit 1
fi
# as many ways at once as there are jobs; what went wrong with one is in $dir/NAME.said
oldifs=$IFS IFS='
'
for w in $list; do
    IFS=$oldifs
    rm -f "$dir/${w%%|*}.csv"
    n=$((n + 1))
    { one "$w" >"$dir/${w%%|*}.said"; rm -rf "${dir:?}/${w%%|*}"; } &
    [ $((n % JOBS)) -eq 0 ] && wait
done
wait
IFS='
'
for w in $list; do
    IFS=$oldifs
    name=${w%%|*}
    if [ -s "$dir/$name.said" ]; then
        cat "$dir/$name.said"
        bad=$((bad + 1))
        continue
    fi
    first=${first:-$name}
    against=$golden
    [ "$mode" = --mint ] && against=$dir/$first.csv
    compare "$name" "$against" || bad=$((bad + 1))
done
IFS=$oldifs
cases=$(wc -l <"$dir/$first.csv" 2>/dev/null || echo 0)
if [ "$mode" = --mint ] && [ $bad -eq 0 ]; then
    {
        echo "# SPDX-License-Identifier: MIT. Copyright the sph authors."
        echo "# Golden state hashes: build, case of tests/cases.h, hash. Written by tests/bits.sh --mint; agreed by $n ways to compile."
        echo "# Reason of the latest change: $reason"
        cat "$dir/$first.csv"
    } >$golden.tmp && mv $golden.tmp $golden
    echo "bits: wrote $golden"
fi
[ "$cases" -gt 0 ] || { echo "bits: no case ran" >&2; bad=$((bad + (bad == 0))); }
echo "bits: $cases cases, $n ways to compile, $bad of them differ"
[ $bad -eq 0 ] && [ $n -gt 0 ]
