build_o2/obj/2f/sph/shifting.o: sph/shifting.c sph/eos.h sph/sph.h \
 sph/modules.h sph/name.h sph/knobs.h sph/options.h sph/shifting.h \
 sph/sponge.h sph/motion.h sph/sweep.h sph/scratch.h sph/internal.h \
 sph/arrays.h sph/columns.h sph/digest.h sph/fields.h sph/lanes.h \
 sph/checks.h sph/report.h sph/shift_sums.h sph/term.h sph/pair.h \
 sph/kernels.h sph/passes.h sph/tensor.h sph/arithmetic.h
sph/eos.h:
sph/sph.h:
sph/modules.h:
sph/name.h:
sph/knobs.h:
sph/options.h:
sph/shifting.h:
sph/sponge.h:
sph/motion.h:
sph/sweep.h:
sph/scratch.h:
sph/internal.h:
sph/arrays.h:
sph/columns.h:
sph/digest.h:
sph/fields.h:
sph/lanes.h:
sph/checks.h:
sph/report.h:
sph/shift_sums.h:
sph/term.h:
sph/pair.h:
sph/kernels.h:
sph/passes.h:
sph/tensor.h:
sph/arithmetic.h:
