build_o2/obj/2f/sph/eos.o: sph/eos.c sph/eos.h sph/sph.h sph/modules.h \
 sph/name.h sph/knobs.h sph/options.h sph/shifting.h sph/sponge.h \
 sph/arithmetic.h sph/dmath.h
sph/eos.h:
sph/sph.h:
sph/modules.h:
sph/name.h:
sph/knobs.h:
sph/options.h:
sph/shifting.h:
sph/sponge.h:
sph/arithmetic.h:
sph/dmath.h:
