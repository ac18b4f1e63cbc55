#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# bits.sh: builds the golden runner many ways and compares every hash with the committed tests/golden.csv.
#   sh tests/bits.sh                    every level and vector width of this machine by each of COMPILERS (gcc and clang
#                                       unless said otherwise), which must be there
#   sh tests/bits.sh --quick            the default compiler, with and without vector lanes; the first in BUILD itself
#   sh tests/bits.sh --mint "reason"    rewrites tests/golden.csv, the reason in its header; all ways must agree first
#   BUILDS="1f 2f"   these builds only      SHARE=3   each way two of the six, the next way the next two (for CI)
#   READY="gcc-O2=build"   ways that are built already, and where      KEEP=1   what was built stays
set -u
BUILD=${BUILD:-build} GCC=${GCC:-gcc} CLANG=${CLANG:-clang} CC=${CC:-cc} MAKE=${MAKE:-make}
JOBS=${JOBS:-$(nproc 2>/dev/null || echo 2)} COMPILERS=${COMPILERS:-gcc clang}
golden=tests/golden.csv dir=$BUILD/bits all="1f 1d 2f 2d 3f 3d"
mode=${1:-all} reason=${2:-}
. tests/shares.sh
mkdir -p "$dir"
if [ "$mode" = --mint ] && [ -z "$reason" ]; then
    echo "bits.sh: --mint needs a reason, in quotes: it goes into the header of $golden" >&2
    exit 2
fi

has() { grep -qw "$1" /proc/cpuinfo 2>/dev/null; }

# name | compiler | level | more flags
ways() {
    if [ "$mode" = --quick ]; then
        echo "default|$CC||"
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

# where a way is built: its folder, or where READY says that it is there already
place_of() {
    [ "$1" != default ] || { echo "$BUILD"; return; }
    for r in ${READY:-}; do [ "${r%%=*}" != "$1" ] || { echo "${r#*=}"; return; }; done
    echo "$dir/$1"
}

# one way: build, run; the hashes land in $dir/NAME.csv
one() {
    IFS='|' read -r name cc level more builds <<END
$1
END
    ar=ar place=$(place_of "$name") programs=
    case $more in *-flto*) ar=gcc-ar ;; esac
    for b in $builds; do programs="$programs $place/golden_$b"; done
    # the default is whatever this BUILD is made with
    if [ "$name" = default ]; then set -- CC="$cc"; else set -- CC="$cc" OPT="$level" CFLAGS="$more" AR=$ar; fi
    # shellcheck disable=SC2086
    if ! $MAKE --no-print-directory -s BUILD="$place" "$@" $programs >"$dir/$name.log" 2>&1; then
        echo "$name: does not build, see $dir/$name.log"
        return 1
    fi
    for p in $programs; do
        ${EXEC:-} "$p" >>"$dir/$name.csv" ||
            { echo "$name: a case failed: $(grep -m1 failed "$dir/$name.csv")"; return 1; }
    done
}

# the builds of way number $1, called $2
builds_of_way() {
    if [ "$(place_of "$2")" = "$dir/$2" ]; then share_of "$1" ${BUILDS:-$all}; else echo "${BUILDS:-$all}"; fi
}

# compares $dir/NAME.csv with the rows of $2 of its builds
compare() {
    sed '/^#/d' "$2" | grep -E "^($(echo "$3" | tr ' ' '|'))," | diff - "$dir/$1.csv" >"$dir/$1.diff" && return 0
    at=$(grep -m1 '^>' "$dir/$1.diff" | cut -c3-)
    echo "$1: $(grep -c '^>' "$dir/$1.diff") of $(wc -l <"$dir/$1.csv") hashes differ, first: $at"
    return 1
}

for c in $COMPILERS; do
    case $c in
    gcc) cc=$GCC ;;
    clang) cc=$CLANG ;;
    *) echo "bits.sh: COMPILERS has '$c'; allowed are gcc, clang" >&2; exit 2 ;;
    esac
    [ "$mode" = --quick ] || command -v "$cc" >/dev/null 2>&1 ||
        { echo "bits.sh: no $cc; as root: apt-get install $c; or leave it out by name: COMPILERS=..." >&2; exit 1; }
done
if [ "$mode" = --mint ]; then BUILDS=$all SHARE=1; fi
for b in ${BUILDS:-$all}; do
    case " $all " in *" $b "*) ;; *) echo "bits.sh: BUILDS has '$b'; allowed are $all" >&2; exit 2 ;; esac
done
# counted from another number for each compiler, so that two compile different halves at the same level
list=$(ways | {
    k=0 from=0 last=
    while read -r w; do
        [ "${w%%-*}" = "$last" ] || from=$((from + 1)) k=$from last=${w%%-*}
        k=$((k + 1))
        echo "$w|$(builds_of_way $k "${w%%|*}")"
    done
})
bad=0 n=0 first=
if [ "$mode" != --mint ] && [ ! -f $golden ]; then
    echo "bits.sh: no $golden; make it with: sh tests/bits.sh --mint \"reason\"" >&2
    exit 1
fi
# as many ways at once as there are jobs; what went wrong with one is in $dir/NAME.said
rm -f "$dir/ran" && touch "$dir/ran"
oldifs=$IFS IFS='
'
for w in $list; do
    IFS=$oldifs
    rm -f "$dir/${w%%|*}.csv"
    n=$((n + 1))
    { one "$w" >"$dir/${w%%|*}.said"; [ "${KEEP:-0}" = 1 ] || rm -rf "${dir:?}/${w%%|*}"; } &
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
    cut -d, -f1,2 "$dir/$name.csv" >>"$dir/ran"
    against=$golden
    [ "$mode" = --mint ] && against=$dir/$first.csv
    compare "$name" "$against" "${w##*|}" || bad=$((bad + 1))
done
IFS=$oldifs
cases=$(sort -u "$dir/ran" | wc -l)
if [ "$mode" = --mint ] && [ $bad -eq 0 ]; then
    {
        echo "# SPDX-License-Identifier: MIT. Copyright the sph authors."
        echo "# Golden state hashes: build, case of tests/cases.h, hash. Written by tests/bits.sh --mint;" \
            "agreed by $n ways to compile."
        echo "# Reason of the latest change: $reason"
        cat "$dir/$first.csv"
    } >$golden.tmp && mv $golden.tmp $golden
    echo "bits: wrote $golden"
fi
[ "$cases" -gt 0 ] || { echo "bits: no case ran" >&2; bad=$((bad + (bad == 0))); }
echo "bits: $cases cases, $n ways to compile, $bad of them differ"
[ $bad -eq 0 ] && [ $n -gt 0 ]
