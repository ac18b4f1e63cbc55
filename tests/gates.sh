#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# gates.sh: does every gate see what it guards against? In a copy of the tree each gate is run, then what it guards is
# broken and it is run again: it must fail and name the trouble, which it did not name before. None may stay silent, and
# a break that finds nothing to break is a failure too. Writes BUILD/gates.csv.
#   sh tests/gates.sh                every gate        sh tests/gates.sh --quick   those that take seconds
#   sh tests/gates.sh NAME...        these only        KEEP=1   the copy's objects of an earlier run are used again
set -u
BUILD=${BUILD:-build} MAKE=${MAKE:-make} PYTHON=${PYTHON:-python3} LIMIT=${LIMIT:-900}
work=$BUILD/gates tree=$BUILD/gates/tree whole=$BUILD/gates/whole out=$BUILD/gates.csv home=$(pwd)
strict="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror"
quick=0
[ "${1:-}" = --quick ] && { quick=1; shift; }
chosen=$*

# ---- the copy ----

files() {
    if [ -e .git ]; then
        git ls-files -co --exclude-standard
    else
        find . -name "${BUILD%%/*}" -prune -o -type f -print | sed 's|^\./||'
    fi | while read -r f; do [ ! -f "$f" ] || echo "$f"; done
}
[ "${KEEP:-0}" = 1 ] || rm -rf "$work"
mkdir -p "$work"
rm -rf "$whole" && mkdir -p "$whole" "$tree"
files >"$work/list"
[ -s "$work/list" ] || { echo "gates.sh: no file to copy; run it where the Makefile is" >&2; exit 1; }
tar -cf - -T "$work/list" | tar -xf - -C "$whole"
# what is in the copy already and the same keeps its time, so that its objects stay
(cd "$whole" && find . -type f) | while read -r f; do
    cmp -s "$whole/$f" "$tree/$f" || { mkdir -p "$tree/$(dirname "$f")" && cp "$whole/$f" "$tree/$f"; }
done
[ "${KEEP:-0}" = 0 ] || (cd "$tree" && find . -name build -prune -o -type f -print) | while read -r f; do
    [ -f "$whole/$f" ] || rm -f "$tree/$f"
done
whole=$home/$whole touched=$home/$work/touched
: >"$touched"

# ---- ways to break: run in the copy; each says so if it finds nothing to break ----

lost() { echo "nothing to break: $1"; return 1; }
# files... | the first with the pattern
place() {
    pattern=$1
    shift
    grep -lE -- "$pattern" "$@" 2>/dev/null | head -n 1
}
# pattern, script of sed, files...: edits the first file with the pattern
edit() {
    pattern=$1 script=$2
    shift 2
    at=$(place "$pattern" "$@")
    [ -n "$at" ] || { lost "no '$pattern' in $*" | cut -c1-200; return 1; }
    echo "$at" >>"$touched"
    sed -i "$script" "$at"
    ! cmp -s "$at" "$whole/$at" || { lost "'$script' changes nothing in $at"; return 1; }
}
# file, lines: puts them behind the last line
add() {
    [ -f "$1" ] || { lost "no file '$1'"; return 1; }
    at=$1
    echo "$at" >>"$touched"
    shift
    printf '%s\n' "$@" >>"$at"
}
# a function of the kernel: head, body; behind the includes of $3, if it is given
function_of() { add "$(any_source)" "${3:-}" "$1;" "$1" "$2"; }
# a source of the kernel, for what may stand in any
any_source() { place 'include "internal.h"' sph/*.c; }
of_floor() { awk -v f="$1" '$2 == f && !/^#/ {print "sph/" $1; exit}' tests/floors.txt; }
nameless() { awk '!/^#/ && $3 == "nameless" {print "sph/" $1; exit}' tests/floors.txt; }
study() { grep -l '^# study: hydrostatic' tests/lab/*.csv; }

hash_changed() { edit '^1f,base,' '/^1f,base,/s/,[0-9a-f]*$/,0000000000000001/' tests/golden.csv; }
coefficient() {
    edit 'p->mg = .*k_slope\(' 's/p->mg = /p->mg = (sph_real)(1 + 1e-7) * /' sph/*.[ch]
}
heap() { function_of 'void *SPH_NAME(gates_)(void)' '{ return malloc(8); }' '#include <stdlib.h>'; }
prints() { function_of 'void SPH_NAME(gates_)(void)' '{ printf("%d", 1); }' '#include <stdio.h>'; }
writable() { add "$(any_source)" 'extern int SPH_NAME(gates_);' 'int SPH_NAME(gates_) = 1;'; }
deep_stack() {
    function_of 'int SPH_NAME(gates_deep)(int k)' '{ volatile char a[4096]; a[k] = 1; return a[0]; }'
}
unused() { function_of 'int SPH_NAME(gates_)(int unused)' '{ return 0; }'; }
knob_broken() { add "$(any_source)" '#if !SPH_WITH_XSPH' '#error gates' '#endif'; }
knob_traps() {
    add "$(any_source)" '#if !SPH_WITH_XSPH' \
        '__attribute__((constructor)) static void gates_trap(void) { __builtin_trap(); }' '#endif'
}
wrong_test() { edit 'simpson\(k, false\), 1,' 's/simpson(k, false), 1,/simpson(k, false), 2,/' tests/test_*.c; }
upwards() {
    head='sph_status SPH_NAME(gates_)(sph_sim *s)'
    add "$(of_floor base)" '#include "sph.h"' "$head;" "$head { return sph_step(s); }"
}
no_floor() { echo 'typedef int gates_new;' >sph/gates_new.c && echo sph/gates_new.c >>"$touched"; }
wide_line() { add "$(any_source)" "/* $(printf '%0115d' 0) */"; }
long_function() {
    add "$(any_source)" 'static inline int gates_long(int k)' '{' "$(yes '    k++;' | head -n 57)" '    return k;' '}'
}
if_inside() {
    add "$(any_source)" 'static inline int gates_if(void)' '{' '#if SPH_DIM == 2' '    return 1;' '#endif' \
        '    return 0;' '}'
}
module_word() { add "$(nameless)" '/* viscosity */'; }
other_example() { edit '0\.005' 's/0\.005/0.006/' examples/embed.c; }
other_figure() { edit 'bytes \| 25,600' 's/ bytes \| 25,600/ bytes | 25,601/' README.md; }
no_block() { edit '^```c$' 's/^```c$/```/' README.md; }
no_row() { edit '^#endif' '$s/^#endif.*/#define sph_gates_new SPH_NAME(gates_new)\n&/' sph/sph.h; }
tool_blind() { edit 'return fail\(o, reason\);' 's/return fail(o, reason);/return true;/' tools/output.c; }
lab_row() { edit '^method,' '0,/^method,/s/\(^method,.*,float,25,,\)[0-9.]*/\19.99/' "$(study)"; }
machine_out() { edit '^s390x ' '/^s390x /d' port/targets.txt; }
machine_broken() { edit '^x86_64-gcc ' '/^x86_64-gcc /s/| gcc | -O2/| no-such-gcc | -O2/' port/targets.txt; }
# what a byte of each piece of a dump is changed by
dump_with() { edit 's->sink\(s->ctx, s->piece, n\)' "s/s->sink(s->ctx, s->piece, n)/(s->piece[0] ^= $1, &)/" sph/*.c; }
dump_byte() { dump_with 1; }
dump_byte_there() { dump_with 'sizeof(void *) == 4'; }
probe_off() { edit SPH_NO_PROBE '1s/^/#define SPH_NO_PROBE 1\n/' sph/*.c; }
corpus_empty() { edit . 'd' tests/fuzz/corpus/config.pack; }
dearer() { edit '^bench_2d_f32,' 's/^bench_2d_f32,[0-9.]*/bench_2d_f32,1000/' tests/results/count_base.csv; }
over_the_end() {
    add "$(place 'sph_status sph_kernel_value\(' sph/*.c)" \
        '__attribute__((constructor)) static void gates_over(void) { volatile int i = 4, a[4] = {0}; a[i] = a[0]; }'
}
race() {
    edit 'wait_for_job\(w->pool, work\(' 's/work(w->pool, w->thread)/(w->pool->gates++, &)/' port/posix.c &&
        sed -i 's/^struct port_posix {/&\n    int gates;/' port/posix.h && echo port/posix.h >>"$touched"
}
size_row() { edit '^code_m4f_1f,' '/^code_m4f_1f,/s/,[0-9]*,/,1000,/' tests/results/size.csv; }
page_hash() { edit '^[0-9a-f]' '$s/[0-9a-f]$/x/' tests/golden_tank.txt; }

# ---- running ----

bad=0 n=0
mkdir -p "$work/log"
echo "name,value,unit,target,ok" >"$out.tmp"

# puts the copy back as it was
mend() {
    while read -r f; do
        if [ -f "$whole/$f" ]; then cp "$whole/$f" "$tree/$f"; else rm -f "${tree:?}/$f"; fi
    done <"$touched"
    : >"$touched"
}
# command: runs it in the copy, with a BUILD of its own
go() { (cd "$tree" && BUILD=build READY='' SHARE=1 timeout "$LIMIT" sh -c "$1" 2>&1); }

wanted() { # kind name
    [ -z "$chosen" ] || { case " $chosen " in *" $2 "*) return 0 ;; *) return 1 ;; esac; }
    [ $quick = 0 ] || [ "$1" = quick ]
}

# kind, name, what must be said (an expression), what breaks (function of above, or -), command, command that is broken
# itself (empty: the same). A command of - before the break: the unbroken one takes too long.
gate() {
    wanted "$1" "$2" || return 0
    n=$((n + 1)) said= start=$(date +%s)
    sound=$work/log/$(echo "$5" | cksum | tr ' ' _).sound broken=$work/log/$2.txt
    if [ "$5" != - ] && [ ! -f "$sound" ]; then
        go "$5" >"$sound"
        echo "exit $?" >>"$sound"
    fi
    if [ "$5" != - ]; then
        ! grep -qE -- "$3" "$sound" || said="says so before anything is broken"
        [ "$(tail -n 1 "$sound")" = "exit 0" ] ||
            said="fails before anything is broken: $(tail -n 2 "$sound" | head -n 1 | cut -c1-100)"
    fi
    if [ "$4" = - ] || (cd "$tree" && $4) >"$broken"; then
        go "${6:-$5}" >"$broken"
        rc=$?
        if [ -n "$said" ]; then
            :
        elif [ $rc -eq 124 ]; then
            said="ran longer than $LIMIT s"
        elif [ $rc -eq 0 ]; then
            said="stays silent"
        elif ! grep -qE -- "$3" "$broken"; then
            said="fails, but does not say '$3': $(tail -n 1 "$broken" | cut -c1-100)"
        fi
    else
        said=$(tail -n 1 "$broken")
    fi
    mend
    ok=yes
    [ -z "$said" ] || { ok=no bad=$((bad + 1)); }
    said=${said:-$(grep -m1 -E -- "$3" "$broken" | sed 's/^ *//' | cut -c1-90)}
    printf '  %-22s %-4s %4d s  %s\n' "$2" $ok $(($(date +%s) - start)) "$said"
    echo "$2,$([ $ok = yes ] && echo seen || echo missed),break,seen,$ok" >>"$out.tmp"
}

m="$MAKE --no-print-directory -s"
one="$m build/libsph1f.a CC=gcc"
test_of() { echo "$m build/tests/$1 && sh tests/run.sh build build/tests/$1"; }
house="$m house PYTHON=$PYTHON"

gate quick bits_hash '1f,base,' hash_changed "BUILDS=1f sh tests/bits.sh --quick"
gate quick bits_coefficient '[0-9]+ of [0-9]+ hashes differ' coefficient "BUILDS=1f sh tests/bits.sh --quick"
gate quick bits_compiler 'no no-such-clang' - - "CLANG=no-such-clang sh tests/bits.sh"
gate quick symbols_heap 'asks for: malloc' heap "$one && BUILDS=1f sh tests/symbols.sh"
gate quick symbols_library 'no build/libsph9f.a' - - "BUILDS=9f sh tests/symbols.sh"
gate quick house_heap 'no heap, stdio or libm here: .*malloc' heap "$house"
gate quick house_print 'no heap, stdio or libm here: .*printf' prints "$house"
gate quick house_upwards '\(base\) calls .*sph2f_step' upwards "$house"
gate quick house_circle 'a circle of files' upwards "$house"
gate quick house_floor 'has no floor for: .*gates_new' no_floor "$house"
gate quick house_line 'over 120 columns' wide_line "$house"
gate quick house_function 'has 61 lines' long_function "$house"
gate quick house_if '#if inside gates_if' if_inside "$house"
gate quick house_word 'names a module: viscosity' module_word "$house"
gate quick size_writable 'writable_host_1f .* no' writable "sh tests/size.sh --code host 1f"
gate quick size_stack 'stack_m4f_1f .* no' deep_stack "sh tests/size.sh --code m4f 1f"
gate quick warnings_gcc 'unused parameter' unused "$one WARN='$strict'"
gate quick warnings_clang 'unused parameter' unused \
    "$m build/clang/libsph1f.a BUILD=build/clang CC=clang WARN='$strict'"
gate quick knobs_compile 'no_XSPH: .* does not compile' knob_broken "KNOBS=XSPH KNOB_BUILD=1f sh tests/knobs.sh 0"
gate quick knobs_trap 'no_XSPH: the golden program exits with' knob_traps "KNOBS=XSPH KNOB_BUILD=1f sh tests/knobs.sh 0"
gate quick tests_fail 'the_integral_is_one' wrong_test "$(test_of test_kernels_1f)"
gate quick tests_none 'no test program' - - "sh tests/run.sh build"
gate quick tests_empty 'no test ran' - - "sh tests/run.sh build /bin/true"
gate quick dumps_byte '[1-9][0-9]* failed' dump_byte "$(test_of test_dumps_1f)"
gate quick readme_example '^[<>]' other_example "sh tests/readme.sh"
gate quick readme_block 'no C block' no_block "sh tests/readme.sh"
gate quick readme_table 'not what tests/results says' other_figure "sh tests/readme.sh"
gate quick entries_row 'sph_gates_new of .* has no row' no_row "sh tests/entries.sh"
gate quick table_targets '0 rows with a target' - \
    "printf 'n,v,u,t,ok\na,1,,1,yes\n' >build/t.csv && sh tests/table.sh build/t.csv" \
    "printf 'n,v,u,t,ok\na,1,,,\n' >build/t.csv && sh tests/table.sh build/t.csv"
gate quick targets_row 's390x of .* is not in' machine_out "STRICT=1 BUILDS=1f sh tests/targets.sh x86_64-gcc"
gate quick targets_tool 'left out: no no-such-gcc' machine_broken "STRICT=1 BUILDS=1f sh tests/targets.sh x86_64-gcc"
gate quick refuse_contraction 'contraction gcc .* no ' probe_off "BUILDS=1f sh tests/refuse.sh 'contraction gcc'"
gate quick lint_tool 'no no-such-cppcheck' - - "CPPCHECK=no-such-cppcheck sh tests/lint.sh"
gate quick fuzz_corpus 'config.pack holds no input' corpus_empty - "sh tests/fuzz.sh replay"
gate quick fuzz_sanitizer 'no no-such-clang with sanitizers' - - "CLANG=no-such-clang sh tests/fuzz.sh replay"
gate quick count_more 'bench_2d_f32 .* no' dearer "ROWS=bench_2d_f32 sh tests/count.sh"
gate quick tool_none 'no test ran' - - "$PYTHON tests/tool.py --only no_such_test"
gate all tool_writes 'FAILED a_history_that_does_not_fit' tool_blind "$m tool-test"
gate all lab_row '[1-9][0-9]* differ from' lab_row \
    "$m build/sph && $PYTHON tests/lab/run.py --smoke --studies hydrostatic --tool build/sph"
gate all travel_byte '[1-9][0-9]* went wrong' dump_byte_there "STRICT=1 BUILDS=1f sh tests/travel.sh i686"
gate all asan_over 'stack-buffer-overflow|out of bounds' over_the_end "$m asan TESTS=test_kernels ASAN_BUILDS=1f"
gate all tsan_race 'data race' race "$m tsan TSAN_TESTS=build/tsan/tests/test_threads_1d"
gate all slices_unit ' no$' - "sh tests/slices.sh" "UNIT=1 sh tests/slices.sh"
gate all baremetal_ram 'ram_m4f_all .* no' - "sh tests/baremetal.sh" "RAM=50000 sh tests/baremetal.sh"
gate all size_row 'code_m4f_1f .* was 1000' size_row "$m size-gate"
gate all browser_hash 'hashes differ' page_hash "$m browser"

[ $n -gt 0 ] || { echo "gates.sh: no gate is called '$chosen'" >&2; exit 2; }
mv "$out.tmp" "$out"
echo "gates: $n breaks, $bad of them not seen"
[ $bad -eq 0 ]
