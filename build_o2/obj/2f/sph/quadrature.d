build_o2/obj/2f/sph/quadrature.o: sph/quadrature.c sph/quadrature.h \
 sph/reference.h sph/term.h sph/pair.h sph/kernels.h sph/lanes.h \
 sph/checks.h sph/sph.h sph/modules.h sph/name.h sph/knobs.h \
 sph/options.h sph/shifting.h sph/sponge.h sph/passes.h sph/internal.h \
 sph/arrays.h sph/columns.h sph/digest.h sph/eos.h sph/fields.h \
 sph/report.h sph/sweep.h sph/scratch.h sph/tensor.h sph/arithmetic.h
sph/quadrature.h:
sph/reference.h:
sph/term.h:
sph/pair.h:
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
sph/passes.h:
sph/internal.h:
sph/arrays.h:
sph/columns.h:
sph/digest.h:
sph/eos.h:
sph/fields.h:
sph/report.h:
sph/sweep.h:
sph/scratch.h:
sph/tensor.h:
sph/arithmetic.h:
