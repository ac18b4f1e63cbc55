# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""studies.py: the studies of the lab, as data. A study is a scene, the choices to vary, a reference and an error norm.

A new study is one entry of STUDIES; a module joins the lab by a line in the `methods` of the studies that it concerns.
    methods   label: options of `sph run`; error against cost over `sizes`, and over `more[label]`, finer ones, where
    given doubles   labels that run in double too, at `sizes`
    h         labels: h/dx varied at size `at`
    courant   labels: the time step fixed to x h/c at size `at`, x a multiple of what step control would ask for
Norms take a finished run (validation.Run) and return a number in `unit`; ValueError where the run gave none.
"""
import math, os, sys
from dataclasses import dataclass, field

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from validation import (box_levels_off, box_peak, front_against_vof, impact_mean, impact_noise,  # noqa: E402
                        impact_peak, interpolate, levels_off, read_table)
import validate_solids as solids  # noqa: E402


@dataclass
class Study:
    name: str
    title: str
    scene: str
    norm: str
    unit: str                # a word, as "%", and of what
    reference: str
    error: object
    resolution: str          # the parameter, and what it counts
    sizes: list
    methods: dict
    base: dict = field(default_factory=dict)
    more: dict = field(default_factory=dict)
    doubles: tuple = ()
    at: float = 0
    h: dict = field(default_factory=dict)        # label: values of h/dx
    courant: dict = field(default_factory=dict)  # label: values of c dt/h
    step: object = None                          # (size, h/dx) -> h/c of the scene, in its own units of time
    quantity: str = ""                           # what the error is of, in words for `sph advise norm=`
    most_steps: int = 400000                     # a run whose step control creeps ends here, which is a result too


def last(run, column, factor=100.0):
    return factor * abs(run.col(column)[-1])


def whole(run):
    """A run that ended early has no error."""
    if run.error:
        raise ValueError(run.error)
    return run


# ---- water ----

G = 9.81
SOUND = 14.142135623730951  # in sqrt(g H), the scenes' default

WALLS = {
    "adami": dict(wall="adami"),
    "adami, no slip": dict(wall="adami_no_slip"),
    "ghost, p from continuity": dict(wall="ghost_compressible"),
    "ghost, p = 0": dict(wall="ghost"),
    "Lennard-Jones": dict(wall="lennard_jones"),
    "kernel force": dict(wall="kernel_force"),
    "Monaghan-Kos": dict(wall="monaghan_kos"),
}
INTEGRATORS = {
    "predictor-corrector": "predictor_corrector", "kick-drift-kick": "kick_drift_kick", "leap-frog": "leap_frog",
    "Runge-Kutta 2": "runge_kutta",
}
PC = dict(integrator="predictor_corrector", cfl=0.25)
KERNELS = ("cubic", "quartic", "quintic", "gaussian", "wendland_c2", "wendland_c4")
STEPS_H = [0.9, 1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.8, 2.0, 2.2, 2.5]


def plus(a, **more):
    return dict(a, **more)


def hydrostatic_error(run):
    return last(whole(run), "pressure_error_max")


def tank_error(run):
    return last(whole(run), "pressure_error_rms")


def dam_error(run):
    return front_against_vof(whole(run), "vof_dam_break_n2_1.csv", 5.0)


def vortex_error(run):
    whole(run)
    return 100 * max(abs(a / b - 1) for a, b in zip(run.col("kinetic_J"), run.col("kinetic_exact")))


def channel_error(run):
    return last(whole(run), "velocity_error_rms")


def noise_error(run):
    return 100 * impact_noise(whole(run))


def peak_error(run):
    return 100 * abs(impact_peak(whole(run)) / 2.51 - 1)


def mean_error(run):
    return 100 * abs(impact_mean(whole(run)) / 0.972 - 1)


def levels_error(run):
    return 100 * levels_off(whole(run))


def box_levels_error(run):
    return 100 * box_levels_off(whole(run), 2.0)


def box_peaks_error(run):
    return 100 * max(abs(box_peak(whole(run), k) - 1) for k in ("P1", "P2", "P3", "P4"))


def weir_error(run):
    t, angle = whole(run).col("time"), run.col("angle_deg")
    late = [a for a, now in zip(angle, t) if now >= 2 / 3 * t[-1]]
    return abs(sum(late) / len(late) - run.col("angle_exact")[-1])


def wave_error(run):
    y, e = whole(run).col("mode_m"), run.col("mode_linear")
    return 100 * math.sqrt(sum((a - b) ** 2 for a, b in zip(y, e)) / len(y)) / max(map(abs, e))


def drop_error(run):
    whole(run)
    return 100 * max(abs(x / y - 1) for k in "ab" for x, y in zip(run.col(f"{k}_moment"), run.col(f"{k}_exact")))


def courants(most):
    return [x for x in (0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0, 1.2, 1.4, 1.7, 2.0) if x <= most]


def by_integrator(base, most):
    return {name: (plus(base, integrator=key), courants(most)) for name, key in INTEGRATORS.items()}


def by_kernel(base):
    return {f"{k}": (plus(base, kernel=k), STEPS_H) for k in KERNELS}


hydrostatic = Study(
    "hydrostatic", "hydrostatic column in 1-D (G1)", "hydrostatic",
    "largest error of the pressure but for the top two particles",
    "% of the pressure at the bottom", "rho g depth (Gray 2001, section 2.5.1)", hydrostatic_error,
    "n, particles in the depth",
    [25, 50, 100, 200],
    {**{f"{w}, cubic": plus(o, kernel="cubic") for w, o in WALLS.items() if w != "adami, no slip"},
     "adami, quintic": dict(wall="adami", kernel="quintic"),
     "adami, Wendland C2 h 2": dict(wall="adami", kernel="wendland_c2", h=2),
     "adami, quintic, diffusion": dict(wall="adami", kernel="quintic", diffusion="hydrostatic"),
     "ghost, p from continuity, quintic, diffusion": dict(wall="ghost_compressible", kernel="quintic",
                                                          diffusion="hydrostatic")},
    doubles=("adami, quintic", "ghost, p from continuity, quintic, diffusion"), at=50,
    h=by_kernel(dict(wall="adami", diffusion="hydrostatic")),
    courant=by_integrator(dict(wall="adami", kernel="quintic"), 2.0),
    step=lambda n, h: h * (150 / n) / (SOUND * math.sqrt(150)))

BOTH = dict(shifting=0.5, h=2, alpha=0.005, delta=0.2, sound=10)  # front and pressure (the scene impact's defaults)
SMOOTH_TANK = dict(wall="adami", kernel="wendland_c2", h=2, diffusion="hydrostatic", delta=0.2)
still_tank = Study(
    "still_tank", "still tank (G2)", "still_tank", "rms error of the pressure after 3 s, the first 10,000 steps damped",
    "% of the pressure at the bottom", "rho g depth (Gray 2001, section 2.5.2)", tank_error,
    "n, particles in the depth",
    [8, 15, 30],
    {**WALLS,
     "adami, diffusion": dict(wall="adami", diffusion="hydrostatic"),
     "adami, quintic": dict(wall="adami", kernel="quintic"),
     "adami, Wendland C2, diffusion": dict(wall="adami", kernel="wendland_c2", diffusion="hydrostatic"),
     "ghost, p from continuity, diffusion": dict(wall="ghost_compressible", diffusion="hydrostatic"),
     "adami, Wendland C2 h 2, delta 0.2": SMOOTH_TANK,
     "adami, Wendland C2 h 2, delta 0.2, shifting 0.5": plus(SMOOTH_TANK, shifting=0.5),
     "as impact: shifting 0.5, h 2, alpha 0.005, delta 0.2, sound 10, floor": plus(
         BOTH, wall="adami", kernel="wendland_c2", diffusion="hydrostatic", floor="yes",
         integrator="kick_drift_kick", cfl=0.5),
     "adami, Shepard 40": dict(wall="adami", shepard=40)},
    doubles=("adami",), at=15,
    h={"Wendland C2": (dict(wall="adami", kernel="wendland_c2", diffusion="hydrostatic"), STEPS_H),
       "cubic": (dict(wall="adami", kernel="cubic", diffusion="hydrostatic"), STEPS_H)},
    courant=by_integrator(dict(wall="adami"), 1.4),
    step=lambda n, h: h * (0.15 / n) / (SOUND * math.sqrt(G * 0.15)))

dam_break = Study(
    "dam_break", "dam break, n^2 = 1 (G5)", "dam_break",
    "front, largest |Z/Z_ref - 1| for Z from 1.2 to 5, no shift in time", "%",
    "volume-of-fluid fronts of the same tank, tests/refdata/vof_dam_break_n2_1.csv", dam_error,
    "n, particles across the column",
    [15, 30, 60],
    {"default": {}, **{w: plus(o, diffusion="none") for w, o in WALLS.items()},
     "default, cubic": dict(kernel="cubic"),
     "default, quintic h 1.5": dict(kernel="quintic", h=1.5),
     "default, h 1.5": dict(h=1.5), "default, h 2": dict(h=2),
     "default, alpha 0.1": dict(alpha=0.1),
     "default, weak scheme": dict(scheme="weak"),
     "default, Molteni's diffusion": dict(diffusion="molteni"),
     "adami, Shepard 40": dict(diffusion="none", shepard=40),
     "default, no floor": dict(floor="no"),
     "default, predictor-corrector": PC,
     "default, predictor-corrector, no floor": plus(PC, floor="no"),
     "default, sound 7": dict(sound=7.0710678),
     "default, shifting 0.5": dict(shifting=0.5),
     "as impact: shifting 0.5, h 2, alpha 0.005, delta 0.2, sound 10": BOTH,
     "for pressure: h 2, alpha 0.02, delta 0.2, sound 14": dict(h=2, alpha=0.02, delta=0.2),
     "default, corrected gradients": dict(gradient="bonet_lok"),
     "default, h 2, corrected gradients": dict(gradient="bonet_lok", h=2)},
    base=dict(books="no", frames=100), more={"default": [120], "default, sound 7": [120]}, doubles=("default",), at=30,
    h={"Wendland C2": ({}, STEPS_H), "cubic": (dict(kernel="cubic"), STEPS_H)},
    courant={**by_integrator({}, 2.0), "kick-drift-kick, no floor": (dict(integrator="kick_drift_kick", floor="no"),
        courants(2.0))},
    step=lambda n, h: h * (0.0572 / n) / (SOUND * math.sqrt(G * 0.0572)))

taylor_green = Study(
    "taylor_green", "Taylor-Green vortex, Re 100 (B1)", "taylor_green",
    "kinetic energy, largest |E/E_exact - 1| until t = L/U", "%",
    "exact decay of the Navier-Stokes solution", vortex_error, "n, particles along a side", [25, 50, 100],
    {"default": {}, "no diffusion": dict(diffusion="none"), "cubic h 1.3": dict(kernel="cubic", h=1.3),
     "quintic h 1.5": dict(kernel="quintic", h=1.5), "Wendland C4 h 2.5": dict(kernel="wendland_c4", h=2.5),
     "h 1.5": dict(h=1.5), "h 2": dict(h=2), "h 3": dict(h=3), "lattice start": dict(jitter=0),
     "predictor-corrector": PC,
     "weak scheme": dict(scheme="weak"), "XSPH 0.5": dict(xsph=0.5),
     "density by summation": dict(density="summation", diffusion="none")},
    base=dict(frames=40), doubles=("default",), at=50,
    h={"Wendland C2": ({}, [1.2, 1.4, 1.6, 1.8, 2.0, 2.2, 2.5, 3.0]),
       "quintic": (dict(kernel="quintic"), [1.0, 1.2, 1.4, 1.6, 1.8, 2.0])},
    courant=by_integrator({}, 1.4), step=lambda n, h: h / n / 10)

NO_SHIFT = dict(shifting=0, alpha=0.02, sound=14.142135623730951)
impact_methods = {
    "default": {}, "no shifting": dict(shifting=0), "no shifting, alpha 0.02, sound 14": NO_SHIFT,
    "shifting 0.25": dict(shifting=0.25), "shifting 1": dict(shifting=1), "sound 14": dict(sound=14.142135623730951),
    "alpha 0.02": dict(alpha=0.02), "delta 0.1": dict(delta=0.1),
    "damper 0.2": dict(damper=0.2), "no shifting, alpha 0.02, sound 14, damper 0.4": plus(NO_SHIFT, damper=0.4),
    "h 1.2": dict(h=1.2), "h 1.5": dict(h=1.5),
    "as dam_break: h 1.2, alpha 0.01, delta 0.1, sound 14": plus(NO_SHIFT, h=1.2, alpha=0.01, delta=0.1),
}


def impact_study(name, title, norm, unit, reference, error):
    return Study(name, title, "impact", norm, unit, reference, error, "n, particles in the column's height", [20, 40],
                 impact_methods, base=dict(every=1e-4),
                 more={"default": [60], "no shifting, alpha 0.02, sound 14": [60]},
                 doubles=("default",), at=40, h={"default": ({}, [1.2, 1.5, 1.8, 2.0, 2.2])})


impact = impact_study(
    "impact", "dam break against a wall (B8), noise of the pressure",
    "rms of P1 about its mean over 10 ms, t* 3.2 .. 5.5", "% of rho g H", "none; measured 0.2 (Lobovsky et al. 2014)",
    noise_error)
impact_top = impact_study(
    "impact_peak", "dam break against a wall (B8), peak of the pressure",
    "largest mean of P1 over 10 ms, off the measured", "%", "one event, 2.51 rho g H (Lobovsky et al. 2014)",
    peak_error)
impact_after = impact_study(
    "impact_mean", "dam break against a wall (B8), pressure after the impact", "mean of P1, t* 3.2 .. 5.5", "%",
    "incompressible delta-SPH, 0.972 rho g H (De Courcy et al. 2024)", mean_error)

impact_levels = impact_study(
    "impact_levels", "dam break against a wall (B8), levels", "rms of the levels H1 .. H4 until t* 4", "% of H",
    "measured levels (Lobovsky et al. 2014), tests/refdata/lobovsky_levels.csv", levels_error)

dam_break_3d = Study(
    "dam_break_3d", "dam break of a slab in 3-D, n^2 = 1", "dam_break_3d",
    "front, largest |Z/Z_ref - 1| for Z from 1.2 to 5, no shift in time", "%",
    "volume-of-fluid fronts of the same tank in 2-D, tests/refdata/vof_dam_break_n2_1.csv", dam_error,
    "n, particles across the column", [8, 12, 16],
    {"default": {}, "default, no floor": dict(floor="no"), "default, sound 7": dict(sound=7.0710678),
     "default, h 1.5": dict(h=1.5), "as impact: shifting 0.5, h 2, alpha 0.005, delta 0.2, sound 10": BOTH},
    base=dict(books="no", frames=100, deep=0.5, width=0.5, length=6), more={"default": [20]}, at=12)


def box_study(name, title, norm, unit, error):
    return Study(name, title, "obstacle", norm, unit,
                 "measured (Kleefsman et al. 2005), tests/refdata/spheric_test2.csv", error,
                 "n, particles in the depth", [8, 11],
                 {"default": {}, "no shifting, alpha 0.02, sound 14": NO_SHIFT, "sound 14": dict(sound=SOUND)},
                 base=dict(every=0.004), at=11)


obstacle = box_study("obstacle", "dam break against a box, 3-D (B9), levels", "rms of the levels H1 .. H4 until 2 s",
                     "% of the depth", box_levels_error)
obstacle_peaks = box_study("obstacle_peaks", "dam break against a box, 3-D (B9), peaks of the pressure",
                           "largest mean over 20 ms of P1 .. P4 over the measured, the worst of them off 1", "%",
                           box_peaks_error)

channel = Study(
    "channel", "flow between two plates, Re 1 (B10)", "channel", "rms error of the velocity after H^2/nu",
    "% of the speed", "series of Poiseuille's and Couette's flow from rest (Morris, Fox & Zhu 1997)", channel_error,
    "n, particles between the plates", [10, 20, 40],
    {"default": {}, "Couette": dict(flow="couette"), "Re 10": dict(re=10),
     "together, Re 10": dict(flow="together", re=10),
     "quintic h 1.5": dict(kernel="quintic", h=1.5), "cubic h 1.3": dict(kernel="cubic", h=1.3),
     "h 1.5": dict(h=1.5), "h 1.2": dict(h=1.2), "weak scheme": dict(scheme="weak"),
     "ghost": dict(wall="ghost"), "predictor-corrector": PC},
    base=dict(frames=4), more={"default": [80]}, doubles=("default",), at=20,
    h={"Wendland C2": ({}, [1.2, 1.5, 1.8, 2.0, 2.5])})

standing_wave = Study(
    "standing_wave", "standing wave, Re 500 (B2)", "standing_wave",
    "rms of (mode - linear theory) over its amplitude, three periods",
    "% of the amplitude", "linear dispersion relation with Lamb's decay", wave_error, "n, particles in the depth",
    [10, 20, 40],
    {"default": {}, "no diffusion": dict(diffusion="none"), "cubic h 1.2": dict(kernel="cubic", h=1.2),
     "quintic h 1.5": dict(kernel="quintic", h=1.5), "h 1.5": dict(h=1.5), "h 1.2": dict(h=1.2),
     "Morris": dict(viscosity="morris"), "ghost, p from continuity": dict(wall="ghost_compressible"),
     "Shepard 40": dict(diffusion="none", shepard=40),
     "predictor-corrector": PC, "sound 7": dict(sound=7.0710678),
     "corrected gradients": dict(gradient="bonet_lok"),
     "corrected gradients, guard": dict(gradient="bonet_lok", guard="yes", cfl=0.9),
     "diffusion after Antuono": dict(diffusion="antuono")},
    base=dict(periods=3, frames=120), doubles=("default",), at=20,
    h={"Wendland C2": ({}, [1.0, 1.2, 1.4, 1.6, 1.8, 2.0, 2.2, 2.5, 3.0])},
    courant=by_integrator({}, 2.0), step=lambda n, h: h / n / (SOUND * math.sqrt(G)))

elliptical_drop = Study(
    "elliptical_drop", "elliptical drop (B4)", "elliptical_drop",
    "semi-axes, largest |a/a_exact - 1| or |b/b_exact - 1|", "%",
    "exact ordinary differential equation (Monaghan 1994)", drop_error, "n, particles in the radius", [10, 20, 40],
    {"default": {}, "cubic h 1.2": dict(kernel="cubic", h=1.2), "quintic h 1.2": dict(h=1.2),
     "Wendland C2 h 1.5": dict(kernel="wendland_c2"),
     "Wendland C2 h 2": dict(kernel="wendland_c2", h=2), "alpha 0": dict(alpha=0, integrator="kick_drift_kick"),
     "alpha 0.1": dict(alpha=0.1), "diffusion": dict(diffusion="molteni"),
     "kick-drift-kick": dict(integrator="kick_drift_kick", cfl=0.9),
     "direct scheme": dict(scheme="direct"), "weak scheme": dict(scheme="weak"), "sound 7": dict(sound=7)},
    base=dict(frames=40), more={"default": [80], "sound 7": [80]}, doubles=("default",), at=20,
    h={"quintic": ({}, STEPS_H), "Wendland C2": (dict(kernel="wendland_c2"), STEPS_H),
       "cubic": (dict(kernel="cubic"), STEPS_H)},
    courant=by_integrator({}, 2.0), step=lambda n, h: h / n / (14 * 100))

# ---- solids: units of their scenes, c0 = 1 ----

TOODY = [r for r in read_table("gray_rings.csv") if r["method"] == "TOODY"][1:]
PLATE = next(float(r["T_A"]) for r in read_table("fe_plate_periods.csv") if float(r["H"]) == 2
             and float(r["mu"]) == 0.22)
FORMS = {"total": dict(form="total"), "corrected": dict(form="corrected"), "Gray's": dict(form="updated")}
SOLID_INTEGRATORS = INTEGRATORS
PULSE = dict(height=16, duration=0.9, frames=90)


def pulse_error(run):
    return solids.pulse_off_exact(whole(run))


def pulse_loss(run):
    return abs(solids.pulse_loss(whole(run)))


def rings_error(run):
    whole(run)
    off = [solids.ring(run, c, float(t["time_us"])) - float(t[c]) for t in TOODY
           for c in ("width", "height", "separation")]
    return math.sqrt(sum(x * x for x in off) / len(off))


def plate_error(run):
    return 100 * abs(solids.period(whole(run)) / PLATE - 1)


def hole_error(run):
    return 100 * abs(whole(run).col("peak_rim")[-1] / HOLE - 1)


HOLE = max(float(r["sum"]) for r in read_table("fe_hole.csv"))

pulse_methods = {
    **{f"{name}, alpha 0.02": plus(o, alpha=0.02) for name, o in FORMS.items()},
    **{f"{name}, alpha 0.1": plus(o, alpha=0.1) for name, o in FORMS.items()},
    "total, alpha 0": dict(form="total", alpha=0),
    "total, alpha 0.02, Wendland C2": dict(form="total", alpha=0.02, kernel="wendland_c2"),
    "total, alpha 0.02, h 1.2": dict(form="total", alpha=0.02, h=1.2),
    "Gray's, alpha 0.1, epsilon 0.3": dict(form="updated", alpha=0.1, repulsion="principal"),
    "Gray's own: alpha 0.5, predictor-corrector": dict(form="updated", alpha=0.5, integrator="predictor_corrector"),
}
pulse = Study(
    "pulse", "longitudinal pulse (G12), speed", "pulse", "speed of the crests, the worse of the two", "%",
    "simple waves of their amplitude (Gray 2001, 5.6.1)", pulse_error, "n, particles in 20 widths of the pulse",
    [100, 200, 400],
    pulse_methods, base=PULSE, more={"total, alpha 0.02": [800]}, doubles=("total, alpha 0.02",), at=200,
    h={"total": (dict(form="total"), STEPS_H[1:9]), "corrected": (dict(form="corrected", alpha=0.1), STEPS_H[1:9]),
       "Gray's": (dict(form="updated", alpha=0.1), STEPS_H[1:9])},
    courant=by_integrator(dict(form="total"), 1.4), step=lambda n, h: h * 200 / n)

pulse_amplitude = Study(
    "pulse_amplitude", "longitudinal pulse (G12), amplitude", "pulse",
    "change of the weaker pulse's amplitude in 0.88 of a round", "%",
    "none is lost (Gray 2001, 5.6.1)", pulse_loss, "n, particles in 20 widths of the pulse", [100, 200, 400],
    pulse_methods, base=PULSE, more={"total, alpha 0.02": [800]}, doubles=("total, alpha 0.02",))

rings = Study(
    "rings", "colliding rings (G14)", "rings", "rms of width, height, gap less TOODY's at 500, 1000, 1500 us", "cm",
    "TOODY's finite differences as Gray 2001 prints them (table 6.2), tests/refdata/gray_rings.csv", rings_error,
    "dp, spacing in cm", [0.2, 0.1],
    {"total, alpha 0.1": {}, "total, alpha 0.5": dict(alpha=0.5), "total, alpha 0": dict(alpha=0),
     "total, cubic": dict(kernel="cubic"),
     "total, h 1.2": dict(h=1.2), "corrected, epsilon 0.3": dict(form="corrected", repulsion="principal"),
     "corrected, epsilon 0": dict(form="corrected"),
     "stabilised, alpha 0.5": dict(form="stabilised", kernel="cubic", alpha=0.5, repulsion="none"),
     "Gray's own: alpha 0.5, epsilon 0.3": plus(solids.CASE_OF_GRAY, alpha=0.5, repulsion="principal"),
     "Gray's, epsilon 0": plus(solids.CASE_OF_GRAY, alpha=0.5),
     "Gray's, alpha 0": plus(solids.CASE_OF_GRAY, alpha=0, repulsion="principal")},
    base=dict(every=1.70358), more={"total, alpha 0.1": [0.05]}, doubles=("total, alpha 0.1",), at=0.2,
    h={"total": ({}, [1.0, 1.1, 1.2, 1.3, 1.5, 1.7, 2.0])},
    courant=by_integrator({}, 1.0), step=lambda dp, h: h * dp)

plate = Study(
    "plate", "clamped plate, H 2, mu 0.22, V_f 0.001 (G15)", "plate", "period", "%",
    "plane-strain finite elements, tests/refdata/fe_plate_periods.csv", plate_error,
    "n, particles across the thickness", [6, 8, 10, 14],
    {"total": {}, "total, quadrature": dict(faces="quadrature"), "total, clamp of a region": dict(clamp="region"),
     "total, cubic h 1.2": dict(kernel="cubic", h=1.2),
     "total, h 1.0": dict(h=1.0), "total, h 1.2": dict(h=1.2),
     "corrected, epsilon 0.3, alpha 0.1": dict(form="corrected", alpha=0.1, h=1.2),
     "corrected, epsilon 0": dict(form="corrected", repulsion="none", h=1.2),
     "Gray's own: alpha 0.5, epsilon 0.3": plus(solids.CASE_OF_GRAY, alpha=0.5, repulsion="principal"),
     "Gray's, epsilon 0": plus(solids.CASE_OF_GRAY, alpha=0.5, repulsion="none"),
     "total, predictor-corrector, alpha 0.5": dict(integrator="predictor_corrector", alpha=0.5)},
    base=dict(speed=0.001, cycles=0.6, every=10), more={"total": [20], "total, quadrature": [20]}, doubles=("total",),
    at=8,
    h={"total": ({}, [0.6, 0.7, 0.8, 0.9, 1.0, 1.2, 1.4]),
       "corrected": (dict(form="corrected", alpha=0.1), [0.8, 1.0, 1.2, 1.4])},
    courant=by_integrator({}, 1.4), step=lambda n, h: h * 2 / n)

BEAM = next(float(r["T"]) for r in read_table("fe_beam_periods.csv") if r["ends"] == "both" and float(r["H"]) == 2
            and float(r["mu"]) == 0.22)


def beam_error(run):
    return solids.beam_error(whole(run), BEAM)


def csm3_error(run):
    return 100 * abs(solids.csm3_amplitude(whole(run)) / solids.CSM3[0] - 1)


def csm3_frequency(run):
    return 100 * abs(solids.csm3_frequency(whole(run)) / solids.CSM3[1] - 1)


beam = Study(
    "beam", "beam clamped at both ends, H 2, mu 0.22, V_f 0.001", "beam", "period", "%",
    "plane-strain finite elements, tests/refdata/fe_beam_periods.csv", beam_error,
    "n, particles across the height", [6, 8, 10, 14],
    {"total": {}, "total, quadrature": dict(faces="quadrature"), "total, clamps of a region": dict(clamp="region"),
     "total, region, quadrature": dict(clamp="region", faces="quadrature")},
    base=dict(cycles=0.75, frames=100), more={"total": [20], "total, quadrature": [20]},
    doubles=("total, quadrature",))

csm3 = Study(
    "csm3", "CSM3 of Turek and Hron: a beam swings under gravity (B11), amplitude", "csm3", "amplitude of A", "%",
    "65.160 mm, Turek & Hron 2006", csm3_error, "n, particles across the beam", [4, 5, 8],
    {"total": dict(faces="equal"), "total, quadrature": {}}, base=dict(frames=400), more={"total, quadrature": [10]})

csm3_beat = Study(
    "csm3_frequency", "CSM3 of Turek and Hron: a beam swings under gravity (B11), frequency", "csm3", "frequency", "%",
    "1.0995 Hz, Turek & Hron 2006", csm3_frequency, "n, particles across the beam", [4, 5, 8],
    {"total": dict(faces="equal"), "total, quadrature": {}}, base=dict(frames=400), more={"total, quadrature": [10]})

hole = Study(
    "hole", "hole in a block (G19)", "hole", "largest stress on the rim off the exact 3.0546 p1", "%",
    "series solution of the block, tests/refdata/fe_hole.csv", hole_error, "n, particles across the block",
    [40, 70, 100],
    {"corrected": {}, "Gray's": dict(form="updated"), "total": dict(form="total"),
     "corrected, square lattice": dict(lattice="square"),
     "Gray's, square lattice": dict(form="updated", lattice="square"), "corrected, h 1.2": dict(h=1.2),
     "corrected, cubic h 1.2": dict(kernel="cubic", h=1.2)},
    more={"corrected": [140]}, doubles=("corrected",), at=40,
    h={"corrected": ({}, [1.0, 1.1, 1.2, 1.3, 1.5, 1.7, 2.0])},
    courant=by_integrator({}, 1.0), step=lambda n, h: h * 7 / n)

weir = Study(
    "weir", "jet over a plate without gravity (G8)", "weir", "angle of the jet off the exact one", "degrees",
    "free streamlines, Dias & Tuck 1991", weir_error, "n, particles across the stream", [10, 16, 24],
    {"default": {}, "h 1.2": dict(h=1.2), "h 2": dict(h=2), "no floor": dict(floor="no"),
     "alpha 0.05": dict(alpha=0.05), "corrected": dict(gradient="bonet_lok")})

tube = Study(
    "shock_tube", "Sod's shock tube in 2-D (B5)", "shock_tube", "L1 error of the density at t 0.2",
    "% of the left one's",
    "exact solution (examples/scenes/riemann.c)", lambda run: last(whole(run), "L1_density"),
    "n, particles along the tube", [50, 100, 200, 400],
    {"default": {}, "corrected": dict(gradient="bonet_lok"), "variable h": dict(variable_h="yes"),
     "variable h, Wendland C4": dict(variable_h="yes", kernel="wendland_c4"),
     "variable h, h 3": dict(variable_h="yes", h=3), "Wendland C4": dict(kernel="wendland_c4")},
    base=dict(beta=2, frames=1), doubles=("variable h, Wendland C4",))

STUDIES = [hydrostatic, still_tank, dam_break, impact, impact_top, impact_after, impact_levels, dam_break_3d, obstacle,
           obstacle_peaks, taylor_green, channel, standing_wave, elliptical_drop, pulse, pulse_amplitude, rings, plate,
           beam, csm3, csm3_beat, hole, weir, tube]
QUANTITY = {
    "hydrostatic": "pressure", "still_tank": "pressure", "dam_break": "front", "impact": "pressure noise",
    "impact_peak": "pressure peak", "impact_mean": "pressure mean", "impact_levels": "levels front",
    "dam_break_3d": "front", "obstacle": "levels front", "obstacle_peaks": "pressure peak", "taylor_green": "energy",
    "channel": "velocity", "standing_wave": "surface", "elliptical_drop": "front", "pulse": "speed",
    "pulse_amplitude": "amplitude", "rings": "shape", "plate": "period", "beam": "period",
    "csm3": "amplitude", "csm3_frequency": "frequency", "hole": "stress",
    "weir": "angle", "shock_tube": "density",
}
for study in STUDIES:
    study.quantity = QUANTITY[study.name]
