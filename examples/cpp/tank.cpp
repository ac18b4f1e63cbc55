// SPDX-License-Identifier: MIT. Copyright the sph authors.
// tank.cpp: the kernel from C++17: a column of water in a static arena falls for a hundredth of a second. With a library
// that `make install` put somewhere:
//   c++ -std=c++17 tank.cpp $(pkg-config --cflags --libs sph2f) -o tank && ./tank
#include <sph/sph.h>

#include <array>
#include <cstdint>
#include <cstdio>

namespace {

constexpr double dx = 0.05;
constexpr std::uint32_t most = 8000;
static SPH_ARENA(arena, SPH_ARENA_BYTES(most, 4000, 1, 0));

// a failure is told by the port; ctx is what the port was given
void say(void *ctx, const sph_report *r)
{
    std::fprintf(static_cast<std::FILE *>(ctx), "%s: %s\n", sph_status_text(r->status), r->what);
}

bool build(sph_sim *sim)
{
    std::array<double, SPH_DIM> low{}, high{}, water{};
    std::uint32_t set = 0, faces = 0;
    for (std::uint32_t k = 0; k < SPH_DIM; k++) {
        high[k] = 0.6;
        water[k] = 0.5;
        faces |= SPH_LOW(k) | (k + 1 < SPH_DIM ? SPH_HIGH(k) : 0u);
    }
    const sph_wall wall = sph_wall_default();
    return sph_add_fluid(sim, nullptr, &set) == SPH_OK &&
           sph_add_box(sim, set, low.data(), water.data(), nullptr) == SPH_OK &&
           sph_add_wall_box(sim, &wall, low.data(), high.data(), faces, true, nullptr) == SPH_OK;
}

} // namespace

int main()
{
    sph_config c = sph_config_default();
    c.max_particles = most;
    c.spacing = dx;
    c.smoothing_length = 1.2 * dx;
    c.sound_speed = 31;
    c.gravity[SPH_DIM - 1] = -9.81;
    c.port.ctx = stderr;
    c.port.fault = say;
    for (int k = 0; k < SPH_DIM; k++) {
        c.lo[k] = -0.2;
        c.hi[k] = 0.8;
    }
    sph_sim *sim = nullptr;
    sph_report why;
    if (sph_init(&sim, &c, arena, sizeof arena, &why) != SPH_OK) {
        std::fprintf(stderr, "%s: %s = %g, allowed: %s\n", sph_status_text(why.status), why.what, why.value, why.allowed);
        return 1;
    }
    if (!build(sim))
        return 1;
    while (sph_time(sim) < 0.01)
        if (sph_step_to(sim, 0.01) != SPH_OK)
            return 1;
    std::printf("%u particles, hash %016llx\n", static_cast<unsigned>(sph_count(sim)),
                static_cast<unsigned long long>(sph_hash(sim)));
    return 0;
}
