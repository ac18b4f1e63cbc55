build_o2/obj/2f/sph/arithmetic.o: sph/arithmetic.c sph/arithmetic.h \
 sph/sph.h sph/modules.h sph/name.h sph/knobs.h sph/options.h \
 sph/shifting.h sph/sponge.h sph/lanes.h sph/checks.h
sph/arithmetic.h:
sph/sph.h:
sph/modules.h:
sph/name.h:
sph/knobs.h:
sph/options.h:
sph/shifting.h:
sph/sponge.h:
sph/lanes.h:
sph/checks.h:
