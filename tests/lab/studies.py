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
from validation import front_against_vof, interpolate, read_table  # noqa: E402
import validate_solids as solids  # noqa: E402


@dataclass
class Study:
    name: str
    title: str
    scene: str
    norm: str
    unit: str
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
     "corrected gradients": dict(gradient="bonet_lok")},
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

STUDIES = [hydrostatic, still_tank, dam_break, taylor_green, channel, standing_wave, elliptical_drop, pulse,
           pulse_amplitude,
           rings, plate, beam, csm3, csm3_beat, hole]
