/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* entry.c: where a fuzzer or the replay comes in. The first byte chooses the build, so that one corpus serves all of
   them; FUZZ_TARGET (config, particles, walls, dumps) is given by the Makefile. */
#include <stddef.h>
#include <stdint.h>

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)
#define IN_1D JOIN(sph1d_fuzz_, FUZZ_TARGET)
#define IN_2F JOIN(sph2f_fuzz_, FUZZ_TARGET)
#define IN_3D JOIN(sph3d_fuzz_, FUZZ_TARGET)

void IN_1D(const unsigned char *data, size_t n);
void IN_2F(const unsigned char *data, size_t n);
void IN_3D(const unsigned char *data, size_t n);
int LLVMFuzzerTestOneInput(const unsigned char *data, size_t n);

int LLVMFuzzerTestOneInput(const unsigned char *data, size_t n)
{
    if (n == 0)
        return 0;
    switch (data[0] % 4) {
    case 2: IN_1D(data + 1, n - 1); break;
    case 3: IN_3D(data + 1, n - 1); break;
    default: IN_2F(data + 1, n - 1); break;
    }
    return 0;
}
