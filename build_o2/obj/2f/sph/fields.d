build_o2/obj/2f/sph/fields.o: sph/fields.c sph/fields.h sph/lanes.h \
 sph/checks.h sph/sph.h sph/modules.h sph/name.h sph/knobs.h \
 sph/options.h sph/shifting.h sph/sponge.h sph/arithmetic.h
sph/fields.h:
sph/lanes.h:
sph/checks.h:
sph/sph.h:
sph/modules.h:
sph/name.h:
sph/knobs.h:
sph/options.h:
sph/shifting.h:
sph/sponge.h:
sph/arithmetic.h:
