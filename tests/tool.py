#!/usr/bin/env python3
# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""tool.py: the program `sph` as its users meet it: full disks, links, broken dumps, names with anything in them.

usage: tool.py [--tool build/sph] [--only WORD]      make tool-test

Each function below is a test whose name says what must hold; it runs in an empty folder of its own. Needs Python alone.
Exit code 1 if one fails or none ran."""
import argparse, base64, os, pathlib, resource, signal, struct, subprocess, sys, tempfile, time, traceback, zlib
import xml.etree.ElementTree as xml

TOOL = ""
MIB = 1 << 20


class Said:
    """what a call of the tool gave: code, out, err"""

    def __init__(self, done):
        self.code, self.out, self.err = done.returncode, done.stdout, done.stderr

    def __repr__(self):
        return f"code {self.code}\nstdout {self.out[-1500:]}\nstderr {self.err[-1500:]}"


def limit(file_size=None, memory=None):
    def set_limits():
        if file_size is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (file_size, file_size))
        if memory is not None:
            resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    return set_limits


def sph(*words, limits=None, stdout=None, env=None, cwd=None):
    done = subprocess.run([TOOL, *words], stdout=stdout or subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          errors="replace", timeout=60, preexec_fn=limits, env=env, cwd=cwd)
    done.stdout = done.stdout or ""
    return Said(done)


def fine(said):
    assert said.code == 0, said
    return said


def refused(said, *words, code=None):
    """a message with all these words; no signal, no success"""
    assert said.code > 0 and (code is None or said.code == code), said
    for word in words:
        assert word in said.err, f"no {word!r} in: {said}"
    return said


DAM = ("dam_break", "n=8", "sound=20")


def dam(*words, **more):
    return sph("run", *DAM, *words, **more)


def rows(name):
    return [line for line in pathlib.Path(name).read_text().splitlines() if line[0] not in "#t"]


def files():
    return sorted(p.name for p in pathlib.Path(".").iterdir())


# ---- full disks ----

def a_dump_that_does_not_fit_is_said_with_its_reason():
    os.symlink("/dev/full", "a_0001.sph")
    refused(dam("end=0.02", "every=0.01", "out=a"), "a_0001.sph", "No space left on device")
    assert os.path.getsize("a_0000.sph") > 1000
    assert len(rows("a.csv")) == 1  # no row of the dump that is not there


def a_history_that_does_not_fit_keeps_its_whole_rows():
    said = dam("end=0.2", "frames=100", "out=a", "dump=none", limits=limit(file_size=4096))
    refused(said, "a.csv", "File too large")
    text = pathlib.Path("a.csv").read_text()
    assert text.startswith("# scene dam_break") and text.endswith("\n") and len(rows("a.csv")) > 10
    assert len({row.count(",") for row in rows("a.csv")}) == 1
    assert files() == ["a.csv"]


def a_history_on_a_full_disk_ends_the_run():
    os.symlink("/dev/full", "a.csv")
    refused(dam("end=0.02", "out=a", "dump=none"), "a.csv", "No space left on device")


def rows_to_a_full_disk_end_the_run():
    with open("/dev/full", "w") as full:
        refused(dam("end=0.02", stdout=full), "standard output", "No space left on device")


def an_interrupted_run_names_no_state_that_is_not_there():
    run = subprocess.Popen([TOOL, "run", *DAM, "end=1000", "out=a", "dump=none"], stderr=subprocess.PIPE, text=True,
                           stdout=subprocess.PIPE, preexec_fn=limit(file_size=2000))
    for _ in range(100):
        time.sleep(0.05)
        if os.path.exists("a.csv"):
            break
    time.sleep(0.3)
    run.send_signal(signal.SIGINT)
    _, err = run.communicate(timeout=60)
    assert run.returncode > 0 and "interrupted at" in err, err
    assert "the state is in" not in err and "File too large" in err, err
    assert "a_interrupted.sph" not in files()


def text_on_a_full_disk_is_a_failure():
    for words in (("--version",), ("help",), ("run", "--help"), ("list",), ("list", "csv"), ("render", "--help")):
        with open("/dev/full", "w") as full:
            refused(sph(*words, stdout=full), "standard output", "No space left on device")


def pictures_and_tables_on_a_full_disk_are_failures():
    fine(dam("end=0.01", "frames=2", "out=a"))
    for k, words in enumerate((("render", "a_0001.sph", "out=x.png"), ("export", "a_0001.sph", "out=x.vtu"),
                               ("export", "a_0001.sph", "out=x.csv"), ("history", "a.csv", "out=x.csv"),
                               ("history", "a.csv", "plot=x.png"), ("dispersion", "curve", "out=x.csv"),
                               ("gradykipp", "out=x.csv"), ("gradykipp", "plot=x.png"),
                               ("profile", "a_0001.sph", "field=speed", "from=0,0.01", "to=0.05,0.01", "out=x.csv"))):
        name = words[-1].split("=")[1]
        if os.path.islink(name):
            os.remove(name)
        os.symlink("/dev/full", name)
        refused(sph(*words, env=with_gnuplot()), name, "No space left on device")


# ---- gauges ----

def gauges_and_probes_are_columns_of_any_scene():
    fine(dam("steps=1", "out=a", "dump=none", "gauge=0.02/0.04", "probe=0.02,0.01/0.04,0.03"))
    lines = pathlib.Path("a.csv").read_text().splitlines()
    names, first = lines[1].split(","), dict(zip(lines[1].split(","), map(float, lines[2].split(","))))
    assert names[-14:-8] == [f"{w}_at_{x}_m" for x in ("0.02", "0.04") for w in ("surface", "top", "depth")], names
    assert names[-8:-4] == [f"{w}_at_0.02;0.01_{u}" for w, u in (("pressure", "Pa"), ("vx", "m/s"), ("vy", "m/s"),
                                                                 ("cover", "-"))], names
    for name, value in (("surface_at_0.02_m", 0.0572), ("depth_at_0.02_m", 0.0572), ("cover_at_0.02;0.01_-", 1)):
        assert abs(first[name] / value - 1) < 0.05, (name, first[name])
    assert abs(first["top_at_0.04_m"] - first["surface_at_0.04_m"]) < 1e-6


def gauges_go_on_with_a_history_that_has_them():
    part = ("dump=full", "every=0.005", "out=a", "gauge=0.02")
    fine(dam("end=0.01", *part))
    refused(dam("end=0.02", "dump=full", "every=0.005", "out=a", "restore=a_0002.sph"), "other columns")
    fine(dam("end=0.02", *part, "restore=a_0002.sph"))
    assert len(rows("a.csv")) == 5


def places_of_gauges_that_are_no_places_are_refused():
    for words in (("gauge=a",), ("gauge=",), ("gauge=0.1,0.2",), ("gauge=0.1/",), ("probe=0.1",), ("probe=1,2,3",),
                  ("gauge=" + "/".join("0.1" for _ in range(17)),),
                  ("probe=" + "/".join("0.1,0.1" for _ in range(13)),), ("gauge=0.1", "gauge=0.2")):
        refused(dam("steps=1", "out=a", *words), words[0].split("=")[0], code=2)
    refused(sph("run", "hydrostatic", "gauge=1"), "one dimension", code=2)
    for words, said in (("gauge=99", "x = 99 is out of the domain"), ("probe=0.01,7", "y = 7 is out of the domain")):
        refused(dam("steps=1", "out=b", "dump=none", words), said, code=1)
    assert not files()


# ---- going on ----

def state(name):
    """of a dump: bytes"""
    return pathlib.Path(name).read_bytes()


def a_run_that_goes_on_goes_on_with_its_history():
    part = ("dump=full", "every=0.005", "out=a")
    fine(dam("end=0.02", *part))
    before, dumps = pathlib.Path("a.csv").read_text(), {f: state(f) for f in files() if f.endswith(".sph")}
    fine(dam("end=0.04", *part, "restore=a_0004.sph"))
    after = pathlib.Path("a.csv").read_text()
    assert after.startswith(before) and len(rows("a.csv")) == 9
    assert all(state(f) == dumps[f] for f in dumps)
    assert [f for f in files() if f.endswith(".sph")] == [f"a_{k:04d}.sph" for k in range(9)]
    fine(sph("history", "a.csv"))  # times rise


def an_interrupted_run_that_goes_on_is_the_run_without_a_break():
    fine(dam("end=0.2", "every=0.02", "out=whole", "dump=full"))
    run = subprocess.Popen([TOOL, "run", *DAM, "end=0.2", "every=0.02", "out=a", "dump=full", "threads=1"],
                           stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    while run.poll() is None and not os.path.exists("a_0002.sph"):
        time.sleep(0.001)
    run.send_signal(signal.SIGINT)
    run.communicate(timeout=60)
    if run.returncode == 0:  # it was over before the signal came
        return
    fine(dam("end=0.2", "every=0.02", "out=a", "dump=full", "restore=a_interrupted.sph"))
    assert pathlib.Path("a.csv").read_text() == pathlib.Path("whole.csv").read_text()
    for k in range(11):
        assert state(f"a_{k:04d}.sph") == state(f"whole_{k:04d}.sph"), k


def dumps_of_both_parts_stand_whatever_their_distance():
    fine(dam("end=0.02", "every=0.002", "out=a", "dump=full"))
    dumps = {f: state(f) for f in files() if f.endswith(".sph")}
    fine(dam("end=0.04", "every=0.01", "out=a", "dump=full", "restore=a_0010.sph"))
    assert all(state(f) == dumps[f] for f in dumps)
    assert len([f for f in files() if f.endswith(".sph")]) == len(dumps) + 2


def a_history_that_went_farther_is_not_cut():
    fine(dam("end=0.02", "every=0.005", "out=a", "dump=full"))
    before = {f: state(f) for f in files()}
    refused(dam("end=0.03", "every=0.005", "out=a", "dump=full", "restore=a_0002.sph"), "out=a", "0.02", "0.01")
    assert {f: state(f) for f in files()} == before


def the_history_of_another_run_is_not_gone_on_with():
    fine(dam("end=0.01", "out=a", "dump=full"))
    pathlib.Path("b.csv").write_text("# scene rings, 2-D, float\ntime\n0\n")
    refused(dam("end=0.02", "out=b", "restore=a_0020.sph"), "b.csv", "rings")
    assert pathlib.Path("b.csv").read_text().endswith("\n0\n")


def options_that_may_change_are_applied():
    fine(dam("end=0.01", "frames=1", "out=a", "dump=full"))
    fine(dam("end=0.02", "frames=2", "out=b", "dump=full", "restore=a_0001.sph", "dt=1e-4", "damping=0.999"))
    info = fine(sph("info", "b_0002.sph")).out
    assert "dt               0.0001" in info and "dt_fixed         0.0001" in info and "damping          0.999" in info
    assert "dt=0.0001" in pathlib.Path("b.csv").read_text().splitlines()[0]
    # not given: as in the dump
    fine(dam("end=0.03", "frames=3", "out=c", "restore=b_0002.sph"))
    assert "dt=0.0001" in pathlib.Path("c.csv").read_text().splitlines()[0]
    fine(dam("end=0.03", "frames=3", "out=d", "restore=b_0002.sph", "dt=0", "damping=1"))
    assert "dt=" not in pathlib.Path("d.csv").read_text().splitlines()[0]
    assert "step set by    fixed" not in fine(dam("end=0.03", "restore=b_0002.sph", "dt=0", "out=e", "dump=none")).out


def a_damping_that_is_over_is_refused():
    fine(dam("steps=20", "out=a", "dump=full", "damping=0.99", "damp_steps=10"))
    last = max(f for f in files() if f.endswith(".sph"))
    more = ("steps=5", "restore=" + last, "hash")
    refused(dam("damping=0.98", "damp_steps=10", *more), "damping=0.98", "damp_steps=10", "step 20")
    fine(dam("damp_steps=10", *more))
    a, b = (fine(dam("damping=0.98", "damp_steps=30", *more)).out, fine(dam("damp_steps=30", *more)).out)
    assert a != b


def what_differs_from_a_dump_is_said_by_name_and_value():
    fine(dam("end=0.01", "frames=1", "out=a", "dump=full"))
    fine(dam("end=0.01", "frames=1", "out=p"))
    refused(sph("run", "dam_break", "n=9", "sound=20", "restore=a_0001.sph"), "n: 8 in the dump, 9 here")
    refused(dam("alpha=0.02", "restore=a_0001.sph"), "alpha: 0.01 in the dump, 0.02 here")
    refused(dam("wall=ghost", "restore=a_0001.sph"), "wall: adami in the dump, ghost here")
    refused(sph("run", "still_tank", "restore=a_0001.sph"), "scene: dam_break in the dump, still_tank here")
    refused(sph("run", "dam_break_3d", "restore=a_0001.sph"), "dimension: 2 in the dump, 3")
    refused(dam("precision=double", "restore=a_0001.sph"), "precision: float in the dump, double here")
    refused(dam("restore=p_0001.sph"), "reduced dump", "dump=full")
    refused(dam("restore=nowhere.sph"), "nowhere.sph", "No such file")
    # a dump of another program carries no notes: its records say it
    pathlib.Path("b.sph").write_bytes(without_notes(state("a_0001.sph")))
    refused(sph("run", "dam_break", "n=9", "sound=20", "restore=b.sph"), "max_particles", "spacing", "here")
    fine(dam("restore=b.sph", "end=0.02", "hash"))


# ---- dumps with right checksums and wrong contents ----

def without_notes(data):
    return data[:struct.unpack_from("<Q", data, 16)[0]]


class Dump:
    """sections of a dump that can be changed; put together with right checksums"""

    def __init__(self, name):
        data = without_notes(state(name))
        self.head, self.section, at = bytearray(data[:32]), [], 32
        while at < len(data):
            size = struct.unpack_from("<Q", data, at + 48)[0]
            self.section.append([bytearray(data[at:at + 64]), bytearray(data[at + 64:at + 64 + size])])
            at += 64 + size + 4

    def find(self, name):
        return next(s for s in self.section if s[0][:16].rstrip(b"\0") == name.encode())

    def member(self, record, field, value, comp=0, code="<d"):
        """sets a member of a record's only row"""
        head, data = self.find(record)
        fields, at = struct.unpack_from("<I", head, 36)[0], 0
        for f in range(fields):
            d = data[32 * f:32 * f + 32]
            if d[:16].rstrip(b"\0") == field.encode():
                struct.pack_into(code, data, 32 * fields + 8 * (at + comp), value)
                return
            at += d[29]
        raise KeyError(field)

    def bytes(self):
        body, last = b"", self.section[-1]
        size = 32 + sum(68 + len(d) for _, d in self.section)
        struct.pack_into("<QI", self.head, 16, size, len(self.section))
        struct.pack_into("<I", self.head, 28, zlib.crc32(self.head[:28]))
        chain = zlib.crc32(self.head[28:32])
        for k, s in enumerate(self.section):
            head, data = s
            if s is last:
                data[:] = struct.pack("<I", chain)
            struct.pack_into("<Q", head, 48, len(data))
            struct.pack_into("<I", head, 56, k)
            struct.pack_into("<I", head, 60, zlib.crc32(head[:60]))
            crc = struct.pack("<I", zlib.crc32(data))
            chain = zlib.crc32(crc, zlib.crc32(head[60:64], chain))
            body += head + data + crc
        return bytes(self.head) + body

    def write(self, name):
        pathlib.Path(name).write_bytes(self.bytes())


def make_dump():
    fine(dam("end=0.01", "frames=1", "out=a", "dump=full"))
    return Dump("a_0001.sph")


def dumps_put_together_here_are_sound():
    d = make_dump()
    d.write("b.sph")
    fine(sph("verify", "b.sph", "a_0001.sph"))
    fine(sph("diff", "b.sph", "a_0001.sph"))


def an_id_of_all_ones_writes_nowhere():
    d = make_dump()
    d.find("id")[1][:4] = b"\xff" * 4
    d.write("b.sph")
    line = ("field=displacement_x", "from=0,0.01", "to=0.05,0.01")
    fine(sph("profile", "a_0001.sph", "reference=b.sph", *line, limits=limit(memory=512 * MIB)))
    refused(sph("verify", "b.sph"), "id 4294967295")


def an_array_that_comes_twice_is_refused_by_name():
    d = make_dump()
    twice = [bytearray(d.find("vel")[0]), bytearray(b"\0" * 4)]
    struct.pack_into("<IQ", twice[0], 36, 1, 1)
    d.section.insert(0, twice)
    d.write("b.sph")
    for words in (("diff", "a_0001.sph", "b.sph"), ("diff", "b.sph", "a_0001.sph"), ("verify", "b.sph"),
                  ("info", "b.sph")):
        refused(sph(*words), "twice", "vel")


def an_array_that_is_too_short_is_refused_by_name():
    d = make_dump()
    more = [bytearray(d.find("vel")[0]), bytearray(b"\0" * 4)]
    more[0][:16] = b"colour".ljust(16, b"\0")
    struct.pack_into("<IQ", more[0], 36, 1, 1)
    d.section.insert(len(d.section) - 1, more)
    d.write("b.sph")
    refused(sph("diff", "b.sph", "b.sph"), "colour")


def memory_is_bounded_by_the_size_of_a_dump():
    d = make_dump()
    d.member("scene", "max_particles", 4294967295, code="<Q")
    d.write("b.sph")
    fine(sph("verify", "b.sph", limits=limit(memory=512 * MIB)))


def numbers_no_run_can_have_are_refused_by_name():
    for record, field, value, code in (("state", "time", 1e300, "<d"), ("state", "time", -1e300, "<d"),
                                       ("state", "time", float("nan"), "<d"), ("scene", "spacing", 0.0, "<d"),
                                       ("scene", "lo", -1e300, "<d"), ("scene", "hi", float("inf"), "<d"),
                                       ("scene", "quantum", float("nan"), "<d"), ("sets", "role", 77, "<Q")):
        d = make_dump()
        d.member(record, field, value, code=code)
        d.write("b.sph")
        for words in (("verify", "b.sph"), ("render", "b.sph", "out=b.png"), ("export", "b.sph", "out=b.csv")):
            refused(sph(*words), field)
        refused(dam("restore=b.sph"), field)


def a_particle_far_outside_is_refused():
    d = make_dump()
    d.find("pos")[1][:4] = b"\xff\xff\xff\x7f"
    d.member("scene", "quantum", 1e20)
    d.write("b.sph")
    refused(sph("render", "b.sph", "out=b.png"), "far outside the domain")


def notes_must_be_notes():
    make_dump()
    data = state("a_0001.sph")
    n = len(without_notes(data))
    for tail in (b"x", data[n:] + b"x", data[n:-1], data[n:n + 70] + b"\x1b" + data[n + 71:]):
        pathlib.Path("b.sph").write_bytes(data[:n] + tail)
        refused(sph("info", "b.sph"), "b.sph")


# ---- names ----

def with_gnuplot():
    """an environment whose gnuplot does what lines of its script say that begin with !, and gives a picture"""
    if not os.path.exists("bin/gnuplot"):
        os.mkdir("bin")
        pathlib.Path("bin/gnuplot").write_text("#!/bin/sh\nsed -n 's/^!//p' >bin/todo; sh bin/todo\n"
                                               "printf '\\211PNG\\r\\n'\n")
        os.chmod("bin/gnuplot", 0o755)
    return dict(os.environ, PATH="bin:" + os.environ["PATH"])


def nothing_of_a_name_reaches_gnuplot_as_a_command():
    evil = "x\n!touch done\n"
    pathlib.Path(evil + ".csv").write_text("time,a\n0,1\n1,2\n")
    pathlib.Path("column.csv").write_text("time,a'\r!touch done\rsystem('touch done')\n0,1\n1,2\n")
    fine(sph("history", evil + ".csv", "plot=p.png", env=with_gnuplot()))
    fine(sph("history", "column.csv", "plot=p.png", env=with_gnuplot()))
    fine(sph("history", "column.csv", "plot=" + evil + ".png", env=with_gnuplot()))
    fine(sph("history", "column.csv", "columns=time:'\n!touch done\n',a'\r!touch done\rsystem('touch done')",
             "plot=p.png", env=with_gnuplot()))
    assert "done" not in files() and evil + ".png" in files()
    if any(os.access(os.path.join(p, "gnuplot"), os.X_OK) for p in os.environ["PATH"].split(":")):
        fine(sph("history", evil + ".csv", "plot=real.png"))
        fine(sph("history", "column.csv", "plot=real.png"))
        assert "done" not in files() and state("real.png").startswith(b"\x89PNG")


def a_plot_without_gnuplot_is_refused_and_leaves_nothing():
    pathlib.Path("h.csv").write_text("time,a\n0,1\n1,2\n")
    refused(sph("history", "h.csv", "plot=p.png", "out=o.csv", env=dict(os.environ, PATH="/nowhere")), "needs gnuplot")
    assert files() == ["h.csv"]


# ---- what is there already ----

def nothing_is_touched_when_an_output_cannot_be_opened():
    fine(dam("end=0.01", "out=a", "dump=none", "stage_log=s.log", "cost=c.csv"))
    before = {f: state(f) for f in files()}
    for more in (("cost=no/where",), ("stage_log=no/where",), ("restore=nowhere",), ("dt=-1",), ("smooth=1",),
                 ("cost=s.log",), ("cost=a.csv",), ("cost=.",)):
        given = [w for w in ("stage_log=s.log", "cost=c.csv") if w.split("=")[0] != more[0].split("=")[0]]
        refused(dam("end=0.02", "out=a", "dump=none", *given, *more), more[0].split("=")[more[0] == "restore=nowhere"])
        assert {f: state(f) for f in files()} == before, more


def two_outputs_are_not_one_file():
    os.symlink("a.csv", "link")
    refused(dam("end=0.01", "out=a", "cost=./link"), "out=a.csv", "cost=./link", "same file")


def links_are_written_through():
    os.mkdir("far")
    pathlib.Path("far/old.csv").write_text("old\n")
    os.symlink("far/old.csv", "a.csv")
    os.symlink("far/new.png", "p.png")
    fine(dam("end=0.01", "frames=1", "out=a"))
    fine(sph("render", "a_0001.sph", "out=p.png"))
    assert os.path.islink("a.csv") and os.path.islink("p.png")
    assert pathlib.Path("far/old.csv").read_text().startswith("# scene")
    assert state("far/new.png").startswith(b"\x89PNG")


def devices_are_written_to():
    fine(dam("end=0.01", "frames=1", "out=a"))
    os.mkfifo("pipe.csv")
    reader = subprocess.Popen(["cat", "pipe.csv"], stdout=subprocess.PIPE, text=True)
    fine(sph("history", "a.csv", "out=pipe.csv"))
    assert reader.communicate(timeout=20)[0].startswith("# scene")
    assert not os.path.isfile("pipe.csv")
    # by links of this folder: a tool that replaced devices would do so to those of the machine
    os.symlink("/dev/stdout", "screen")
    said = fine(dam("end=0.01", "out=a", "dump=none", "cost=screen"))
    assert "name,value,unit" in said.out and "hash" in said.out
    with open("said", "w") as f:
        fine(dam("end=0.01", "out=a", "dump=none", "cost=screen", stdout=f))
    assert "name,value,unit" in pathlib.Path("said").read_text() and "hash" in pathlib.Path("said").read_text()


def no_file_of_the_users_is_lost():
    for name in ("a.csv.tmp", "a_0000.sph.tmp", "p.png.tmp"):
        pathlib.Path(name).write_text("mine\n")
    fine(dam("end=0.01", "frames=1", "out=a"))
    fine(sph("render", "a_0001.sph", "out=p.png"))
    for name in ("a.csv.tmp", "a_0000.sph.tmp", "p.png.tmp"):
        assert pathlib.Path(name).read_text() == "mine\n"
    assert not [f for f in files() if f.startswith(".sph")]


def a_command_that_is_ended_leaves_nothing():
    os.mkfifo("h.csv")  # nobody writes: the command waits with its output open
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        # whoever started the tests may have had it ignored, as nohup has SIGHUP
        run = subprocess.Popen([TOOL, "history", "h.csv", "out=o.csv"], stderr=subprocess.PIPE, stdout=subprocess.PIPE,
                               preexec_fn=lambda: signal.signal(number, signal.SIG_DFL))
        for _ in range(100):
            if len(files()) > 1:
                break
            time.sleep(0.02)
        assert len(files()) == 2
        run.send_signal(number)
        run.communicate(timeout=20)
        assert run.returncode == -number and files() == ["h.csv"]


def modes_of_files_are_kept():
    pathlib.Path("a.csv").write_text("old\n")
    os.chmod("a.csv", 0o640)
    fine(dam("end=0.01", "frames=1", "out=a"))
    assert os.stat("a.csv").st_mode & 0o777 == 0o640


def a_series_is_written_whole_or_not_at_all():
    fine(dam("end=0.01", "frames=2", "out=a"))
    pathlib.Path("bad.sph").write_bytes(state("a_0000.sph")[:-200])
    pathlib.Path("x_0000.png").write_text("old\n")
    before = files()
    for words in (("render", "out=x.png"), ("export", "out=x.pvd")):
        refused(sph(words[0], "a_0000.sph", "a_0001.sph", "bad.sph", words[1]), "bad.sph")
        assert files() == before and state("x_0000.png") == b"old\n"


# ---- bounds ----

def views_that_numbers_cannot_tell_apart_are_refused():
    fine(dam("end=0.01", "frames=1", "out=a"))
    for view in ("1e17,1.0000000000000002e17,0,1", "0,1,1e300,1.1e300", "0,1e300,0,1", "0,1,5,5.0000000000000009",
                 "-1e308,1e308,0,1", "0,1e-320,0,1e-320"):
        said = sph("render", "a_0001.sph", "out=p.png", "view=" + view)
        refused(said, "view=") if view != "0,1e-320,0,1e-320" else None
    fine(sph("render", "a_0001.sph", "out=p.png", "view=0,1e20,0,1"))
    fine(sph("render", "a_0001.sph", "out=p.png", "view=0,1e-12,0,1e-12"))
    for words in (("min=1e301",), ("max=-1e301",), ("min=1", "max=1.0000000000000002")):
        refused(sph("render", "a_0001.sph", "out=p.png", *words), words[-1].split("=")[0])


def values_no_picture_can_show_are_refused():
    d = make_dump()
    fluid = d.find("set")[1].index(0)
    for value, said in ((float("inf"), "inf"), (float("nan"), "nan"), (3e38, "e+38")):
        d.find("vel")[1][4 * fluid:4 * fluid + 4] = struct.pack("<f", value)
        d.write("b.sph")
        refused(sph("render", "b.sph", "out=p.png"), "speed", said)


def rows_beyond_counting_are_refused():
    refused(dam("every=1e-30", "out=a"), "every=1e-30", "allowed")
    refused(dam("end=1e300"), "end=1e300")
    assert files() == []


# ---- ParaView ----

def read_vtu(name):
    """the XML part, and arrays by name"""
    data = state(name)
    mark = b'<AppendedData encoding="raw">\n_'
    at = data.find(mark)
    tree = xml.fromstring(data[:at] + b"</VTKFile>" if at > 0 else data)
    code = {"Float32": "f", "Float64": "d", "UInt8": "B", "UInt32": "I", "Int32": "i", "Int64": "q"}
    arrays = {}
    for a in tree.iter("DataArray"):
        if a.get("format") == "ascii":
            arrays[a.get("Name")] = a.text.split()
            continue
        p = at + len(mark) + int(a.get("offset"))
        if tree.get("compressor"):
            blocks, size, last = struct.unpack_from("<3Q", data, p)
            sizes, p, raw = struct.unpack_from(f"<{blocks}Q", data, p + 24), p + 24 + 8 * blocks, b""
            for k, n in enumerate(sizes):
                piece = zlib.decompress(data[p:p + n])
                assert len(piece) == (last if k == blocks - 1 and last else size)
                raw, p = raw + piece, p + n
        else:
            raw = data[p + 8:p + 8 + struct.unpack_from("<Q", data, p)[0]]
        kind = code[a.get("type")]
        arrays[a.get("Name")] = struct.unpack(f"<{len(raw) // struct.calcsize(kind)}{kind}", raw)
    return tree, arrays


def close(a, b, within):
    return abs(a - b) <= within * max(abs(a), abs(b), 1e-30)


def paraview_opens_a_dump_coloured():
    fine(dam("end=0.01", "frames=1", "out=a"))
    fine(sph("export", "a_0001.sph", "out=a.vtu"))
    fine(sph("export", "a_0001.sph", "out=b.vtu", "encoding=ascii"))
    fine(sph("export", "a_0001.sph", "out=t.csv"))
    tree, array = read_vtu("a.vtu")
    points = tree.find(".//PointData")
    assert points.get("Scalars") == "speed_m_per_s" and points.get("Vectors") == "velocity_m_per_s"
    types = {a.get("Name"): a.get("type") for a in tree.iter("DataArray")}
    assert types["velocity_m_per_s"] == types["position_m"] == "Float32" and types["connectivity"] == "Int32"
    n = int(tree.find(".//Piece").get("NumberOfPoints"))
    assert len(array["position_m"]) == 3 * n and list(array["connectivity"]) == list(range(n))
    assert set(array["role"]) == {0, 1} and {"mass_kg_per_m", "spacing_m", "set"} <= set(array)
    names = "".join(chr(int(c)) for c in array["set_names"]).split("\0")
    assert names[0].startswith("0: fluid, rest density 1000 kg/m^3") and "ghost wall" in names[-2]
    assert "".join(chr(int(c)) for c in array["role_names"]).split("\0")[:2] == ["fluid", "ghost wall"]
    lines = [line.split(",") for line in pathlib.Path("t.csv").read_text().splitlines()[1:]]
    speed = lines[0].index("speed_m_per_s")
    _, text = read_vtu("b.vtu")
    for i in range(n):
        assert close(array["speed_m_per_s"][i], float(lines[1 + i][speed]), 1e-6)
        assert close(array["position_m"][3 * i], float(lines[1 + i][0]), 1e-6)
        assert close(array["speed_m_per_s"][i], float(text["speed_m_per_s"][i]), 1e-8)


def a_run_in_double_is_exported_in_double():
    fine(dam("end=0.01", "frames=1", "out=a", "precision=double"))
    fine(sph("export", "a_0001.sph", "out=a.vtu"))
    tree, _ = read_vtu("a.vtu")
    types = {a.get("Name"): a.get("type") for a in tree.iter("DataArray")}
    assert types["position_m"] == types["mass_kg_per_m"] == "Float64"


def files_for_paraview_are_small():
    fine(sph("run", "dam_break", "n=60", "end=0.01", "frames=1", "out=a"))
    fine(sph("export", "a_0001.sph", "out=a.vtu", "walls=no"))
    tree, _ = read_vtu("a.vtu")
    each = os.path.getsize("a.vtu") / int(tree.find(".//Piece").get("NumberOfPoints"))
    assert each < (40 if tree.get("compressor") else 75), each


def names_in_a_collection_are_escaped():
    fine(dam("end=0.01", "frames=1", "out=a"))
    name = 'x&y<z>"q\'\n1'
    fine(sph("export", "a_0000.sph", "a_0001.sph", f"out={name}.pvd"))
    sets = list(xml.parse(f"{name}.pvd").getroot().iter("DataSet"))
    assert [s.get("file") for s in sets] == [f"{name}_0000.vtu", f"{name}_0001.vtu"]
    assert all(os.path.exists(s.get("file")) for s in sets)
    refused(sph("export", "a_0000.sph", "out=x\x01.pvd"), "out=", code=2)


# ---- units ----

def a_scene_names_its_units_and_its_dumps_carry_them():
    words = ("rings", "dp=0.5", "duration=5", "frames=2")
    said = fine(sph("run", *words, "out=r")).out
    assert " cm/c0," in said and "K.cm^2" in said and " J" not in said and " m/s" not in said and "kg" not in said
    info, _, notes = fine(sph("info", "r_0002.sph")).out.partition("\nnotes\n")
    assert "5 cm/c0" in info and "spacing          0.5 cm\n" in info and " Pa" not in info and " kg" not in info
    assert "scene=rings" in notes and "param dp=0.5" in notes and "unit kg=rho0.cm^2" in notes
    fine(sph("export", "r_0002.sph", "out=r.vtu"))
    _, array = read_vtu("r.vtu")
    assert {"position_cm", "velocity_c0", "density_rho0", "pressure_K", "mass_rho0_cm2"} <= set(array), array.keys()
    fine(sph("profile", "r_0002.sph", "field=speed", "from=-4,0.1", "to=4,0.1", "out=p.csv"))
    assert pathlib.Path("p.csv").read_text().startswith("time_cm/c0,s_cm,x_cm,y_cm,speed")
    listed = fine(sph("list", "rings")).out
    assert "lengths cm, times cm/c0" in listed


def energies_in_the_plane_are_those_of_a_metre():
    said = fine(dam("end=0.01", "out=a")).out
    assert "J/m" in said and " J\n" not in said
    assert "W/m" in fine(sph("info", "a_0020.sph")).out
    said = fine(sph("run", "dam_break_3d", "n=4", "end=0.01", "out=b")).out
    assert " J\n" in said and "J/m" not in said


def what_is_not_kept_is_not_printed():
    said = fine(dam("end=0.01", "frames=1", "out=a", "books=no", "dump=full")).out
    assert "dissipated" not in said and "not kept" in said
    assert "dissipated" not in pathlib.Path("a.csv").read_text() and "kinetic" in pathlib.Path("a.csv").read_text()
    assert "not kept" in fine(sph("info", "a_0001.sph")).out
    said = fine(dam("end=0.01", "frames=1", "out=b", "books=yes")).out
    assert "dissipated" in said and "dissipated" in pathlib.Path("b.csv").read_text()


# ---- arguments and tables ----

def a_name_that_is_given_twice_is_refused():
    fine(dam("end=0.01", "frames=1", "out=a"))
    for words in (("run", *DAM, "end=0.01", "end=0.02"), ("run", *DAM, "alpha=1", "alpha=1"),
                  ("run", *DAM, "precision=float", "precision=double"),
                  ("render", "a_0001.sph", "out=p.png", "out=q.png"),
                  ("export", "a_0001.sph", "out=p.csv", "out=q.csv"),
                  ("history", "a.csv", "columns=time_s", "columns=T_-"),
                  ("advise", "dam_break", "error=2%", "error=3%")):
        refused(sph(*words), words[-1].split("=")[0], "given twice", code=2)


def a_history_with_a_zero_byte_is_refused():
    pathlib.Path("h.csv").write_bytes(b"time,a\n0,1\n1,2\n\0\n2,3\n3,4\n")
    refused(sph("history", "h.csv"), "h.csv", "byte 16 is zero")


def a_stage_log_with_a_zero_byte_is_refused():
    fine(dam("steps=3", "stage_log=a.log", "hash"))
    pathlib.Path("b.log").write_bytes(state("a.log") + b"\0\n9 0123456789abcdef more\n")
    refused(sph("diff", "a.log", "b.log"), "b.log", "zero byte")


def a_name_with_a_line_feed_breaks_no_table():
    fine(dam("end=0.01", "frames=1", "out=a"))
    os.rename("a_0001.sph", "x\n1,2\n.sph")
    fine(sph("export", "x\n1,2\n.sph", "out=t.csv"))
    assert pathlib.Path("t.csv").read_text().splitlines()[1].startswith("x_m,y_m")


def advice_is_the_same_from_every_folder():
    os.mkdir("elsewhere")
    a, b = (fine(sph("advise", "dam_break", "error=5%", cwd=f)) for f in (".", "elsewhere"))
    assert a.out == b.out and "sph run dam_break" in a.out
    refused(sph("advise", "dam_break", "error=5%", "tables=nowhere"), "nowhere")


# ---- all of them ----

def run_one(test):
    with tempfile.TemporaryDirectory(prefix="sph_tool_") as folder:
        os.chdir(folder)
        try:
            test()
            return True
        except Exception:
            said = "".join("      " + line for line in traceback.format_exc().splitlines(True))
            print(f"  FAILED {test.__name__}\n{said}")
            return False
        finally:
            os.chdir("/")


def main():
    global TOOL
    p = argparse.ArgumentParser(usage=__doc__)
    p.add_argument("--tool", default="build/sph")
    p.add_argument("--only", default="")
    o = p.parse_args()
    TOOL = os.path.abspath(o.tool)
    first = globals()["a_dump_that_does_not_fit_is_said_with_its_reason"].__code__.co_firstlineno
    helpers = {"state", "without_notes", "make_dump", "with_gnuplot", "read_vtu", "close", "run_one", "main"}
    tests = [f for n, f in list(globals().items()) if callable(f) and getattr(f, "__module__", "") == "__main__" and
             hasattr(f, "__code__") and f.__code__.co_firstlineno >= first and n not in helpers and o.only in n]
    tests.sort(key=lambda f: f.__code__.co_firstlineno)
    began = time.time()
    passed = sum([run_one(t) for t in tests])
    if not tests:
        print("no test ran")
    print(f"  {'tool':<24} {passed:3d} passed {len(tests) - passed:3d} failed {time.time() - began:4.0f} s")
    return 0 if tests and passed == len(tests) else 1


if __name__ == "__main__":
    sys.exit(main())
