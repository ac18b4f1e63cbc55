build_o2/obj/2f/sph/probes.o: sph/probes.c sph/kernels.h sph/lanes.h \
 sph/checks.h sph/sph.h sph/modules.h sph/name.h sph/knobs.h \
 sph/options.h sph/shifting.h sph/sponge.h sph/reading.h sph/internal.h \
 sph/arrays.h sph/columns.h sph/digest.h sph/eos.h sph/fields.h \
 sph/report.h sph/arithmetic.h
sph/kernels.h:
sph/lanes.h:
sph/checks.h:
sph/sph.h:
sph/modules.h:
sph/name.h:
sph/knobs.h:
sph/options.h:
sph/shifting.h:
sph/sponge.h:
sph/reading.h:
sph/internal.h:
sph/arrays.h:
sph/columns.h:
sph/digest.h:
sph/eos.h:
sph/fields.h:
sph/report.h:
sph/arithmetic.h:
