build_o2/obj/2f/sph/inspect.o: sph/inspect.c sph/locals.h sph/sweep.h \
 sph/scratch.h sph/internal.h sph/arrays.h sph/columns.h sph/digest.h \
 sph/name.h sph/eos.h sph/sph.h sph/modules.h sph/knobs.h sph/options.h \
 sph/shifting.h sph/sponge.h sph/fields.h sph/lanes.h sph/checks.h \
 sph/report.h sph/reading.h sph/setup.h sph/arithmetic.h
sph/locals.h:
sph/sweep.h:
sph/scratch.h:
sph/internal.h:
sph/arrays.h:
sph/columns.h:
sph/digest.h:
sph/name.h:
sph/eos.h:
sph/sph.h:
sph/modules.h:
sph/knobs.h:
sph/options.h:
sph/shifting.h:
sph/sponge.h:
sph/fields.h:
sph/lanes.h:
sph/checks.h:
sph/report.h:
sph/reading.h:
sph/setup.h:
sph/arithmetic.h:
