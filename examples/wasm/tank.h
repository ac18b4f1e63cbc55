/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* tank.h: what the page calls (tank.c). Functions that give an int return an sph_status, 0 for success. */
#ifndef EXAMPLE_TANK_H
#define EXAMPLE_TANK_H

#define TANK_NUMBERS 3 /* floats a particle in the picture: x, y (m from the tank's low corner), speed (m/s) */

#ifdef __wasm__
#define TANK_EXPORT(name) __attribute__((export_name(name)))
#else
#define TANK_EXPORT(name)
#endif

TANK_EXPORT("start") int tank_start(void);           /* fills the tank, or starts afresh, upright */
TANK_EXPORT("tilt") int tank_tilt(int degrees);      /* clockwise: the right side sinks */
TANK_EXPORT("step") int tank_step(void);
TANK_EXPORT("text") const char *tank_text(int status);
TANK_EXPORT("time") double tank_time(void);          /* s */
TANK_EXPORT("width") double tank_width(void);        /* m */
TANK_EXPORT("height") double tank_height(void);
TANK_EXPORT("spacing") double tank_spacing(void);
TANK_EXPORT("particles") unsigned tank_particles(void); /* walls included */
TANK_EXPORT("hash") unsigned tank_hash(int high);    /* one half of the state hash */
TANK_EXPORT("draw") unsigned tank_draw(void);        /* writes the picture; particles of water in it */
TANK_EXPORT("picture") const float *tank_picture(void);

#endif
