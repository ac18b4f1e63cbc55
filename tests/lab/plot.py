# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""plot.py: charts by gnuplot, made of panels below each other, as SVG and PNG, readable in black and white.

All places are worked out here in pixels: ticks, ranges, the column of names at the right of a panel (each beside the
end of its line, moved apart where they would overlap), and the caption. Nothing in the files depends on the day or the
machine but the version of gnuplot and, in PNG, of cairo.
"""
import math, os, re, shutil, struct, subprocess, sys, textwrap, zlib

WIDTH = 520
FONT = 13           # pixels
LINE = 17           # of text
MISSING = "charts: no gnuplot, which draws them; as root: apt-get install -y --no-install-recommends gnuplot-nox"
# a style is a dash, a shape of points and a grey; neighbours differ in all three
DASH = ("solid", "(14,6)", "(4,4)", "(14,5,3,5)", "(22,6)", "(2,6)")
POINT = (7, 6, 5, 4, 9, 8, 13, 12, 11, 10, 2, 1, 3)
GREY = ("#000000", "#555555", "#2a2a2a", "#777777")


def need_gnuplot():
    if not shutil.which("gnuplot"):
        sys.exit(MISSING)


def quote(text):
    return "'" + str(text).replace("'", "''") + "'"


def plain(text):
    """text for the labels of ticks, which understand ^ and _"""
    return re.sub(r"([_^{}@&~])", r"\\\1", str(text))


def wrap(text, pixels=WIDTH - 24, size=FONT):
    """Lines that fit, at about 0.57 em a letter."""
    return textwrap.wrap(text.replace(" %", "\u00a0%"), max(10, int(pixels / (0.57 * size))), break_on_hyphens=False)


class Axis:
    """Range and ticks of values. log: powers of ten, with 2 and 5 between where there is room."""

    def __init__(self, values, log=False, low=None, high=None, pad=0.05):
        values = [v for v in values if v is not None and (not log or v > 0)] or [1.0, 10.0]
        self.log = log
        a, b = min(values), max(values)
        if log:
            a, b = math.log10(a), math.log10(b)
            if b - a < 0.5:
                a, b = (a + b) / 2 - 0.25, (a + b) / 2 + 0.25
        elif b - a <= 1e-12 * max(abs(a), abs(b), 1e-300):
            a, b = a - 0.5 * (abs(a) or 1), b + 0.5 * (abs(b) or 1)
        room = pad * (b - a)
        self.low, self.high = (a - room if low is None else low), (b + room if high is None else high)
        if log:
            self.low, self.high = 10 ** self.low if low is None else low, 10 ** self.high if high is None else high

    def at(self, v):
        """0 at the low end, 1 at the high one"""
        if self.log:
            return math.log(v / self.low) / math.log(self.high / self.low)
        return (v - self.low) / (self.high - self.low)

    def ticks(self, most=7):
        if not self.log:
            step = 10 ** math.floor(math.log10((self.high - self.low) / most))
            step *= next(k for k in (1, 2, 5, 10) if (self.high - self.low) / (k * step) <= most)
            return [(v * step, f"{v * step:.6g}") for v in range(math.ceil(self.low / step),
                math.floor(self.high / step) + 1)]
        step = max(1, math.ceil(math.log10(self.high / self.low) / most))
        found = self.decades((1,), step)
        for kinds in ((1, 3), (1, 2, 5), (1, 1.5, 2, 3, 5, 7), (1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 7, 8, 9)):
            found = self.decades(kinds, 1) if len(found) < 3 else found
        return [(v, f"{v:.6g}" if 1e-3 <= v < 1e4 else f"10^{{{e}}}" if k == 1 else f"{k:g} 10^{{{e}}}")
                for v, k, e in found]

    def decades(self, kinds, step):
        found = []
        for e in range(math.floor(math.log10(self.low)), math.ceil(math.log10(self.high)) + 1):
            if e % step == 0:
                found += [(k * 10.0 ** e, k, e) for k in kinds if self.low <= k * 10.0 ** e <= self.high]
        return found


class Panel:
    """One pair of axes. Draw with line, points, mark, text, box; then the chart lays it out."""

    def __init__(self, height, xlabel, ylabel, x, y, title="", right=12, left=80, xticks=None, yticks=None, grid=True):
        self.height, self.xlabel, self.ylabel, self.x, self.y, self.title = height, xlabel, ylabel, x, y, title
        self.left, self.right, self.grid = left, right, grid
        self.xticks, self.yticks = xticks or x.ticks(), yticks or y.ticks(max(3, int(height / 45)))
        self.series, self.before, self.names = [], [], []

    def line(self, xs, ys, style=0, name=None, width=1.5, points=True, lines=True, size=0.9, grey=None, shape=None,
             dash=None):
        """name: written at the right, beside the last point"""
        xy = [(a, b) for a, b in zip(xs, ys) if a is not None and b is not None and not (self.y.log and b <= 0)]
        if not xy:
            return
        kind = "linespoints" if points and lines else "points" if points else "lines"
        how = f"with {kind} lc rgb '{grey or GREY[style % len(GREY)]}'"
        how += f" lw {width} dt {dash or DASH[style % len(DASH)]}" if lines else f" lw {width}"
        how += f" pt {shape or POINT[style % len(POINT)]} ps {size}" if points else ""
        self.series.append((xy, how))
        if name:
            point = (f"point pt {shape or POINT[style % len(POINT)]} ps {min(size, 0.9)} "
                     f"lc rgb '{grey or GREY[style % len(GREY)]}'")
            self.names.append([self.y.at(xy[-1][1]), xy[-1], name, point if points else ""])

    def where(self, x, y):
        """In axis coordinates, inside the frame."""
        return min(max(self.x.at(x), 0), 1), min(max(self.y.at(y), 0), 1)

    def text(self, gx, gy, text, dx=0, dy=0, anchor="left", size=FONT, bold=False, rotate=0, grey="#000000"):
        """at a share of the frame, moved by pixels"""
        self.before.append(("text", gx, gy, dx, dy, text, anchor, size, bold, rotate, grey))

    def upright(self, x, dash="(3,4)", grey="#000000", top=1.0, width=1.2):
        gx = self.x.at(x)
        if 0 <= gx <= 1:
            self.before.append(("arrow", gx, 0, gx, top, dash, grey, width))

    def band(self, x0, x1, grey="#dddddd"):
        a, b = max(0, min(1, self.x.at(x0))), max(0, min(1, self.x.at(x1)))
        self.before.append(("rect", a, 0, b, 1, grey, False))

    def rect(self, x0, y0, x1, y1, grey, border=True):
        self.before.append(("rect", self.x.at(x0), self.y.at(y0), self.x.at(x1), self.y.at(y1), grey, border))

    def segment(self, x0, y0, x1, y1, dash="solid", grey="#000000", width=1.2):
        self.before.append(("arrow", self.x.at(x0), self.y.at(y0), self.x.at(x1), self.y.at(y1), dash, grey, width))


class Chart:
    def __init__(self, name, title, width=WIDTH):
        self.name, self.title, self.width, self.panels, self.notes = name, title, width, [], []

    def panel(self, *args, **kw):
        """beside=True: to the right of the one before"""
        beside = kw.pop("beside", False)
        self.panels.append((Panel(*args, **kw), beside))
        return self.panels[-1][0]

    def note(self, text, indent=0):
        """a line of the caption, wrapped"""
        lines = wrap(text, self.width - 24 - indent)
        self.notes += [(indent if i == 0 else indent + 14, t) for i, t in enumerate(lines)]

    # ---- layout in pixels from the top left ----

    def rows(self):
        rows = []
        for p, beside in self.panels:
            if beside:
                rows[-1].append(p)
            else:
                rows.append([p])
        return rows

    def script(self):
        titles = wrap(self.title, self.width - 24, 18)  # bold is wider
        top = 12 + 20 * len(titles)
        rows = self.rows()
        height = top + sum(max(p.height for p in r) for r in rows) + 8 + LINE * len(self.notes) + 8
        out = [f"set multiplot", "unset key", "set encoding utf8"]
        labels = [(12, 20 + 20 * i, t, "left", 15, True) for i, t in enumerate(titles)]
        y = height - 8 - LINE * len(self.notes) + 10
        labels += [(12 + dx, y + LINE * i, t, "left", FONT, False) for i, (dx, t) in enumerate(self.notes)]
        body = []
        for row in rows:
            share = self.width / len(row)
            for i, p in enumerate(row):
                body += self.place(p, i * share, top, share, height)
            top += max(p.height for p in row)
        out += [f"set label {i + 1} {quote(t)} at screen {x / self.width:.6f}, {1 - yy / height:.6f} {a} noenhanced "
                f"font '{',' if not b else ':Bold,'}{s}'" for i, (x, yy, t, a, s, b) in enumerate(labels)]
        # the texts of the whole are drawn with an empty plot, so that they stand there once
        out += ["set lmargin at screen 0", "set rmargin at screen 1", "set bmargin at screen 0",
                "set tmargin at screen 1", "unset border",
                "unset tics", "set xrange [0:1]", "set yrange [0:1]", "plot NaN notitle", "unset label",
                "set border 3 lw 1"]
        return "\n".join(out + body + ["unset multiplot", ""]), height

    def place(self, p, x, y, width, height):
        """gnuplot's commands for a panel whose box starts at (x, y) and is `width` wide"""
        left, right = x + p.left, x + width - p.right
        top, bottom = y + (26 if p.title else 8), y + p.height - (50 if p.xlabel else 24)
        out = [f"set lmargin at screen {left / self.width:.6f}", f"set rmargin at screen {right / self.width:.6f}",
               f"set bmargin at screen {1 - bottom / height:.6f}", f"set tmargin at screen {1 - top / height:.6f}",
               f"{'set' if p.x.log else 'unset'} logscale x", f"{'set' if p.y.log else 'unset'} logscale y",
               f"set xrange [{p.x.low:.10g}:{p.x.high:.10g}]", f"set yrange [{p.y.low:.10g}:{p.y.high:.10g}]",
               "set xtics nomirror (" + ", ".join(f"{quote(t)} {v:.10g}" for v, t in p.xticks) + ")",
               "set ytics nomirror (" + ", ".join(f"{quote(t)} {v:.10g}" for v, t in p.yticks) + ")",
               "set grid lc rgb '#cccccc' lw 0.6 dt solid" if p.grid else "unset grid",
               f"set border {3 if p.grid else 15} lw 1",
               f"set xlabel {quote(p.xlabel)} noenhanced offset 0,0.5", "unset ylabel"]
        n = 0

        def screen(gx, gy):
            return (left + gx * (right - left)) / self.width, 1 - (bottom - gy * (bottom - top)) / height

        def label(px, py, text, anchor, size, bold, rotate, grey):
            nonlocal n
            n += 1
            turn = f" rotate by {rotate}" if rotate else ""
            out.append(f"set label {n} {quote(text)} at screen {px:.6f}, {py:.6f} {anchor} noenhanced{turn} front "
                       f"textcolor rgb '{grey}' font '{':Bold,' if bold else ','}{size}'")
        if p.title:
            label(left / self.width, 1 - (y + 12) / height, p.title, "left", FONT, True, 0, "#000000")
        label((x + 13) / self.width, 1 - (top + bottom) / 2 / height, p.ylabel, "center", FONT, False, 90, "#000000")
        for i, item in enumerate(p.before):
            if item[0] == "text":
                _, gx, gy, dx, dy, text, anchor, size, bold, rotate, grey = item
                sx, sy = screen(gx, gy)
                label(sx + dx / self.width, sy + dy / height, text, anchor, size, bold, rotate, grey)
            elif item[0] == "arrow":
                _, x0, y0, x1, y1, dash, grey, lw = item
                out.append(f"set arrow {i + 1} from graph {x0:.6f}, graph {y0:.6f} to graph {x1:.6f}, graph {y1:.6f} "
                           f"nohead back "
                           f"lc rgb '{grey}' lw {lw} dt {dash}")
            else:
                _, x0, y0, x1, y1, grey, border = item
                out.append(f"set object {i + 1} rect from graph {x0:.6f}, graph {y0:.6f} to graph {x1:.6f}, graph "
                           f"{y1:.6f} behind "
                           f"fillcolor rgb '{grey}' fillstyle solid "
                           f"{'border lc rgb ' + quote('#000000') if border else 'noborder'} lw 0.6")
        # names at the right, from the top down, at least a line apart
        frame = bottom - top
        names, arrows = sorted(p.names, key=lambda e: -e[0]), len(p.before)
        ys = spread([min(max(1 - e[0], -0.02), 1.02) * frame for e in names], LINE - 2, frame)
        for k, ((_, (vx, vy), name, point), py) in enumerate(zip(names, ys)):
            label((right + (24 if point else 14)) / self.width, 1 - (top + py) / height, name, "left", FONT - 1, False,
                  0, "#000000")
            if point:
                n += 1
                out.append(f"set label {n} '' at screen {(right + 16) / self.width:.6f}, {1 - (top + py) / height:.6f} "
                           f"{point} front")
            gx, gy = p.where(vx, vy)
            sx, sy = screen(gx, gy)
            out.append(f"set arrow {arrows + k + 1} from screen {sx:.6f}, {sy:.6f} to screen "
                       f"{(right + 11) / self.width:.6f}, "
                       f"{1 - (top + py) / height:.6f} nohead back lc rgb '#999999' lw 0.6 dt solid")
        for k, (xy, _) in enumerate(p.series):
            out.append(f"$d{k} << END\n" + "\n".join(f"{a:.10g} {b:.10g}" for a, b in xy) + "\nEND")
        out.append("plot " + (", ".join(f"$d{k} using 1:2 {how} notitle" for k, (_, how) in enumerate(p.series))
                              or "NaN notitle"))
        return out + ["unset label", "unset arrow", "unset object"]

    def write(self, folder):
        script, height = self.script()
        base = os.path.join(folder, self.name)
        heads = [(f"set terminal svg size {self.width},{height:.0f} fixed enhanced font 'sans-serif,{FONT}' background "
                  f"'#ffffff'", ".svg"),
                 (f"set terminal pngcairo size {self.width},{height:.0f} enhanced font 'DejaVu Sans,{FONT * 0.78:.1f}'",
                  ".png")]
        for head, end in heads:
            if end == ".svg":
                body = script.replace("font ':Bold,", "font 'sans-serif:Bold,")
            else:  # cairo's sizes are points
                body = re.sub(r"font '(:Bold)?,(\d+)'", lambda m: f"font '{m[1] or ''},{int(m[2]) * 0.78:.1f}'", script)
            text = f"set output {quote(base + '.tmp')}\n" + body + "set output\n"
            done = subprocess.run(["gnuplot"], input=head + "\n" + text, text=True, stderr=subprocess.PIPE)
            if done.returncode or done.stderr.strip():
                if os.path.exists(base + ".tmp"):
                    os.remove(base + ".tmp")
                sys.exit(f"charts: gnuplot could not make {base}{end}: {done.stderr.strip()}")
            (in_grey if end == ".png" else tidied)(base + ".tmp")
            os.replace(base + ".tmp", base + end)


def tidied(path):
    """An SVG without blank lines and indents, and with bold letters as SVG has them: gnuplot 5.4 makes them a family's
    name."""
    with open(path) as f:
        lines = [line.strip().replace('font-family="sans-serif:Bold"', 'font-family="sans-serif" font-weight="bold"')
                 for line in f]
    with open(path, "w") as f:
        f.write("\n".join(line for line in lines if line) + "\n")


def in_grey(path):
    """Rewrites a PNG of eight bits a channel, all channels equal, as one of sixteen greys: a fourth of the bytes or
    less."""
    with open(path, "rb") as f:
        data = f.read()
    at, packed, width, height, channels = 8, b"", 0, 0, 0
    while at < len(data):
        n, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", data[at + 8:at + 18])
            channels = {2: 3, 6: 4}.get(colour, 0) if depth == 8 else 0
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + n]
        at += 12 + n
    if not channels:
        return
    raw, last, out = zlib.decompress(packed), bytes(width), []
    for y in range(height):
        start = y * (width * channels + 1)
        last = unfilter(raw[start], raw[start + 1:start + 1 + width * channels:channels], last)
        row = last + b"\xff" * (width % 2)
        out.append(b"\0" + bytes((a * 15 + 127) // 255 << 4 | (b * 15 + 127) // 255
                                 for a, b in zip(row[::2], row[1::2])))

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    with open(path, "wb") as f:
        f.write(data[:8] + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 4, 0, 0, 0, 0)) +
                chunk(b"IDAT", zlib.compress(b"".join(out), 9)) + chunk(b"IEND", b""))


def unfilter(kind, row, above):
    """One channel of a row of a PNG (its filters 0 to 4 work on each channel by itself)."""
    if kind == 0:
        return bytes(row)
    if kind == 2:
        return bytes((a + b) & 255 for a, b in zip(row, above))
    out, left, corner = bytearray(len(row)), 0, 0
    for i, (v, up) in enumerate(zip(row, above)):
        if kind == 1:
            guess = left
        elif kind == 3:
            guess = (left + up) // 2
        else:
            a, b, c = abs(up - corner), abs(left - corner), abs(left + up - 2 * corner)
            guess = left if a <= b and a <= c else up if b <= c else corner
        out[i] = left = (v + guess) & 255
        corner = up
    return bytes(out)


def spread(wanted, least, frame):
    """Places in order, at least `least` apart, as near to the wanted ones as that allows, from the frame's top on."""
    ys = []
    for w in wanted:
        ys.append(max(w, ys[-1] + least) if ys else w)
    if ys and ys[-1] > frame + 20:  # push up from the bottom
        ys[-1] = max(frame + 20, 0)
        for i in range(len(ys) - 2, -1, -1):
            ys[i] = min(ys[i], ys[i + 1] - least)
    return ys
