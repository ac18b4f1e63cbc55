build_o2/obj/2f/sph/finish.o: sph/finish.c sph/finish.h sph/scratch.h \
 sph/internal.h sph/arrays.h sph/columns.h sph/digest.h sph/name.h \
 sph/eos.h sph/sph.h sph/modules.h sph/knobs.h sph/options.h \
 sph/shifting.h sph/sponge.h sph/fields.h sph/lanes.h sph/checks.h \
 sph/report.h sph/boundary.h sph/term.h sph/pair.h sph/kernels.h \
 sph/passes.h sph/sweep.h sph/tensor.h sph/quadrature.h sph/reference.h \
 sph/shift_sums.h sph/stress.h sph/smoothed.h sph/arithmetic.h
sph/finish.h:
sph/scratch.h:
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
sph/boundary.h:
sph/term.h:
sph/pair.h:
sph/kernels.h:
sph/passes.h:
sph/sweep.h:
sph/tensor.h:
sph/quadrature.h:
sph/reference.h:
sph/shift_sums.h:
sph/stress.h:
sph/smoothed.h:
sph/arithmetic.h:
