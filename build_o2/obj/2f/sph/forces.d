build_o2/obj/2f/sph/forces.o: sph/forces.c sph/boundary.h sph/term.h \
 sph/pair.h sph/kernels.h sph/lanes.h sph/checks.h sph/sph.h \
 sph/modules.h sph/name.h sph/knobs.h sph/options.h sph/shifting.h \
 sph/sponge.h sph/passes.h sph/internal.h sph/arrays.h sph/columns.h \
 sph/digest.h sph/eos.h sph/fields.h sph/report.h sph/sweep.h \
 sph/scratch.h sph/tensor.h sph/continuity.h sph/diffusion.h \
 sph/factors.h sph/finish.h sph/gradient.h sph/hourglass.h \
 sph/reference.h sph/normalised.h sph/pair_power.h sph/pressure.h \
 sph/shear.h sph/viscosity.h sph/mirror.h sph/shift_sums.h \
 sph/stabilised.h sph/stress.h sph/smoothed.h sph/xsph.h sph/arithmetic.h
sph/boundary.h:
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
sph/continuity.h:
sph/diffusion.h:
sph/factors.h:
sph/finish.h:
sph/gradient.h:
sph/hourglass.h:
sph/reference.h:
sph/normalised.h:
sph/pair_power.h:
sph/pressure.h:
sph/shear.h:
sph/viscosity.h:
sph/mirror.h:
sph/shift_sums.h:
sph/stabilised.h:
sph/stress.h:
sph/smoothed.h:
sph/xsph.h:
sph/arithmetic.h:
