#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# oracle_breaks.sh [NAME...]: breaks the kernel in a copy of the tree, in ways in which it was once broken, and asks the
# oracle (tests/oracle). It must name the quantity that goes wrong, which must have been right before. Writes
# BUILD/oracle_breaks.csv.
set -u
BUILD=${BUILD:-build} MAKE=${MAKE:-make} WHICH=${WHICH:-2d} SCENES=${SCENES:-1500}
dir=$BUILD/oracle_breaks out=$BUILD/oracle_breaks.csv bad=0 n=0 chosen=$*
tree=$dir/tree
mkdir -p "$dir" && rm -rf "$tree" && mkdir "$tree" &&
    tar cf - Makefile sph port examples tools tests/oracle tests/*.[ch] | tar xf - -C "$tree" || exit 1

# the oracle on the copy: what differs, a quantity a line
ask() {
    (cd "$tree" && $MAKE --no-print-directory -s build/oracle_$WHICH BUILD=build OPT=-O1 CC="${CC:-cc}" WARN=-w &&
        timeout "${LIMIT:-300}" build/oracle_$WHICH 1 "$SCENES") >"$1" 2>&1
    rc=$?
    [ $rc -le 1 ] && grep -q ' scenes: ' "$1"
}
echo "name,value,unit,target,ok" >"$out.tmp"
ask "$dir/sound.txt" ||
    { echo "oracle_breaks: the unbroken kernel does not run: $(tail -n 1 "$dir/sound.txt")" >&2; exit 1; }
counts() { # file, quantity: 1 if it differs
    awk -v q="$2" '/^ +[0-9]+  / {sub(/^ +[0-9]+  /, ""); sub(/ \(first seed.*/, ""); n += $0 == q}
        END {print n + 0}' "$1"
}

# name, quantity that must differ, file, sed expression
break_it() {
    case " $chosen " in "  " | *" $1 "*) ;; *) return ;; esac
    n=$((n + 1)) said=
    cp "$tree/$3" "$dir/whole"
    sed -i "$4" "$tree/$3"
    if cmp -s "$dir/whole" "$tree/$3"; then
        said="nothing to break in $3"
    elif [ "$(counts "$dir/sound.txt" "$2")" != 0 ]; then
        said="differs before anything is broken: $2"
    elif ! ask "$dir/$1.txt"; then
        said="does not run: $(tail -n 1 "$dir/$1.txt" | cut -c1-80)"
    elif [ "$(counts "$dir/$1.txt" "$2")" = 0 ]; then
        said="not seen"
    fi
    cp "$dir/whole" "$tree/$3"
    ok=yes
    [ -z "$said" ] || { ok=no bad=$((bad + 1)); }
    seen=$(grep -m1 "^seed.*: $2 of" "$dir/$1.txt" 2>/dev/null | sed 's/.*: kernel/kernel/' | cut -c1-80)
    printf '  %-26s %-4s %s\n' "$1" $ok "${said:-$2: $seen}"
    echo "$1,$([ $ok = yes ] && echo seen || echo missed),break,seen,$ok" >>"$out.tmp"
}

break_it seam_lost acceleration sph/sweep.c \
    's/^    if (SPH_IS(face, PERIODIC)) {/    if (SPH_IS(face, PERIODIC) \&\& high) return false;\n&/'
break_it floor_stores internal sph/eos.c 's/    if (floor && d < 0)/    if (floor \&\& d < -1)/'
break_it mirror_slips 'viscous power' sph/sweep.c 's/a == k || SPH_IS(face, MIRROR_NO_SLIP)/a == k/'
break_it size_of_m acceleration sph/tensor.h 's/ && det > least)/)/'
break_it wall_work 'wall power' sph/pair_power.h 's/(apart ? p->push\[k\] + other : other)/other/'
break_it beta_max acceleration sph/viscosity.h 's/half = v_set((sph_real)0.5)/half = v_set((sph_real)0.6)/'
break_it half_way 'density after steps' sph/integrators.c \
    's/half_way = {0.5, 0, 0.5, 0.5/half_way = {0.5, 0, 0.5, 0.45/'
break_it bounce 'velocity after steps' sph/move.c \
    's/SPH_TURNS_VECTORS << k ? -v\[k\] : v/SPH_TURNS_VECTORS << k ? (sph_real)-0.99 * v[k] : v/'
break_it wall_acceleration 'velocity after steps' sph/adami.c 's/(sim->cfg.gravity\[k\] - a)/sim->cfg.gravity[k]/'
break_it contact_energy 'balance of powers' sph/reference.h \
    's/s\[SUM_IN_BONDS\] + p->force/s[SUM_IN_BONDS] + 0 * p->force/'
break_it image_of_wall acceleration sph/boundary.c \
    's/return turned >> k & 1 ? -v : v;/return turned >> k \& 1 ? v : v;/'
break_it other_material 'density rate' sph/factors.c 's/i->kin == j->kin ? /true ? /'
break_it hydrostatic_image 'density rate' sph/factors.c 's/(sph_real)(turned ? -slope : slope)/(sph_real)slope/'
break_it diffusion_limit 'diffusion limit' sph/factors.c 's/0.875 \* stands/1.75 * stands/'
break_it square_root_of_7 'courant limit' sph/timestep.c 's/TAIT_GRAY) ? 7 : 1/TAIT_GRAY) ? 1 : 1/'
break_it thin_neighbour 'density rate' sph/tiles.c 's/LEAST_DENSITY ((sph_real)0.5)/LEAST_DENSITY ((sph_real)0.4)/'
break_it shifting_deep filling sph/shifting.c 's/DEEP_SPREAD ((sph_real)0.98)/DEEP_SPREAD ((sph_real)0.95)/'
break_it shifting_book 'book of shifting' sph/shifting.c 's/ energy(sim, s, was) - / 0.99 * energy(sim, s, was) - /'
break_it birth_half_off 'place after steps' sph/flow.c \
    's/+= f->end - f->face;/+= f->end - f->face - (sph_pos)(0.5 * sim->cfg.spacing \/ sim->grid.quantum);/'
break_it flow_density_free 'density after steps' sph/flow.c '/b->rho\[0\]\[j\] = o->rho\[0\]\[p\];/d'
break_it ids_from_0 'particles that are there' sph/flow.c 's/next_id = id + 1;/next_id = 0;/'
break_it damps_the_held 'book of damping' sph/damping.c 's/ \&\& is_free(sim, o->set\[0\]\[p\])//'
break_it off_the_mitre "place of a bed's" sph/polyline.c 's/share = 1 \/ (1 + a/share = 1 \/ (1.1 + a/'
break_it bed_corner_open 'face of a bed' sph/polyline.c 's/t1 > 0 ? t1 \* s->thick : 0/0/'

[ $n -gt 0 ] || { echo "oracle_breaks.sh: no break is called '$chosen'" >&2; exit 2; }
mv "$out.tmp" "$out"
echo "oracle-breaks: $n breaks, $bad of them not seen"
[ $bad -eq 0 ]
