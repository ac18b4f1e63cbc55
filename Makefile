# SPDX-License-Identifier: MIT. Copyright the sph authors.
# Builds the kernel six times (1-D, 2-D, 3-D, float and double), the tool, the tests and the measurements.
# `make help` lists the targets. Everything is made under $(BUILD). Every tool and flag below can be overridden:
#   make CC=clang OPT=-O3     make BUILD=build/asan OPT="-O1 -g -fsanitize=address,undefined"     make V=1

BUILD   ?= build
ifneq ($(words $(BUILD)),1)
$(error BUILD is '$(BUILD)': it must be one path without spaces)
endif
ifeq ($(origin CC),default)
CC       = cc
endif
ifeq ($(origin AR),default)
AR       = ar
endif
GCC     ?= gcc
CLANG   ?= clang
SIZE    ?= size
NM      ?= nm
GCOV    ?= gcov
OBJDUMP ?= objdump
PYTHON  ?= python3
ARM_SIZE ?= arm-none-eabi-size
CPPCHECK ?= cppcheck
CLANG_TIDY ?= clang-tidy
PKG_CONFIG ?= pkg-config
OPT     ?= -O2
WARN    ?= -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion
CFLAGS  ?=
LDFLAGS ?=
EXEC    ?=

ifdef V
Q :=
say = @:
else
Q := @
say = @printf '  %-8s %s\n'
endif

# ---- flags that make the same bits everywhere; -fexcess-precision is gcc's alone ----

BITS := -std=c11 -ffp-contract=off -fno-math-errno -fno-trapping-math
is_clang := $(findstring clang,$(shell $(CC) --version 2>/dev/null))
BITS_CC := $(BITS) $(if $(is_clang),,-fexcess-precision=fast)
ALL_CFLAGS = $(BITS_CC) $(OPT) $(WARN) $(CFLAGS)
HOST_CFLAGS := -D_POSIX_C_SOURCE=200809L -I. -Isph -Iport -Iexamples -Iexamples/scenes -Itools -Itests
THREADS := -pthread

# libpng is used when a small program with it compiles and links
png_flags := $(shell $(PKG_CONFIG) --cflags libpng 2>/dev/null)
png_libs  := $(or $(shell $(PKG_CONFIG) --libs libpng 2>/dev/null),-lpng -lz)
have_png  := $(shell printf '\043include <png.h>\nint main(void){return png_access_version_number()==0;}\n' | \
               $(CC) $(png_flags) -x c - -o /dev/null $(png_libs) 2>/dev/null && echo yes)
ifeq ($(have_png),yes)
PNG_CFLAGS := -DHAVE_LIBPNG $(png_flags)
PNG_LIBS   := $(png_libs)
endif

# so is zlib, for small .vtu files
zlib_flags := $(shell $(PKG_CONFIG) --cflags zlib 2>/dev/null)
zlib_libs  := $(or $(shell $(PKG_CONFIG) --libs zlib 2>/dev/null),-lz)
have_zlib  := $(shell printf '\043include <zlib.h>\nint main(void){return compressBound(1)==0;}\n' | \
                $(CC) $(zlib_flags) -x c - -o /dev/null $(zlib_libs) 2>/dev/null && echo yes)
ifeq ($(have_zlib),yes)
PNG_CFLAGS += -DHAVE_ZLIB $(zlib_flags)
PNG_LIBS   += $(zlib_libs)
endif

# ---- sources ----

# parts of the tests that need a source file
HOST_CFLAGS += $(if $(wildcard sph/dump.c),-DHAVE_DUMP=1) $(if $(wildcard port/posix.h),-DHAVE_PORT_POSIX=1)

BUILDS := 1f 1d 2f 2d 3f 3d
dim = $(patsubst %d,%,$(patsubst %f,%,$(1)))
double = $(if $(filter %d,$(1)),1,0)
defines = -DSPH_DIM=$(call dim,$(1)) -DSPH_DOUBLE=$(call double,$(1))

KERNEL := $(wildcard sph/*.c)
PORT   := port/posix.c
SCENES := $(wildcard examples/scenes/*.c)
PROGS  := $(wildcard examples/*.c)
TOOLS  := $(filter-out tools/build.c,$(wildcard tools/*.c))
EXTRA_LISTS := $(wildcard tests/extra_*.h)
# the longest first, so that no processor waits for one at the end
LONG_TESTS := test_order test_bits test_faults test_atlas test_oracle test_walls test_solid_forces test_materials
TESTS  := $(LONG_TESTS) $(filter-out $(LONG_TESTS) test_lists test_restarts,\
    $(sort $(patsubst tests/%.c,%,$(wildcard tests/test_*.c))))

LIBS := $(BUILDS:%=$(BUILD)/libsph%.a)
port_obj  := $(PORT:%.c=$(BUILD)/obj/%.o)
tools_obj := $(TOOLS:%.c=$(BUILD)/obj/%.o)
build_obj := $(foreach b,$(BUILDS),$(if $(wildcard tools/build.c),$(BUILD)/obj/$(b)/tools/build.o))
scene_obj := $(foreach b,$(BUILDS),$(SCENES:%.c=$(BUILD)/obj/$(b)/%.o))
tables_obj := $(BUILD)/obj/tables.o
TOOL := $(if $(wildcard tools/main.c),$(BUILD)/sph)

.PHONY: all examples demo test golden bits knobs bench size coverage lint help clean tests
.PHONY: validate validate-water validate-waves validate-open validate-solids validate-edges
.PHONY: count house gates gates-quick mutants tool-test
.PHONY: targets travel refuse wasm browser
.PHONY: size-gate slices baremetal lab lab-smoke charts atlas
.PHONY: orders restarts install install-check oracle oracle-breaks
.PHONY: asan tsan msan fuzz fuzz-replay fuzz-programs replay-programs
.DELETE_ON_ERROR:
.SECONDARY:
.DEFAULT_GOAL := all

all: $(LIBS) $(TOOL) examples

# ---- kernel, scenes and whatever else is compiled once for each of the six builds ----

define build_rules
$(BUILD)/obj/$(1)/sph/%.o: sph/%.c
	$$(say) cc "$$< ($(1))"
	@mkdir -p $$(@D)
	$$(Q)$$(CC) $$(ALL_CFLAGS) $(call defines,$(1)) -MMD -MP -c $$< -o $$@
$(BUILD)/obj/$(1)/examples/%.o: examples/%.c
	$$(say) cc "$$< ($(1))"
	@mkdir -p $$(@D)
	$$(Q)$$(CC) $$(ALL_CFLAGS) $(call defines,$(1)) -I. -Isph -Iport -Iexamples/scenes -MMD -MP -c $$< -o $$@
$(BUILD)/obj/$(1)/%.o: %.c
	$$(say) cc "$$< ($(1))"
	@mkdir -p $$(@D)
	$$(Q)$$(CC) $$(ALL_CFLAGS) $$(HOST_CFLAGS) $(call defines,$(1)) -MMD -MP -c $$< -o $$@
$(BUILD)/extra/$(1)/%.o: %.c $(EXTRA_LISTS)
	$$(say) cc "$$< ($(1), extra lists)"
	@mkdir -p $$(@D)
	$$(Q)$$(CC) $$(ALL_CFLAGS) $$(HOST_CFLAGS) $(call defines,$(1)) $(EXTRA_LISTS:%=-include %) -MMD -MP -c $$< -o $$@
$(BUILD)/libsph$(1).a: $$(KERNEL:%.c=$(BUILD)/obj/$(1)/%.o)
	$$(say) ar $$@
	$$(Q)rm -f $$@ && $$(AR) rcs $$@ $$^
endef
$(foreach b,$(BUILDS),$(eval $(call build_rules,$(b))))

$(BUILD)/obj/%.o: %.c
	$(say) cc $<
	@mkdir -p $(@D)
	$(Q)$(CC) $(ALL_CFLAGS) $(HOST_CFLAGS) $(PNG_CFLAGS) $(THREADS) -MMD -MP -c $< -o $@

# the tables of the lab, for sph advise wherever it is called
LAB_TABLES := $(sort $(wildcard tests/lab/*.csv))
$(BUILD)/tables.c: tools/tables.awk $(LAB_TABLES)
	@mkdir -p $(@D)
	$(Q)awk -f tools/tables.awk $(LAB_TABLES) </dev/null >$@
$(tables_obj): $(BUILD)/tables.c
	$(say) cc $<
	@mkdir -p $(@D)
	$(Q)$(CC) $(ALL_CFLAGS) $(HOST_CFLAGS) -MMD -MP -c $< -o $@

$(BUILD)/sph: $(tools_obj) $(tables_obj) $(build_obj) $(scene_obj) $(port_obj) $(LIBS)
	$(say) link $@
	$(Q)$(CC) $(ALL_CFLAGS) $(LDFLAGS) $(THREADS) $^ -o $@ $(PNG_LIBS) -lm

-include $(shell find $(BUILD)/obj $(BUILD)/extra -name '*.d' 2>/dev/null)

# ---- install: libraries, headers, a pkg-config file for each build, and the tool ----

PREFIX ?= /usr/local
DESTDIR ?=
INSTALL_BUILDS ?= $(BUILDS)
INSTALL_TOOL ?= $(TOOL)
INSTALLED_HEADERS := sph/sph.h sph/modules.h sph/knobs.h sph/name.h sph/options.h \
    $(shell sed -n 's/^.include "\(.*\)"/sph\/\1/p' sph/options.h)
version := $(shell sed -n 's/^.define SPH_VERSION \([0-9]*\)u.*/\1/p' sph/sph.h)
install: $(INSTALL_BUILDS:%=$(BUILD)/libsph%.a) $(INSTALL_TOOL)
	$(Q)mkdir -p "$(DESTDIR)$(PREFIX)/lib/pkgconfig" "$(DESTDIR)$(PREFIX)/include/sph"
	$(Q)cp $(INSTALLED_HEADERS) "$(DESTDIR)$(PREFIX)/include/sph/"
	$(Q)for b in $(INSTALL_BUILDS); do \
		cp $(BUILD)/libsph$$b.a "$(DESTDIR)$(PREFIX)/lib/" || exit 1; \
		case $$b in *d) double=1 ;; *) double=0 ;; esac; \
		printf '%s\n' 'prefix=$(PREFIX)' 'includedir=$${prefix}/include' 'libdir=$${prefix}/lib' '' "Name: sph$$b" \
			"Description: smoothed particle hydrodynamics in fixed memory, $${b%?}-D, SPH_DOUBLE=$$double" \
			'Version: $(version)' "Cflags: -I\$${includedir} -DSPH_DIM=$${b%?} -DSPH_DOUBLE=$$double" \
			"Libs: -L\$${libdir} -lsph$$b -lm" >"$(DESTDIR)$(PREFIX)/lib/pkgconfig/sph$$b.pc" || exit 1; \
	done
	$(Q)if [ -n "$(INSTALL_TOOL)" ]; then mkdir -p "$(DESTDIR)$(PREFIX)/bin" && cp $(INSTALL_TOOL) "$(DESTDIR)$(PREFIX)/bin/"; fi
# from a fresh copy of the tree: installed, used from C and C++; all of sph/ as one translation unit
install-check:
	$(Q)CC="$(CC)" MAKE="$(MAKE)" sh tests/install.sh

# ---- examples: each examples/NAME.c is a program on the 2-D float build ----

EXAMPLES := $(PROGS:examples/%.c=$(BUILD)/examples/%)
examples: $(EXAMPLES)
$(BUILD)/examples/%: $(BUILD)/obj/2f/examples/%.o $(SCENES:%.c=$(BUILD)/obj/2f/%.o) $(port_obj) $(BUILD)/libsph2f.a
	$(say) link $@
	@mkdir -p $(@D)
	$(Q)$(CC) $(ALL_CFLAGS) $(LDFLAGS) $(THREADS) $^ -o $@ -lm

# ---- demo: a dam break, a picture, a dump, a history; needs a C compiler and make only ----

demo: $(BUILD)/sph
	$(Q)sh tests/demo.sh $(BUILD)

# ---- tests ----

# the builds that a test is compiled for; 2f 2d unless said otherwise
builds_test_dmath   := 2f
builds_test_kernels := $(BUILDS)
builds_test_conserve := $(BUILDS)
builds_test_bits    := $(BUILDS)
builds_test_balance := $(BUILDS)
builds_test_materials := $(BUILDS)
builds_test_fail    := 1d 2f 3f
builds_test_entry   := 1f 2f 2d 3d
builds_test_dumps   := $(BUILDS)
builds_test_threads := 1d 2f 3f
builds_test_units   := 1d 2f 3f
builds_test_faults  := 1d 2f 3f
builds_test_api     := $(BUILDS)
builds_test_walls   := $(BUILDS)
builds_test_eos_schemes := $(BUILDS)
builds_test_time    := 1f 1d 2d
builds_test_order   := 2d
builds_test_motions := 1d 2f 2d
builds_test_mirrors := $(BUILDS)
builds_test_scenes  := $(BUILDS)
builds_test_shapes  := $(BUILDS)
builds_test_contact := $(BUILDS)
builds_test_gradient := $(BUILDS)
builds_test_shear   := $(BUILDS)
builds_test_density_gradient := $(BUILDS)
builds_test_energy  := 1d 2f 2d 3f
# of commands of the tool, linked with those that need no scene: one build
TOOL_TESTS := test_dispersion test_gradykipp test_fragments test_fields test_profile test_advise test_atlas \
	test_waves
$(foreach t,$(TOOL_TESTS),$(eval builds_$(t) := 2d))
builds_test_solid   := $(BUILDS)
builds_test_solid_forces := $(BUILDS)
builds_test_solid_motion := $(BUILDS)
builds_test_damage  := 2f 2d 3f 3d
builds_test_options := 1d 2f 3f
builds_test_arena   := $(BUILDS)
builds_test_sponge  := 1f 1d 2f 2d 3f
builds_test_flow    := $(BUILDS)
builds_test_plates  := 1d 2f 2d 3f
builds_test_quadrature := 1d 2f 2d 3f
builds_test_grid    := $(BUILDS)
builds_test_oracle  := $(BUILDS)
builds_test_smoothing_length := $(BUILDS)
builds_test_inspect := 1f 2f 2d 3f
builds_test_probes  := $(BUILDS)
builds_test_shifting := $(BUILDS)
builds_test_damper  := 1d 2f 2d 3f
builds_test_format  := 1d 2f 3f
builds_test_bounds  := 1d 2f 3f
builds_test_usage   := 1d 2f 3f
builds_test_validate := 1d 2f 3f
builds_test_crossing := 1d 2f 3f
# of those that a test lists `make test` takes these: each dimension and precision is met; all: TEST_BUILDS="$(BUILDS)"
TEST_BUILDS ?= 1d 2f 2d 3f
builds_of = $(or $(builds_$(1)),2f 2d)
# the stability atlas (tests/lab): one program of parts from several builds
atlas_obj := $(patsubst %,$(BUILD)/obj/%.o,$(patsubst %,1d/tests/lab/%,atlas_tension atlas_sponge box) \
	$(patsubst %,2d/tests/lab/%,atlas_courant atlas_swegle atlas_forms atlas_water box theory precision_run) \
	$(patsubst %,2f/tests/lab/%,atlas_walls box precision_run) $(patsubst %,tests/lab/%,atlas_names atlas_precision) \
	tools/dispersion)
atlas_libs := $(BUILD)/libsph1d.a $(BUILD)/libsph2f.a
test_bins := $(foreach t,$(TESTS),$(foreach b,$(filter $(TEST_BUILDS),$(call builds_of,$(t))),$(BUILD)/tests/$(t)_$(b)))

command_obj := $(filter-out $(addprefix $(BUILD)/obj/tools/,main.o builds.o cmd_run.o run_files.o run_restore.o cmd_list.o gauges.o),$(tools_obj)) $(tables_obj)
of_tool = $(if $(filter $(1),$(TOOL_TESTS)),$(2))

# the oracle (tests/oracle): linked into its test, and a program for each build
ORACLE := $(wildcard tests/oracle/*.c)
oracle_of = $(if $(filter test_oracle,$(1)),$(patsubst %.c,$(BUILD)/obj/$(2)/%.o,$(filter-out %/main.c,$(ORACLE))))

# tests with a kernel of their own, whose lists are longer by the lines of tests/extra_*.h
EXTRA_TESTS := test_options
obj_of = $(BUILD)/$(if $(filter $(1),$(EXTRA_TESTS)),extra,obj)/$(2)
kernel_of = $(if $(filter $(1),$(EXTRA_TESTS)),$(KERNEL:%.c=$(BUILD)/extra/$(2)/%.o),$(BUILD)/libsph$(2).a)

define test_rule
$(BUILD)/tests/$(1)_$(2): $(call obj_of,$(1),$(2))/tests/$(1).o $(call of_tool,$(1),$(command_obj)) $(call oracle_of,$(1),$(2)) $(if $(filter test_atlas,$(1)),$(atlas_obj) $(atlas_libs)) $(port_obj) $(SCENES:%.c=$(call obj_of,$(1),$(2))/%.o) $(call kernel_of,$(1),$(2))
	$$(say) link $$@
	@mkdir -p $$(@D)
	$$(Q)$$(CC) $$(ALL_CFLAGS) $$(LDFLAGS) $$(THREADS) $$^ -o $$@ -lcmocka $(call of_tool,$(1),$(PNG_LIBS)) -lm
endef
$(foreach t,$(TESTS),$(foreach b,$(call builds_of,$(t)),$(eval $(call test_rule,$(t),$(b)))))
$(foreach b,$(BUILDS),$(BUILD)/obj/$(b)/tests/test_dmath.o): HOST_CFLAGS += -Itests/refdata

# the kernel once more, with a state field of every way (tests/extra_fields.h) and a column set (tests/lists_columns.h)
define lists_rules
$(BUILD)/obj/lists_$(1)/%.o: %.c tests/extra_fields.h tests/lists_columns.h
	$$(say) cc "$$< (lists, $(1))"
	@mkdir -p $$(@D)
	$$(Q)$$(CC) $$(ALL_CFLAGS) $$(HOST_CFLAGS) $(call defines,$(1)) -include tests/extra_fields.h \
		-include tests/lists_columns.h -MMD -MP -c $$< -o $$@
$(BUILD)/tests/test_lists_$(1): $(BUILD)/obj/lists_$(1)/tests/test_lists.o $(KERNEL:%.c=$(BUILD)/obj/lists_$(1)/%.o)
	$$(say) link $$@
	@mkdir -p $$(@D)
	$$(Q)$$(CC) $$(ALL_CFLAGS) $$(LDFLAGS) $$^ -o $$@ -lcmocka -lm
endef
LISTS_BUILDS := 1f 2f 3d
$(foreach b,$(LISTS_BUILDS),$(eval $(call lists_rules,$(b))))
test_bins += $(LISTS_BUILDS:%=$(BUILD)/tests/test_lists_%)

# the kernel once more with what is heavy to check, and poison in memory that may not be read yet (sph/validate.c)
define poison_rules
$(BUILD)/obj/poison_$(1)/%.o: %.c
	$$(say) cc "$$< (poison, $(1))"
	@mkdir -p $$(@D)
	$$(Q)$$(CC) $$(ALL_CFLAGS) $$(HOST_CFLAGS) $(call defines,$(1)) -USPH_ASSERTS -DSPH_VALIDATES=1 -MMD -MP -c $$< -o $$@
$(BUILD)/tests/test_restarts_$(1): $(BUILD)/obj/poison_$(1)/tests/test_restarts.o $(KERNEL:%.c=$(BUILD)/obj/poison_$(1)/%.o)
	$$(say) link $$@
	@mkdir -p $$(@D)
	$$(Q)$$(CC) $$(ALL_CFLAGS) $$(LDFLAGS) $$^ -o $$@ -lcmocka -lm
endef
RESTART_BUILDS := 1d 2f 3d
$(foreach b,$(RESTART_BUILDS),$(eval $(call poison_rules,$(b))))
test_bins += $(RESTART_BUILDS:%=$(BUILD)/tests/test_restarts_%)

# 2,000 random scenes of all modules: restored at every step, with poison, they go on with the same bits
SCENES ?= 2000
restarts: $(RESTART_BUILDS:%=$(BUILD)/tests/test_restarts_%)
	$(Q)SCENES=$$(($(SCENES) / 2)) $(BUILD)/tests/test_restarts_2f
	$(Q)SCENES=$$(($(SCENES) * 3 / 8)) FIRST=5000 $(BUILD)/tests/test_restarts_1d
	$(Q)SCENES=$$(($(SCENES) / 8)) FIRST=9000 $(BUILD)/tests/test_restarts_3d

# `make test` is one shell script so that cmocka is there before anything is compiled with it
test:
	$(Q)CC="$(CC)" sh tests/need_cmocka.sh
	$(Q)$(MAKE) --no-print-directory tests CFLAGS="$(CFLAGS) -DSPH_ASSERTS=1"
	$(Q)EXEC="$(EXEC)" sh tests/run.sh $(BUILD) $(test_bins)
	$(Q)sh tests/entries.sh
	$(Q)$(MAKE) --no-print-directory tool-test CFLAGS="$(CFLAGS) -DSPH_ASSERTS=1"
	$(Q)BUILD=$(BUILD) CC="$(CC)" MAKE="$(MAKE)" sh tests/bits.sh --quick

tests: $(test_bins)

# the tool as its users meet it: full disks, links, broken dumps, names with anything in them
tool-test: $(BUILD)/sph
	$(Q)$(PYTHON) tests/tool.py --tool $(BUILD)/sph

# the golden runs in one program, for tests/bits.sh
golden: $(BUILD)/golden
$(BUILD)/golden: $(BUILD)/obj/tests/golden_main.o $(BUILDS:%=$(BUILD)/obj/%/tests/golden.o) $(LIBS)
	$(say) link $@
	$(Q)$(CC) $(ALL_CFLAGS) $(LDFLAGS) $^ -o $@

# those of some cases (tests/mutants.py)
$(BUILD)/mutants_golden_%: $(BUILD)/obj/%/tests/mutants_golden.o $(BUILD)/libsph%.a
	$(say) link $@
	$(Q)$(CC) $(ALL_CFLAGS) $(LDFLAGS) $^ -o $@

# those of one build
$(BUILD)/golden_%: $(BUILD)/obj/%/tests/golden_one.o $(BUILD)/obj/%/tests/golden.o $(BUILD)/libsph%.a
	$(say) link $@
	$(Q)$(CC) $(ALL_CFLAGS) $(LDFLAGS) $^ -o $@

# random small scenes against a naive second way to all that the kernel computes: 3,400 of each build
oracle_rule = $(eval $(BUILD)/oracle_$(1): $(ORACLE:%.c=$(BUILD)/obj/$(1)/%.o) $(BUILD)/libsph$(1).a)
$(foreach b,$(BUILDS),$(call oracle_rule,$(b)))
$(BUILDS:%=$(BUILD)/oracle_%):
	$(say) link $@
	$(Q)$(CC) $(ALL_CFLAGS) $(LDFLAGS) $^ -o $@ -lm
oracle: $(BUILDS:%=$(BUILD)/oracle_%)
	$(Q)BUILD=$(BUILD) sh tests/oracle.sh $(SCENES_EACH)
# the kernel broken in ten ways: the oracle must find each
oracle-breaks:
	$(Q)BUILD=$(BUILD) MAKE="$(MAKE)" sh tests/oracle_breaks.sh

bits:
	$(Q)BUILD=$(BUILD) GCC="$(GCC)" CLANG="$(CLANG)" MAKE="$(MAKE)" sh tests/bits.sh

# ---- other machines (port/targets.txt), those that this one has tools for ----

targets:
	$(Q)BUILD=$(BUILD) MAKE="$(MAKE)" sh tests/targets.sh $(TARGETS)
# dumps written on one machine go on on another
travel:
	$(Q)BUILD=$(BUILD) MAKE="$(MAKE)" sh tests/travel.sh
# builds and machines that break bits are refused, and what they would break is found and named
refuse:
	$(Q)BUILD=$(BUILD) MAKE="$(MAKE)" sh tests/refuse.sh

# ---- the page of examples/wasm in $(BUILD)/wasm: plain files that open without a server ----

WASM_CC ?= clang --target=wasm32-unknown-unknown
wasm: $(BUILD)/wasm/tank.wasm.js $(patsubst examples/wasm/%,$(BUILD)/wasm/%,$(wildcard examples/wasm/*.html examples/wasm/*.css examples/wasm/app.js))
$(BUILD)/wasm/%: examples/wasm/%
	@mkdir -p $(@D)
	$(Q)cp $< $@
$(BUILD)/wasm/tank.wasm: examples/wasm/tank.c examples/wasm/tank.h port/wasm/memory.c port/wasm/string.h $(KERNEL) $(wildcard sph/*.h)
	$(say) wasm $@
	@mkdir -p $(@D)
	$(Q)$(WASM_CC) $(BITS) -O2 -msimd128 -mbulk-memory $(WARN) -Wno-pass-failed -nostdlib -Iport/wasm \
		-Wl,--no-entry,--strip-all $(filter %.c,$^) -o $@
$(BUILD)/wasm/tank.wasm.js: $(BUILD)/wasm/tank.wasm
	$(Q)printf 'const TANK_WASM = "%s";\n' "$$(base64 <$< | tr -d '\n')" >$@
$(BUILD)/tank_host: $(BUILD)/obj/2f/tests/tank_host.o $(BUILD)/obj/2f/examples/wasm/tank.o $(BUILD)/libsph2f.a
	$(say) link $@
	$(Q)$(CC) $(ALL_CFLAGS) $(LDFLAGS) $^ -o $@
# that page in a headless browser: its hash is this machine's, its controls do what they say
browser: wasm $(BUILD)/tank_host
	$(Q)BUILD=$(BUILD) sh tests/browser.sh

# ---- fuzzing: each target takes a string of bytes; its first byte chooses the build (tests/fuzz/entry.c) ----

FUZZ_TARGETS := config particles walls dumps
FUZZ_SECONDS ?= 60
fuzz_obj := $(foreach b,1d 2f 3d,$(patsubst %.c,$(BUILD)/obj/$(b)/%.o,$(filter-out %/entry.c %/replay.c,$(wildcard tests/fuzz/*.c))))
fuzz_lib := $(foreach b,1d 2f 3d,$(BUILD)/libsph$(b).a)
$(FUZZ_TARGETS:%=$(BUILD)/obj/fuzz_%.o): $(BUILD)/obj/fuzz_%.o: tests/fuzz/entry.c
	$(say) cc "$< ($*)"
	@mkdir -p $(@D)
	$(Q)$(CC) $(ALL_CFLAGS) $(HOST_CFLAGS) -DFUZZ_TARGET=$* -MMD -MP -c $< -o $@
$(FUZZ_TARGETS:%=$(BUILD)/fuzz_%): $(BUILD)/fuzz_%: $(BUILD)/obj/fuzz_%.o $(fuzz_obj) $(fuzz_lib)
	$(say) link $@
	$(Q)$(CC) $(ALL_CFLAGS) $(LDFLAGS) -fsanitize=fuzzer $^ -o $@ -lm
$(FUZZ_TARGETS:%=$(BUILD)/replay_%): $(BUILD)/replay_%: $(BUILD)/obj/fuzz_%.o $(BUILD)/obj/tests/fuzz/replay.o $(fuzz_obj) $(fuzz_lib)
	$(say) link $@
	$(Q)$(CC) $(ALL_CFLAGS) $(LDFLAGS) $^ -o $@ -lm
fuzz-programs: $(FUZZ_TARGETS:%=$(BUILD)/fuzz_%)
replay-programs: $(FUZZ_TARGETS:%=$(BUILD)/replay_%)

fuzz:
	$(Q)BUILD=$(BUILD) CLANG="$(CLANG)" MAKE="$(MAKE)" TARGETS="$(FUZZ_TARGETS)" SECONDS_EACH="$(FUZZ_SECONDS)" sh tests/fuzz.sh run

fuzz-replay:
	$(Q)BUILD=$(BUILD) CC="$(CC)" CLANG="$(CLANG)" MAKE="$(MAKE)" TARGETS="$(FUZZ_TARGETS)" sh tests/fuzz.sh replay

# ---- sanitizers: the tests under them ----

# with what must hold inside (sph/checks.h); what is heavy is on in fuzzing: tests of faults throw particles about
# one text of the pair loop (SMALL) compiles in a fraction of the time; `make asan SMALL=0` is every fast path too
SMALL ?= 1
asan_flags = -fsanitize=address,undefined -DSPH_ASSERTS=1 -DSPH_SMALL=$(SMALL)
tsan_flags = -fsanitize=thread -DSPH_ASSERTS=1 -DSPH_SMALL=$(SMALL)
msan_flags := -fsanitize=memory -DSPH_ASSERTS=1 -fsanitize-memory-track-origins
sanitized = $(MAKE) --no-print-directory $(1) BUILD=$(BUILD)/$(2) CC="$(CLANG)" WARN="-Wall -Wno-pass-failed" \
	OPT="-O1 -g -fno-omit-frame-pointer" CFLAGS="$($(2)_flags) -fno-sanitize-recover=all" LDFLAGS="$($(2)_flags)"
TSAN_TESTS ?= $(BUILD)/tsan/tests/test_threads_1d $(BUILD)/tsan/tests/test_threads_2f $(BUILD)/tsan/tests/test_threads_3f
# of each test the builds that are asked for, or all of its own where it has none of these
ASAN_BUILDS ?= $(BUILDS)
# tests that it leaves out: figures of long runs, whose code others go through (CI)
ASAN_LEAVES ?=
asan_bins := $(foreach t,$(filter-out $(ASAN_LEAVES),$(TESTS)),$(foreach b,$(or $(filter $(ASAN_BUILDS),$(call builds_of,$(t))),$(filter 2f,$(call builds_of,$(t))),$(call builds_of,$(t))),$(BUILD)/asan/tests/$(t)_$(b)))
asan:
	$(Q)CC="$(CLANG)" sh tests/need_cmocka.sh
	$(Q)$(call sanitized,$(asan_bins),asan)
	$(Q)ASAN_OPTIONS=detect_leaks=0 ORDER=9 sh tests/run.sh $(BUILD)/asan $(asan_bins)
tsan:
	$(Q)CC="$(CLANG)" sh tests/need_cmocka.sh
	$(Q)$(call sanitized,$(TSAN_TESTS),tsan)
	$(Q)TSAN_OPTIONS=halt_on_error=1 sh tests/run.sh $(BUILD)/tsan $(TSAN_TESTS)
# the framework-free golden runs: a library that was not built with this sanitizer cannot be linked in
msan:
	$(Q)$(call sanitized,golden,msan)
	$(Q)$(BUILD)/msan/golden >$(BUILD)/msan/golden.csv
	$(Q)sed '/^\#/d' tests/golden.csv | diff - $(BUILD)/msan/golden.csv && echo "msan: $$(wc -l <$(BUILD)/msan/golden.csv) golden runs, no use of an unset byte, same hashes"

# every knob of sph/modules.h off alone, and random sets of them
knobs:
	$(Q)BUILD=$(BUILD) CC="$(GCC)" BITS="$(BITS) -fexcess-precision=fast" SIZE="$(SIZE)" sh tests/knobs.sh

# single changes of sph/ by a seed, each built and given to the tests: killed, survived, or the same object code. Goes on
# where it stopped; MUTANTS are arguments of tests/mutants.py
mutants:
	$(Q)sh tests/need_cmocka.sh
	$(Q)BUILD=$(BUILD) GCC="$(GCC)" $(PYTHON) tests/mutants.py --out tests/results/mutants.csv $(MUTANTS)

# every gate must see what it guards against: it is broken in a copy of the tree
gates:
	$(Q)BUILD=$(BUILD) MAKE="$(MAKE)" PYTHON="$(PYTHON)" sh tests/gates.sh
gates-quick:
	$(Q)BUILD=$(BUILD) MAKE="$(MAKE)" PYTHON="$(PYTHON)" sh tests/gates.sh --quick

# ---- measurements: each prints a table and writes $(BUILD)/NAME.csv ----

bench:
	$(Q)BUILD=$(BUILD) GCC="$(GCC)" CLANG="$(CLANG)" BITS="$(BITS)" sh tests/bench.sh

# instructions of a particle-step, against tests/results/count_base.csv
count:
	$(Q)BUILD=$(BUILD) GCC="$(GCC)" BITS="$(BITS)" sh tests/count.sh

size: $(LIBS) $(if $(wildcard examples/scenes/scenes.c),$(BUILD)/size_arena)
	$(Q)BUILD=$(BUILD) CC="$(CC)" SIZE="$(SIZE)" BITS="$(BITS_CC)" ARM_SIZE="$(ARM_SIZE)" MAKE="$(MAKE)" PYTHON="$(PYTHON)" sh tests/size.sh

size-gate: size
	$(Q)BUILD=$(BUILD) sh tests/size.sh --gate

# in an emulated Cortex-M4F, which counts instructions
slices:
	$(Q)BUILD=$(BUILD) CC="$(CC)" MAKE="$(MAKE)" sh tests/slices.sh

baremetal:
	$(Q)BUILD=$(BUILD) CC="$(CC)" MAKE="$(MAKE)" sh tests/baremetal.sh

$(BUILD)/size_arena: $(BUILD)/obj/tests/size_main.o $(BUILDS:%=$(BUILD)/obj/%/tests/size_arena.o) $(scene_obj) $(LIBS)
	$(say) link $@
	$(Q)$(CC) $(ALL_CFLAGS) $(LDFLAGS) $^ -o $@ -lm

# ---- the stability atlas: ATLAS tables that are not there or whose sources changed -> tests/lab/atlas_NAME.csv ----

$(BUILD)/atlas: $(BUILD)/obj/tests/lab/atlas.o $(atlas_obj) $(LIBS)
	$(say) link $@
	$(Q)$(CC) $(ALL_CFLAGS) $(LDFLAGS) $^ -o $@ -lm
atlas:
	$(Q)$(MAKE) --no-print-directory $(BUILD)/fast/atlas BUILD=$(BUILD)/fast OPT="-O3 -march=native"
	$(Q)BUILD=$(BUILD)/fast sh tests/lab/atlas.sh $(ATLAS)

validate: all
	$(Q)$(PYTHON) tests/validate.py --tool $(BUILD)/sph
validate-water validate-waves validate-open validate-solids validate-edges: validate-%: all
	$(Q)$(PYTHON) tests/validate_$*.py --tool $(BUILD)/sph

# orders in space of flows and bars that have exact solutions
orders: $(BUILD)/sph $(BUILD)/orders_bar
	$(Q)$(PYTHON) tests/orders.py --tool $(BUILD)/sph && cp build/orders.csv tests/results/orders.csv
$(BUILD)/orders_bar: $(BUILD)/obj/1d/tests/orders_bar.o $(BUILD)/libsph1d.a
	$(say) link $@
	$(Q)$(CC) $(ALL_CFLAGS) $(LDFLAGS) $^ -o $@ -lm

# ---- the lab: accuracy against cost, and stability (tests/lab) ----

# runs are made by a fast build (the bits are the same), instructions are counted in the usual one
LAB_FLAGS ?= -O3 -march=native
STUDIES ?=
JOBS ?= 2
lab: $(BUILD)/sph
	$(Q)$(MAKE) --no-print-directory BUILD=$(BUILD)/lab OPT="$(LAB_FLAGS)" $(BUILD)/lab/sph $(BUILD)/lab/interpolation_1d $(BUILD)/lab/interpolation_2d
	$(Q)$(PYTHON) tests/lab/run.py --jobs $(JOBS) --tool $(BUILD)/lab/sph --counter $(BUILD)/sph --studies "$(STUDIES)"
	$(Q)$(if $(STUDIES),,sh tests/lab/interpolation.sh $(BUILD)/lab >tests/lab/interpolation.csv.tmp && mv tests/lab/interpolation.csv.tmp tests/lab/interpolation.csv)
# from the tables as they are: nothing is run
charts:
	$(Q)$(PYTHON) tests/lab/charts.py
lab-smoke: $(BUILD)/sph $(BUILD)/interpolation_1d $(BUILD)/interpolation_2d
	$(Q)$(PYTHON) tests/lab/run.py --smoke --jobs $(JOBS) --tool $(BUILD)/sph
	$(Q)sh tests/lab/interpolation.sh $(BUILD) | diff - tests/lab/interpolation.csv && echo "lab-smoke: tests/lab/interpolation.csv is the same"
$(BUILD)/interpolation_%: $(BUILD)/obj/%/tests/lab/interpolation.o $(BUILD)/libsph%.a
	$(say) link $@
	$(Q)$(CC) $(ALL_CFLAGS) $(LDFLAGS) $^ -o $@ -lm

coverage:
	$(Q)BUILD=$(BUILD)/coverage GCC="$(GCC)" GCOV="$(GCOV)" MAKE="$(MAKE)" OUT=$(BUILD) sh tests/coverage.sh

# the rules of the house: floors, lengths, words (tests/house.py, tests/floors.txt)
house: $(BUILD)/libsph2f.a
	$(Q)$(PYTHON) tests/house.py --build $(BUILD) --nm $(NM)
lint: $(BUILD)/libsph2f.a
	$(Q)PYTHON="$(PYTHON)" NM="$(NM)" CPPCHECK="$(CPPCHECK)" CLANG_TIDY="$(CLANG_TIDY)" BUILD=$(BUILD) BITS="$(BITS)" sh tests/lint.sh

clean:
	$(Q)rm -rf $(BUILD)

help:
	@printf '%s\n' \
	'make            the tool $(BUILD)/sph and the libraries $(BUILD)/libsph{1,2,3}{f,d}.a' \
	'make demo       a 2-D dam break: picture, dump and history (a C compiler and make are enough)' \
	'make test       the quick tests (needs cmocka; gets it with apt-get as root); TEST_BUILDS="1f 3d": of these builds' \
	'make tool-test  the program $(BUILD)/sph alone, as its users meet it' \
	'make bits       the golden runs by many compilers, levels and vector widths against tests/golden.csv' \
	'make knobs      every build knob off alone and in random sets: golden or refused -> $(BUILD)/knobs.csv' \
	'make targets    the golden runs on every machine of port/targets.txt that has tools here  -> $(BUILD)/targets.csv' \
	'make travel     dumps from one machine go on on another with the same bits' \
	'make refuse     builds that break bits are refused; the first difference is named' \
	'make wasm       a page with a tank to tilt: open $(BUILD)/wasm/index.html' \
	'make browser    that page in headless Chromium: hash, controls, picture' \
	'make bench      speed and memory, gcc and clang, native and portable      -> $(BUILD)/bench.csv' \
	'make count      instructions of a particle-step, by callgrind             -> $(BUILD)/count.csv' \
	'make size       bytes of arena, code and stack; pairs and instructions     -> $(BUILD)/size.csv' \
	'make size-gate  the same, against tests/results/size.csv with 3 % to spare' \
	'make slices     the longest slice on an emulated Cortex-M4F               -> $(BUILD)/slices.csv' \
	'make baremetal  a tank at a fixed rate and a dam break in 192 KiB, on the same -> $(BUILD)/baremetal.csv' \
	'make validate   the scenes against published figures                      -> $(BUILD)/validate.csv' \
	'make validate-water, -waves, -open, -solids, -edges  a part of them' \
	'make orders            orders in space of flows and bars        -> tests/results/orders.csv' \
	'make lab        error against cost, STUDIES="a b" or all (an hour)        -> tests/lab/*.csv' \
	'make lab-smoke  the coarse rows of it, against the committed tables' \
	'make charts     charts and a page of the tables (gnuplot)                 -> tests/lab/charts, tests/lab/index.html' \
	'make fuzz       fuzzes four targets, FUZZ_SECONDS each (clang)            -> $(BUILD)/fuzz.csv' \
	'make fuzz-replay  gives the committed corpus of inputs to the targets' \
	'make asan tsan msan  tests under sanitizers: all; those of threads; the golden runs (clang)' \
	'make atlas      where methods get unstable, against linear theory (ATLAS: some tables) -> tests/lab/atlas_*.csv' \
	'make restarts   2,000 random scenes restored at every step: the same bits' \
	'make coverage   lines of sph/ that the tests run                          -> $(BUILD)/coverage.csv' \
	'make lint       cppcheck, clang-tidy and the rules of the house' \
	'make house      those rules alone: floors of files, lengths, words        -> $(BUILD)/house.csv' \
	'make oracle     random small scenes against a naive second way             -> $(BUILD)/oracle.csv' \
	'make oracle-breaks  does the oracle find a broken kernel?                 -> $(BUILD)/oracle_breaks.csv' \
	'make gates      does every gate see what it guards against?               -> $(BUILD)/gates.csv' \
	'make gates-quick  those that take seconds' \
	'make mutants    single changes of the kernel: does a test see each? (hours) -> tests/results/mutants.csv' \
	'make install    libraries, headers, pkg-config files, the tool under PREFIX (DESTDIR, INSTALL_BUILDS="2f 3d")' \
	'make install-check  that, from a fresh tree, used from C and C++; sph/ as one translation unit' \
	'make clean      removes $(BUILD)' \
	'Variables: CC OPT CFLAGS LDFLAGS AR SIZE NM GCC CLANG BUILD EXEC; V=1 shows every command.'
