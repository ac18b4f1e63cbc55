#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# baremetal.sh: what an embedded user would do, in an emulated Cortex-M4F: the tank of examples/baremetal at a fixed
# rate, and a dam break of 2,002 particles in 192 KiB of RAM, all told. Hashes must be those of the host. Writes
# BUILD/baremetal.csv.
set -u
BUILD=${BUILD:-build} MAKE=${MAKE:-make} CC=${CC:-cc}
RAM=${RAM:-196608}   # bytes of RAM that the linker may use
STACK=${STACK:-6144} # of them for the stack
. port/cortexm.sh
metal_machine cortex-m4f || exit 1
dir=$BUILD/metal out=$BUILD/baremetal.csv bad=0
mkdir -p "$dir"
echo "name,value,unit,target,ok" >"$out.tmp"
export METAL_SECONDS=300

at_most() { # name value unit target
    ok=no
    [ "$2" -le "$4" ] && ok=yes
    echo "$1,$2,$3,<=$4,$ok" >>"$out.tmp"
}
equal() { # name, two files with a line "hash H"
    a=$(awk '$1 == "hash" {print $2}' "$2") b=$(awk '$1 == "hash" {print $2}' "$3")
    ok=no
    [ -n "$a" ] && [ "$a" = "$b" ] && ok=yes
    echo "$1,$a,hash,$b,$ok" >>"$out.tmp"
}
value() { awk -v n="$1" '$1 == n {print $2}' "$2"; }
failed() { echo "baremetal: $1" >&2; exit 1; }

echo "examples/baremetal/tank.c on $metal, SysTick at 100 Hz:"
metal_build "$dir/tank" -O2 2f "" examples/baremetal/tank.c || failed "the tank does not build"
metal_build_host "$dir/tank_host" 2f examples/baremetal/tank.c || failed "the tank does not build for this machine"
metal_count "$dir/tank" >"$dir/tank.txt"
code=$?
sed 's/^/  /' "$dir/tank.txt"
"$dir/tank_host" >"$dir/tank_host.txt"
at_most tank_m4f_exit_code $code "" 0
equal tank_m4f_hash "$dir/tank.txt" "$dir/tank_host.txt"

echo "a dam break in $RAM bytes of RAM on $metal:"
# scratch has room for the sums of every module that is compiled in: this image has those of water
w=-DSPH_WITH_
METAL_CFLAGS="${METAL_CFLAGS:-} ${w}SOLID=0 ${w}SHIFTING=0 ${w}FLOW=0 ${w}ENERGY=0 ${w}DAMPER=0"
METAL_CFLAGS="$METAL_CFLAGS ${w}DAMPING_RATE=0 ${w}XSPH_VELOCITY=0"
metal_build "$dir/ram_roomy" -O2 2f "" tests/metal_ram.c || failed "the dam break does not build"
metal_build_host "$dir/ram_host" 2f tests/metal_ram.c || failed "the dam break does not build for this machine"
"$dir/ram_host" >"$dir/ram_host.txt" || failed "the dam break does not run on this machine"
metal_count "$dir/ram_roomy" >"$dir/ram_roomy.txt" ||
    failed "the dam break does not run in a large RAM: $(cat "$dir/ram_roomy.txt")"
arena=$(value arena "$dir/ram_roomy.txt")
if metal_build "$dir/ram" -O2 2f "-Wl,--defsym=ram_size=$RAM,--defsym=stack_size=$STACK" -DARENA="$arena" \
    tests/metal_ram.c 2>"$dir/ram.log"; then
    metal_count "$dir/ram" >"$dir/ram.txt" || failed "the dam break does not run: $(cat "$dir/ram.txt")"
    grep 'bytes$' "$dir/ram.txt"
    for n in water walls; do echo "ram_m4f_$n,$(value $n "$dir/ram.txt"),particles,," >>"$out.tmp"; done
    for n in steps arena static stack; do
        echo "ram_m4f_$n,$(value $n "$dir/ram.txt"),$([ $n = steps ] && echo steps || echo bytes),," >>"$out.tmp"
    done
    at_most ram_m4f_stack_room "$(value stack "$dir/ram.txt")" bytes "$STACK"
    at_most ram_m4f_all "$(($(value static "$dir/ram.txt") + STACK))" bytes "$RAM"
    equal ram_m4f_hash "$dir/ram.txt" "$dir/ram_host.txt"
else
    grep 'overflowed' "$dir/ram.log" >&2 || cat "$dir/ram.log" >&2
    at_most ram_m4f_all $((arena + STACK + 256)) bytes "$RAM"
    grep 'bytes$' "$dir/ram_roomy.txt"
fi
mv "$out.tmp" "$out"
sh tests/table.sh "$out" || bad=1
exit $bad
