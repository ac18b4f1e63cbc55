build_o2/obj/2f/sph/totals.o: sph/totals.c sph/reading.h sph/internal.h \
 sph/arrays.h sph/columns.h sph/digest.h sph/name.h sph/eos.h sph/sph.h \
 sph/modules.h sph/knobs.h sph/options.h sph/shifting.h sph/sponge.h \
 sph/fields.h sph/lanes.h sph/checks.h sph/report.h sph/arithmetic.h
sph/reading.h:
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
sph/arithmetic.h:
