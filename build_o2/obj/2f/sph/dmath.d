build_o2/obj/2f/sph/dmath.o: sph/dmath.c sph/dmath.h sph/name.h \
 sph/arithmetic.h sph/sph.h sph/modules.h sph/knobs.h sph/options.h \
 sph/shifting.h sph/sponge.h
sph/dmath.h:
sph/name.h:
sph/arithmetic.h:
sph/sph.h:
sph/modules.h:
sph/knobs.h:
sph/options.h:
sph/shifting.h:
sph/sponge.h:
