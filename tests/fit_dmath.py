# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""prints the constants of dmath.c: polynomial fits, split constants and the bits of 2/pi.

each polynomial interpolates its function at chebyshev nodes (80-digit arithmetic, needs
mpmath), which is within a small factor of the minimax error; the error printed beside it is
that of the coefficients after rounding to double, scaled to the result of the function.
"""
from mpmath import mp, mpf, cos, sin, exp, log, atan, atanh, pi, sqrt, matrix, lu_solve, floor, fabs

mp.dps = 80


def fit(name, f, scale, lo, hi, n):
    lo, hi = mpf(lo), mpf(hi)
    xs = [(lo + hi) / 2 + (hi - lo) / 2 * cos(pi * (2 * i + 1) / (2 * n)) for i in range(n)]
    a = matrix(n, n)
    b = matrix(n, 1)
    for i, x in enumerate(xs):
        b[i] = f(x)
        for j in range(n):
            a[i, j] = x ** j
    c = [float(v) for v in lu_solve(a, b)]
    worst = mpf(0)
    for i in range(1, 400):
        x = lo + (hi - lo) * (i + mpf(1) / 3) / 400
        p = sum(mpf(v) * x ** j for j, v in enumerate(c))
        worst = max(worst, fabs(p - f(x)) * fabs(scale(x)))
    print("/* %s: scaled error 2^%.1f */" % (name, float(log(worst, 2))))
    for v in c:
        print("    %s," % v.hex())


def split(name, v, bits):
    out = []
    for b in bits:
        if b:
            e = floor(log(fabs(v), 2))
            q = mpf(2) ** (b - 1 - e)
            h = floor(v * q) / q
        else:
            h = mpf(float(v))
        out.append(float(h).hex())
        v -= h
    print(name, out)


fit("exp", lambda r: (exp(r) - 1 - r) / r ** 2, lambda r: r * r, "-0.34661", "0.34662", 11)
fit("sin", lambda z: (sin(sqrt(z)) / sqrt(z) - 1) / z, lambda z: z, "1e-9", "0.61690", 6)
fit("cos", lambda z: (cos(sqrt(z)) - 1 + z / 2) / z ** 2, lambda z: z * z, "1e-9", "0.61690", 6)
fit("log", lambda z: (atanh(sqrt(z)) / sqrt(z) - 1 - z / 3) / z ** 2, lambda z: z * z,
    "1e-9", "0.02944", 8)
fit("atan", lambda z: (atan(sqrt(z)) / sqrt(z) - 1) / z, lambda z: z, "1e-9", "0.0625", 8)
# parts c1..c3 hold 33 bits aligned to fixed weights so that n * part is exact for |n| < 2^20
v = pi / 2
parts = []
for w in (32, 65, 98):
    h = floor(v * mpf(2) ** w) / mpf(2) ** w
    parts.append(float(h).hex())
    v -= h
print("pi/2 parts", parts + [float(v).hex()])
split("pi/2", pi / 2, [0, 0])
split("pi/4", pi / 4, [0, 0])
split("pi", pi, [0, 0])
split("atan 1/2", atan(mpf(1) / 2), [0, 0])
split("1/3", mpf(1) / 3, [0, 0])
split("2/pi", 2 / pi, [0])
split("1/ln2", 1 / log(2), [0])
split("ln2", log(mpf(2)), [40, 0])
mp.prec = 1400
t = 2 / pi
words = []
for i in range(37):
    t *= 2 ** 32
    d = int(floor(t))
    words.append("0x%08xu" % d)
    t -= d
print(", ".join(words))
