/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* dump.h: the state as a stream of bytes, and back. Little-endian on every machine; nothing but the tables of format.c
   and the lists of fields and options says what is in it, so writer (dump.c) and reader (restore.c) cannot disagree. No
   array is added: a restore reads into the spare buffer.

     preamble   32 bytes, the same in all versions
                 0  magic 89 'S' 'P' 'H' 0d 0a 1a 0a
                 8  u32 version
                12  u8 dimension, u8 bytes of a real, u8 bytes of a position, u8 kind (1 full, 0 reduced)
                16  u64 bytes of the whole dump
                24  u32 sections
                28  u32 CRC-32 of the 28 bytes before
     sections   header of 64 bytes, payload, u32 CRC-32 of the payload
                 0  name, 16 bytes, filled up with zeros
                16  unit, 16 bytes
                32  u32 type of an element: 0 record, 1 u8, 2 u32, 3 i32, 4 i64, 5 f32, 6 f64, 7 u64
                36  u32 components (of a record: fields)
                40  u64 count (of a record: rows)
                48  u64 bytes of the payload
                56  u32 number of the section, from 0
                60  u32 CRC-32 of the 60 bytes before
     array      all elements' first component, then all elements' second, ...
     record     for each field 32 bytes: name 16, unit 12, u8 type (4, 6 or 7), u8 components, u16 0;
                then the rows: 8 bytes for each component of each field
     order      scene, sets, materials (with solids), groups, run, state (records); arrays; "end": one u32, the CRC-32
                of the CRCs of the preamble and of header and payload of every section before it, in order

     notes      behind the end a host may put a section of its own, which the kernel neither writes nor reads and which
                is not among the bytes and sections of the preamble: name "notes", unit "text", u8, its number the one
                after that of "end". The tool writes lines KEY=VALUE: scene, parameters, units (tools/dumpfile.h)

   CRC-32 is that of IEEE 802.3 (zlib). Positions are integers, also in a reduced dump: x = lo + quantum * pos. `rho`
   is the relative density excess (density - rho0)/rho0 with the rho0 of the particle's set; set 255 is a particle that
   is gone. Pressure from it: scene.eos and sets.pressure_scale (see SPH_TAIT in sph.h). A wall particle moves with
   the velocity of its group: its `vel` is what viscosity sees. */
#ifndef SPH_DUMP_H
#define SPH_DUMP_H

#include "internal.h"
#include "records.h"

/* what may change between steps by sph_reconfigure, and what sph_get_step tells of the latest step */
typedef struct sph_run {
#define SPH_RUN_MEMBER(A, name, kind, start, low, high, in, allowed, change, ...) SPH_RUN_MEMBER_##change(name, kind)
#define SPH_RUN_MEMBER_FREE(name, kind) SPH_MEMBER_##kind(name)
#define SPH_RUN_MEMBER_FIXED(name, kind)
#define SPH_RUN_MEMBER_ROOM(name, kind)
    SPH_OPTIONS(SPH_RUN_MEMBER, SPH_RUN_MEMBER, )
    uint64_t work, pairs;
    uint32_t passes, limit;
} sph_run;

/* the records before and behind that of the groups: sets and materials; a restore asks for equal ones */
#define sph_move_setup SPH_NAME(move_setup_)
bool sph_move_setup(sph_stream *s, const sph_sim *sim);
#define sph_move_scalars SPH_NAME(move_scalars_)
bool sph_move_scalars(sph_stream *s, const sph_sim *sim, const sph_scalars *from, sph_scalars *to, const sph_run *run,
                      sph_run *run_to);
/* the state fields that `fields` asks for, SPH_DUMP_..., of n particles of a buffer */
#define sph_move_arrays SPH_NAME(move_arrays_)
bool sph_move_arrays(sph_stream *s, const sph_sim *sim, const sph_buffer *b, uint32_t fields, uint32_t n);

#endif
