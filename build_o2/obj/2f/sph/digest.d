build_o2/obj/2f/sph/digest.o: sph/digest.c sph/digest.h sph/name.h \
 sph/arithmetic.h sph/sph.h sph/modules.h sph/knobs.h sph/options.h \
 sph/shifting.h sph/sponge.h
sph/digest.h:
sph/name.h:
sph/arithmetic.h:
sph/sph.h:
sph/modules.h:
sph/knobs.h:
sph/options.h:
sph/shifting.h:
sph/sponge.h:
