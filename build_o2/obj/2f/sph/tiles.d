build_o2/obj/2f/sph/tiles.o: sph/tiles.c sph/eos_lanes.h sph/lanes.h \
 sph/checks.h sph/sph.h sph/modules.h sph/name.h sph/knobs.h \
 sph/options.h sph/shifting.h sph/sponge.h sph/sweep.h sph/scratch.h \
 sph/internal.h sph/arrays.h sph/columns.h sph/digest.h sph/eos.h \
 sph/fields.h sph/report.h sph/arithmetic.h
sph/eos_lanes.h:
sph/lanes.h:
sph/checks.h:
sph/sph.h:
sph/modules.h:
sph/name.h:
sph/knobs.h:
sph/options.h:
sph/shifting.h:
sph/sponge.h:
sph/sweep.h:
sph/scratch.h:
sph/internal.h:
sph/arrays.h:
sph/columns.h:
sph/digest.h:
sph/eos.h:
sph/fields.h:
sph/report.h:
sph/arithmetic.h:
