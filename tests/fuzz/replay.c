/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* replay.c: a main for a fuzz target without a fuzzer, and the keeper of its corpus. The committed corpus of a target
   is one file: for each input its length (2 bytes, little-endian), then its bytes.
     replay PACK              gives every input of the pack to the target
     replay --file FILE...    gives each file to the target
     replay --unpack PACK DIR writes every input of the pack as a file
     replay --pack FILE...    writes a pack to standard output */
#include <stdint.h>
#include <stdio.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const unsigned char *data, size_t n);

enum { MOST = 65535 };
static unsigned char input[MOST];

static int fail(const char *what, const char *name)
{
    fprintf(stderr, "replay: %s: %s\n", name, what);
    return 2;
}

static int run_file(const char *name)
{
    FILE *f = fopen(name, "rb");
    if (!f)
        return fail("cannot be opened", name);
    const size_t n = fread(input, 1, MOST, f);
    fclose(f);
    LLVMFuzzerTestOneInput(input, n);
    return 0;
}

/* every input of a pack: to the target, or into dir */
static int walk(const char *pack, const char *dir)
{
    char name[512];
    unsigned count = 0;
    FILE *f = fopen(pack, "rb");
    if (!f)
        return fail("cannot be opened", pack);
    for (int low, high; (low = fgetc(f)) != EOF; count++) {
        if ((high = fgetc(f)) == EOF || fread(input, 1, (size_t)(low | high << 8), f) != (size_t)(low | high << 8)) {
            fclose(f);
            return fail("ends inside an input", pack);
        }
        const size_t n = (size_t)(low | high << 8);
        if (!dir) {
            LLVMFuzzerTestOneInput(input, n);
            continue;
        }
        snprintf(name, sizeof name, "%s/%04u", dir, count);
        FILE *out = fopen(name, "wb");
        if (!out || fwrite(input, 1, n, out) != n || fclose(out) != 0) {
            fclose(f);
            return fail("cannot be written", name);
        }
    }
    fclose(f);
    printf("%u inputs\n", count);
    return count > 0 ? 0 : fail("holds no input", pack);
}

static int pack_file(const char *name)
{
    FILE *f = fopen(name, "rb");
    if (!f)
        return fail("cannot be opened", name);
    const size_t n = fread(input, 1, MOST, f);
    fclose(f);
    const int good = putchar((int)(n & 255)) != EOF && putchar((int)(n >> 8)) != EOF && fwrite(input, 1, n,
        stdout) == n;
    return good ? 0 : fail("cannot be packed", name);
}

int main(int argc, char **argv)
{
    int bad = 0;
    if (argc == 2 && argv[1][0] != '-')
        return walk(argv[1], NULL);
    if (argc == 4 && strcmp(argv[1], "--unpack") == 0)
        return walk(argv[2], argv[3]);
    if (argc > 2 && (strcmp(argv[1], "--file") == 0 || strcmp(argv[1], "--pack") == 0)) {
        for (int i = 2; i < argc && !bad; i++)
            bad = argv[1][2] == 'f' ? run_file(argv[i]) : pack_file(argv[i]);
        return bad;
    }
    fprintf(stderr, "usage: replay PACK | --file FILE... | --unpack PACK DIR | --pack FILE...\n");
    return argc == 2 && strcmp(argv[1], "--help") == 0 ? 0 : 2;
}
