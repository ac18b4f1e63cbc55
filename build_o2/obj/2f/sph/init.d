build_o2/obj/2f/sph/init.o: sph/init.c sph/arithmetic.h sph/sph.h \
 sph/modules.h sph/name.h sph/knobs.h sph/options.h sph/shifting.h \
 sph/sponge.h sph/config.h sph/factors.h sph/scratch.h sph/internal.h \
 sph/arrays.h sph/columns.h sph/digest.h sph/eos.h sph/fields.h \
 sph/lanes.h sph/checks.h sph/report.h sph/sweep.h
sph/arithmetic.h:
sph/sph.h:
sph/modules.h:
sph/name.h:
sph/knobs.h:
sph/options.h:
sph/shifting.h:
sph/sponge.h:
sph/config.h:
sph/factors.h:
sph/scratch.h:
sph/internal.h:
sph/arrays.h:
sph/columns.h:
sph/digest.h:
sph/eos.h:
sph/fields.h:
sph/lanes.h:
sph/checks.h:
sph/report.h:
sph/sweep.h:
