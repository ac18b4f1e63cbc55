build_o2/obj/2f/sph/dump.o: sph/dump.c sph/dump.h sph/internal.h \
 sph/arrays.h sph/columns.h sph/digest.h sph/name.h sph/eos.h sph/sph.h \
 sph/modules.h sph/knobs.h sph/options.h sph/shifting.h sph/sponge.h \
 sph/fields.h sph/lanes.h sph/checks.h sph/report.h sph/records.h \
 sph/stream.h sph/arithmetic.h
sph/dump.h:
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
sph/records.h:
sph/stream.h:
sph/arithmetic.h:
