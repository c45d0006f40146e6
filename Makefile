# The front door. Thin: installs what is missing, then CMake does the work.
#
#   make demo    the rotary knife line: builds, runs it, says where the report is
#   make test    builds and runs all tests; its last line says how long it took
#   make test-all  those, and the tests that take many minutes
#   make quick   the tests that take seconds
#   make bench   speed of the release beside stock Bullet (and MuJoCo), in one run
#   make         builds build/drycut
#   make cluster the tests of sweeps on Dask and Slurm, with clusters on this machine
#   make opcua   what `drycut live --opcua` needs, in build/opcua, and its tests
#   make python  builds the Python package in build/python
#   make docs    the site of docs/ in build/docs: pages, reference, search; and its tests
#   make notebooks  runs docs/notebooks anew and stores what they say
#   make release the program with its loop trained on the scenes (profile-guided), in build-release; make deb packages it
#   make sanitize, make fuzz, make same-bytes, make reference, make lint, make tidy, make format, make meshes: for those who change the code

BUILD    ?= build
JOBS     ?= $(shell nproc)
PACKAGES := cmake ninja-build pkg-config libbullet-dev libosmesa6-dev libpng-dev libdeflate-dev libcairo2-dev libassimp-dev libminizip-dev libpugixml-dev libeigen3-dev libyaml-cpp-dev \
            libudunits2-dev libnlopt-cxx-dev libhdf5-dev zlib1g-dev libzstd-dev libcli11-dev libboost-dev libfmt-dev nlohmann-json3-dev \
            fonts-dejavu-core libjs-dygraphs libjs-three ffmpeg
PYTHON_PACKAGES := pybind11-dev python3-dev python3-numpy
NOTEBOOK_PACKAGES := jupyter-nbconvert python3-ipykernel python3-matplotlib
TEST_PACKAGES  := libgtest-dev libgmock-dev libsundials-dev libmujoco-dev python3-jsonschema python3-yaml python3-h5py python3-pandas mypy \
                  libmodbus-dev mbpoll python3-pymodbus python3-serial-asyncio tshark yamllint \
                  $(PYTHON_PACKAGES) $(NOTEBOOK_PACKAGES)
LONG_PACKAGES  := octave octave-control
BENCH_PACKAGES := libmujoco-dev
CLUSTER_PACKAGES := python3-distributed slurm-wlm munge
OPCUA_PACKAGES := nodejs npm
DOCS_PACKAGES := python3-sphinx python3-myst-parser furo
CLANG_PACKAGES := clang libclang-rt-14-dev llvm-14
LINT_PACKAGES  := clang-format clang-tidy
SOURCES := $(wildcard base/*.?pp devices/*.?pp devices/*/*.?pp devices/*/*/*.?pp plants/*.?pp renders/*.?pp sim/*.?pp sim/*/*.?pp sim/*/*/*.?pp tests/*.?pp tests/*/*.?pp tests/*/*/*.?pp)

# Where ccache is installed, what was compiled before is not compiled again, in this folder or in another clone.
CONFIGURE := cmake -G Ninja -DCMAKE_BUILD_TYPE=Release $(if $(shell command -v ccache),-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
export CCACHE_BASEDIR := $(CURDIR)
export CCACHE_NOHASHDIR := 1
export CCACHE_SLOPPINESS := pch_defines,time_macros
# Debian's own, which has numpy, whatever else is in the way.
PYTHON    := -DDRYCUT_PYTHON=ON -DPython3_EXECUTABLE=/usr/bin/python3

# Installs the packages of $(1) that are missing; sudo where we are not root.
define install
@missing=""; for p in $(1); do dpkg-query -W -f='$${Status}' $$p 2>/dev/null | grep -q 'ok installed' || missing="$$missing $$p"; done; \
if [ -n "$$missing" ]; then \
  command -v apt-get >/dev/null || { echo "Please install:$$missing"; exit 1; }; \
  if [ "$$(id -u)" = 0 ]; then sudo=""; else sudo=sudo; fi; \
  echo "Installing:$$missing"; \
  $$sudo apt-get update -q && $$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $$missing; \
fi
endef

.PHONY: all setup profile release demo test test-all quick cluster opcua python docs notebooks bench clang sanitize fuzz same-bytes reference deb lint tidy format meshes clean

all: setup
	@$(CONFIGURE) -S . -B $(BUILD) -DBUILD_TESTING=OFF > $(BUILD).log 2>&1 || { cat $(BUILD).log; exit 1; }
	@rm -f $(BUILD).log
	@cmake --build $(BUILD) -j $(JOBS)

setup:
	$(call install,$(PACKAGES))

demo: all
	$(BUILD)/drycut run scenes/rotary_knife.yaml --out out
	@echo
	@echo "The report: $(CURDIR)/out/rotary_knife/report.html (open it in a browser)"

test: began := $(shell date +%s)
test: setup
	$(call install,$(TEST_PACKAGES))
	$(CONFIGURE) -S . -B $(BUILD) -DBUILD_TESTING=ON $(PYTHON)
	cmake --build $(BUILD) -j $(JOBS)
	cd $(BUILD) && ctest --output-on-failure -j $(JOBS) -E '^cluster\.(dask|slurm)$$'  # those are make cluster's
	@echo "Built and tested in $$(( ($$(date +%s) - $(began)) / 60 )) min"

# Tests of CONFIGURATIONS long, which nothing else runs: one at a time, for they load the machine.
test-all: test
	$(call install,$(LONG_PACKAGES))
	cd $(BUILD) && ctest --output-on-failure -C long -R '^long\.'
	$(MAKE) sanitize
	$(MAKE) fuzz FUZZ="-runs=20000 -seed=1"

# The tests of seconds, once built: all rooms but pictures and scenes, without what runs a machine for long.
SLOW := FitWitness.*:FitPlanned.MoveUnder*:FitPlanned.Chirp*:*EveryMember*:*Coverage.*:*Random.*:*LongRun.*:*Fuzz.*:*BodeLimitCycle.*:*TuneMargins.*:LargeScenario.*:StLong.*:CompareScene.*:*NoTextCrashes*:*OverAMillion*:*Witness.*:DesignCommand.TablesKeep*:*HasRoomForADay*:TunePlay.*:*BodePushes.*:*DesignFit.*:SweepCommand.*:SweepReport.*:PicturesFilm.*:PlcopenTables.*:LivePast.*:ModbusLx3vpLine.*:SizeCommand.*:Reference.*:EnvelopeSearch.*:*EveryStart*:*NoMemberIsForNothing*:FilterAdvice.*:*AdviceOfAGrid.*:SpeedLoopOfAnAxis.*:Lx3vpState.ARestored*:*AHundredMillion*:*DoNotDrift*
quick: setup
	$(call install,$(TEST_PACKAGES))
	$(CONFIGURE) -S . -B $(BUILD) -DBUILD_TESTING=ON > /dev/null
	cmake --build $(BUILD) -j $(JOBS) --target base_tests devices_tests plants_tests loop_tests sim_tests
	cd $(BUILD) && GTEST_FILTER='-$(SLOW)' ctest --output-on-failure -j $(JOBS) -R '^(base|devices|plants|loop|sim)\.part'

cluster: setup
	$(call install,$(TEST_PACKAGES) $(CLUSTER_PACKAGES))
	$(CONFIGURE) -S . -B $(BUILD) -DBUILD_TESTING=ON > /dev/null
	cmake --build $(BUILD) -j $(JOBS) --target drycut
	cd $(BUILD) && ctest --verbose -R '^cluster\.'

# The gateway with its packages from npm, of the versions in package-lock.json. Node.js may be of any origin.
opcua: setup
	$(call install,$(if $(shell command -v npm),,$(OPCUA_PACKAGES)) $(TEST_PACKAGES))
	$(CONFIGURE) -S . -B $(BUILD) -DBUILD_TESTING=ON > /dev/null
	cmake --build $(BUILD) -j $(JOBS) --target drycut
	mkdir -p $(BUILD)/opcua
	cp opcua/*.mjs opcua/*.json $(BUILD)/opcua
	cd $(BUILD)/opcua && npm ci --no-audit --no-fund
	cd $(BUILD) && ctest --verbose -R '^opcua\.'

python: setup
	$(call install,$(PYTHON_PACKAGES))
	@$(CONFIGURE) -S . -B $(BUILD) -DBUILD_TESTING=OFF $(PYTHON) > $(BUILD).log 2>&1 || { cat $(BUILD).log; exit 1; }
	@rm -f $(BUILD).log
	cmake --build $(BUILD) -j $(JOBS) --target drycut_python
	@echo "PYTHONPATH=$(CURDIR)/$(BUILD)/python /usr/bin/python3 -c 'import drycut; help(drycut)'"

# The site, which needs no server and no network: open build/docs/index.html. Tests look at it in Chromium where that is installed.
docs: setup
	$(call install,$(TEST_PACKAGES) $(DOCS_PACKAGES))
	$(CONFIGURE) -S . -B $(BUILD) -DBUILD_TESTING=ON > /dev/null
	cmake --build $(BUILD) -j $(JOBS) --target drycut
	cd $(BUILD) && ctest --output-on-failure -R '^docs\.'
	@echo "The documentation: $(CURDIR)/$(BUILD)/docs/index.html (open it in a browser)"

# What the notebooks of docs/notebooks say now, stored in them.
notebooks: python
	$(call install,$(NOTEBOOK_PACKAGES))
	PYTHONPATH=$(CURDIR)/$(BUILD)/python /usr/bin/python3 tests/python/test_notebooks.py --store

# Of the program as it is given away.
bench: profile
	$(call install,$(BENCH_PACKAGES))
	$(PROFILED) -DDRYCUT_BENCH=ON
	cmake --build $(RELEASE) -j $(JOBS) --target drycut_bench
	$(RELEASE)/drycut_bench

# A second compiler, with assertions, AddressSanitizer, UndefinedBehaviorSanitizer and the fuzzers' counters.
CLANG := $(BUILD)-clang
clang: setup
	$(call install,$(TEST_PACKAGES) $(CLANG_PACKAGES))
	CC=clang CXX=clang++ $(CONFIGURE) -S . -B $(CLANG) -DBUILD_TESTING=ON -DDRYCUT_SANITIZE=ON -DDRYCUT_FUZZ=ON

# ROOMS="devices sim": the tests of those rooms only. What runs a machine for long shows nothing new here: without it.
ROOMS ?= base devices plants renders loop sim scenes
space := $() $()
sanitize: clang
	cmake --build $(CLANG) -j $(JOBS) --target $(ROOMS:%=%_tests)
	cd $(CLANG) && LSAN_OPTIONS=suppressions=$(CURDIR)/tests/sanitize.supp GTEST_FILTER='-$(SLOW)' \
	  ctest --output-on-failure -j $(JOBS) -R '^($(subst $(space),|,$(strip $(ROOMS))))\.part'

# Every kind of input, 10 minutes each; FUZZ="-runs=2000 -seed=1" is the same work on every machine, KINDS="st il" are some of them.
FUZZ ?= -max_total_time=600
KINDS ?= $(patsubst tests/fuzz/%_fuzz.cpp,%,$(wildcard tests/fuzz/*_fuzz.cpp))
fuzz: clang
	cmake --build $(CLANG) -j $(JOBS) --target $(KINDS:%=fuzz_%)
	tests/fuzz/run $(CLANG) "$(KINDS)" $(FUZZ)

# Machines of every kind by both compilers: all that can be read of them is the same, to the bit.
ROWS := rotary_knife flying_saw_lx3vp_2m rotary_knife_mc_camin press_learning backlash_motor_encoder
same-bytes: all clang
	for c in $(BUILD) $(CLANG); do cmake --build $$c -j $(JOBS) --target drycut_rows && \
	  $$c/drycut_rows $(ROWS:%=scenes/%.yaml) > $$c/rows.txt || exit 1; done
	cmp $(BUILD)/rows.txt $(CLANG)/rows.txt

# docs/reference from the program's own tables.
reference: all
	rm -rf docs/reference
	$(BUILD)/drycut reference docs/reference
	rm docs/reference/drycut.1 docs/reference/drycut.bash

# The program as it is given away: the loop's rooms are compiled with what training says of their branches. Trained anew in
# every such build, by one thread, on scenes that are not the benchmark's; a profile that is kept goes stale with one line. What
# is trained comes to what the other came to, to the bit. Without ccache, which hands over paths in two ways: a profile is of a path.
RELEASE := $(BUILD)-release
TRAINING := $(filter-out scenes/three_way.yaml,$(sort $(wildcard scenes/*.yaml)))  # which compares others
PROFILED = $(CONFIGURE) -S . -B $(RELEASE) -DCMAKE_CXX_COMPILER_LAUNCHER= -DBUILD_TESTING=OFF -DDRYCUT_BENCH=OFF -DDRYCUT_PYTHON=OFF
profile: setup
	rm -rf $(RELEASE)/profile
	$(PROFILED) -DDRYCUT_PROFILE=generate > $(RELEASE).log 2>&1 || { cat $(RELEASE).log; exit 1; }
	cmake --build $(RELEASE) -j $(JOBS) --target drycut_rows
	$(RELEASE)/drycut_rows $(TRAINING) > $(RELEASE)/trained.txt
	$(PROFILED) -DDRYCUT_PROFILE=use > $(RELEASE).log 2>&1 || { cat $(RELEASE).log; exit 1; }
	@rm -f $(RELEASE).log
release: profile
	$(call install,$(PYTHON_PACKAGES))
	$(PROFILED) $(PYTHON)
	cmake --build $(RELEASE) -j $(JOBS) --target all drycut_rows
	$(RELEASE)/drycut_rows $(TRAINING) | cmp - $(RELEASE)/trained.txt

# Debian packages of the program, of the library and of the Python package.
deb: release
	$(call install,dpkg-dev)
	cd $(RELEASE) && SOURCE_DATE_EPOCH=$$(git log -1 --format=%ct) cpack

lint: setup
	$(call install,$(LINT_PACKAGES) $(TEST_PACKAGES))
	clang-format --dry-run -Werror $(SOURCES)
	$(CONFIGURE) -S . -B $(BUILD)-lint -DBUILD_TESTING=ON -DDRYCUT_UNITY=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON
	printf '%s\n' $(filter %.cpp,$(SOURCES)) | xargs -P $(JOBS) -n 4 clang-tidy -quiet -p $(BUILD)-lint

# clang-tidy over what the last day changed, at most TIDY_MOST files, the latest first.
TIDY_MOST ?= 40
tidy: setup
	$(call install,$(LINT_PACKAGES) $(TEST_PACKAGES))
	$(CONFIGURE) -S . -B $(BUILD)-lint -DBUILD_TESTING=ON -DDRYCUT_UNITY=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON > /dev/null
	git log --since=1.day --name-only --format= --diff-filter=AM -- '*.cpp' | awk 'NF && !seen[$$0]++' | \
	  while read -r f; do [ -f "$$f" ] && grep -qF "/$$f\"" $(BUILD)-lint/compile_commands.json && echo "$$f"; done | head -n $(TIDY_MOST) | \
	  xargs -r -P $(JOBS) -n 1 clang-tidy -quiet -p $(BUILD)-lint

format:
	$(call install,$(LINT_PACKAGES))
	clang-format -i $(SOURCES)

# The models of the machines' parts, made anew where their OpenSCAD sources are newer (-B: all).
MODELS := $(patsubst %.scad,%.stl,$(filter-out %/common.scad,$(wildcard scenes/meshes/*.scad)))
meshes:
	$(call install,openscad)
	$(MAKE) $(MODELS)
scenes/meshes/%.stl: scenes/meshes/%.scad scenes/meshes/common.scad
	openscad -q --export-format binstl -o $@ $<

clean:
	rm -rf $(BUILD) $(RELEASE) $(CLANG) $(BUILD)-lint out
