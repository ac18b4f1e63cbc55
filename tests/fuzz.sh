#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# fuzz.sh: fuzzes the targets of tests/fuzz, replays or renews their committed corpus. Called by the Makefile.
#   run     fuzzes each of TARGETS for SECONDS_EACH seconds, two at a time; writes BUILD/fuzz.csv; needs clang with
#           libFuzzer
#   replay  gives the committed corpus to each target, by clang with sanitizers; with PLAIN=1 by CC without
#   keep    shrinks what `run` found and the committed corpus into tests/fuzz/corpus; TARGET.past there holds inputs
#           that once were findings: add one with build/fuzz/replay_TARGET --pack FILE >>tests/fuzz/corpus/TARGET.past
set -u
BUILD=${BUILD:-build} CLANG=${CLANG:-clang} CC=${CC:-cc} MAKE=${MAKE:-make}
TARGETS=${TARGETS:-config particles walls dumps} SECONDS_EACH=${SECONDS_EACH:-60}
dir=$BUILD/fuzz again=$BUILD/replay corpus=tests/fuzz/corpus
# one text of the loop over pairs, as builds for size have: the rest is the same, and compiles in a third of the time
sanitize="-fsanitize=address,undefined -fno-sanitize-recover=all -DSPH_VALIDATES=1 -DSPH_SMALL=1"
longest=600 # bytes of an input
export ASAN_OPTIONS=detect_leaks=0 # the kernel allocates nothing, and containers often forbid what the leak finder does

case $SECONDS_EACH in
'' | *[!0-9]* | 0)
    echo "fuzz.sh: FUZZ_SECONDS is '$SECONDS_EACH'; it must be a whole number of seconds, 1 or more" >&2
    exit 2
    ;;
esac
for t in $TARGETS; do
    case $t in
    config | particles | walls | dumps) ;;
    *) echo "fuzz.sh: TARGETS has '$t'; allowed are config, particles, walls, dumps" >&2; exit 2 ;;
    esac
done

can_fuzz() {
    printf 'int LLVMFuzzerTestOneInput(const unsigned char *d, unsigned long n){return d && n ? 0 : 0;}\n' |
        "$CLANG" -fsanitize=fuzzer,address,undefined -x c - -o "$dir/probe" 2>/dev/null
}
can_sanitize() {
    printf 'int main(void){return 0;}\n' | "$CLANG" -fsanitize=address,undefined -x c - -o "$dir/probe" 2>/dev/null
}

# programs ($1) in folder $2 by compiler $3 with flags $4 for objects and $5 for the link
compile() {
    $MAKE --no-print-directory -s "$1-programs" BUILD="$2" CC="$3" WARN= OPT="-O1 -g" CFLAGS="$4" LDFLAGS="$5" \
        FUZZ_TARGETS="$TARGETS"
}

fuzz_programs() {
    can_fuzz || {
        echo "fuzz.sh: no $CLANG with libFuzzer and sanitizers; as root: apt-get install clang libclang-rt-14-dev" >&2
        exit 2
    }
    compile fuzz "$dir" "$CLANG" "-fsanitize=fuzzer-no-link $sanitize" "$sanitize" || exit 1
    compile replay "$dir" "$CLANG" "-fsanitize=fuzzer-no-link $sanitize" "$sanitize" || exit 1
}

unpack() { # target: the committed corpus as files
    mkdir -p "$dir/corpus/$1"
    [ -f "$corpus/$1.pack" ] && "$dir/replay_$1" --unpack "$corpus/$1.pack" "$dir/corpus/$1" >/dev/null
    return 0
}

fuzz_one() {
    mkdir -p "$dir/found/$1"
    "$dir/fuzz_$1" -max_total_time="$SECONDS_EACH" -max_len=$longest -timeout=20 -print_final_stats=1 \
        -artifact_prefix="$dir/found/$1/" "$dir/corpus/$1" >"$dir/$1.log" 2>&1
}

row() { echo "$1,$2,$3,$4,$5" >>"$BUILD/fuzz.csv"; }
report() { # target, exit status
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$dir/$1.log")
    seconds=$(sed -n 's/^Done [0-9]* runs in \([0-9]*\) second.*/\1/p' "$dir/$1.log")
    row "$1 seconds" "${seconds:-0}" s "" ""
    row "$1 executions" "${runs:-0}" inputs "" ""
    row "$1 corpus" "$(find "$dir/corpus/$1" -type f | wc -l)" inputs "" ""
    row "$1 coverage" "$(sed -n 's/.*cov: \([0-9]*\) .*/\1/p' "$dir/$1.log" | tail -n 1)" edges "" ""
    row "$1 findings" "$2" inputs 0 "$([ "$2" = 0 ] && echo yes || echo no)"
    [ "$2" = 0 ] || grep -m 3 -E 'runtime error|does not hold|ERROR|SUMMARY|Test unit written' "$dir/$1.log" |
        sed 's/^/      /'
}

run() {
    fuzz_programs
    echo "name,value,unit,target,ok" >"$BUILD/fuzz.csv"
    # shellcheck disable=SC2086
    set -- $TARGETS
    while [ $# -gt 0 ]; do
        first=$1 second=${2:-}
        echo "  fuzzing $first${second:+ and $second} for $SECONDS_EACH s"
        unpack "$first"
        fuzz_one "$first" &
        one=$!
        bad=0
        if [ -n "$second" ]; then
            unpack "$second"
            fuzz_one "$second" || bad=1
        fi
        other=0
        wait $one || other=1
        report "$first" $other
        [ -z "$second" ] || report "$second" $bad
        shift
        [ $# -eq 0 ] || shift
    done
    sh tests/table.sh "$BUILD/fuzz.csv"
}

replay() {
    bad=0
    for t in $TARGETS; do
        [ -s "$corpus/$t.pack" ] ||
            { echo "fuzz.sh: $corpus/$t.pack holds no input; make fuzz, sh tests/fuzz.sh keep make one" >&2; exit 2; }
    done
    if [ "${PLAIN:-0}" = 0 ]; then
        can_sanitize || {
            echo "fuzz.sh: no $CLANG with sanitizers; as root: apt-get install clang libclang-rt-14-dev" >&2
            exit 2
        }
        how="$CLANG, sanitizers"
        again=$again/sanitized
        compile replay "$again" "$CLANG" "$sanitize" "$sanitize" || exit 1
    else
        how="$CC, no sanitizers"
        again=$again/plain
        compile replay "$again" "$CC" "" "" || exit 1
    fi
    for t in $TARGETS; do
        for p in "$corpus/$t.pack" "$corpus/$t.past"; do
            [ -f "$p" ] || continue
            if said=$("$again/replay_$t" "$p" 2>"$again/$t.err"); then
                printf '  %-40s %s\n' "$p" "$said"
            else
                bad=1
                echo "  $p: FAILED"
                grep -E -A 12 'runtime error|does not hold|ERROR' "$again/$t.err" | head -20
            fi
        done
    done
    [ $bad = 0 ] && echo "fuzz-replay: the corpus of $(echo "$TARGETS" | wc -w) targets holds ($how)"
    return $bad
}

keep() {
    fuzz_programs
    mkdir -p "$corpus"
    for t in $TARGETS; do
        unpack "$t"
        rm -rf "$dir/least" && mkdir -p "$dir/least"
        # without counters: an input is kept for an edge of its own, not for how often it takes one
        "$dir/fuzz_$t" -merge=1 -use_counters=0 -max_len=$longest "$dir/least" "$dir/corpus/$t" \
            >"$dir/$t.merge.log" 2>&1 || exit 1
        "$dir/replay_$t" --pack "$dir"/least/* >"$corpus/$t.pack" || exit 1
        echo "  $t: $(find "$dir/least" -type f | wc -l) inputs, $(wc -c <"$corpus/$t.pack") bytes"
    done
}

mkdir -p "$dir" "$again"
case ${1:-} in
run) run ;;
replay) replay ;;
keep) keep ;;
*) echo "fuzz.sh: '${1:-}'; allowed are run, replay, keep" >&2; exit 2 ;;
esac
