build_o2/obj/2f/sph/report.o: sph/report.c sph/report.h sph/sph.h \
 sph/modules.h sph/name.h sph/knobs.h sph/options.h sph/shifting.h \
 sph/sponge.h sph/arithmetic.h
sph/report.h:
sph/sph.h:
sph/modules.h:
sph/name.h:
sph/knobs.h:
sph/options.h:
sph/shifting.h:
sph/sponge.h:
sph/arithmetic.h:
