# The front door. Thin: installs what is missing, then CMake does the work.
#
#   make demo    the rotary knife line: builds, runs it, says where the report is
#   make test    builds and runs all tests
#   make bench   speed beside stock Bullet (and MuJoCo), in one run
#   make         builds build/drycut
#   make sanitize, make lint, make format, make meshes: for those who change the code

BUILD    ?= build
JOBS     ?= $(shell nproc)
PACKAGES := cmake ninja-build pkg-config libbullet-dev libosmesa6-dev libpng-dev libcairo2-dev libassimp-dev libyaml-cpp-dev \
            libmuparser-dev libudunits2-dev libnlopt-cxx-dev libcli11-dev libfmt-dev nlohmann-json3-dev gnuplot-nox \
            fonts-dejavu-core libjs-dygraphs ffmpeg
TEST_PACKAGES  := libgtest-dev libgmock-dev
BENCH_PACKAGES := libmujoco-dev
LINT_PACKAGES  := clang-format clang-tidy
SOURCES := $(wildcard devices/*.?pp devices/*/*.?pp devices/*/*/*.?pp plants/*.?pp renders/*.?pp sim/*.?pp sim/*/*.?pp sim/*/*/*.?pp tests/*.?pp tests/*/*.?pp)

CONFIGURE := cmake -G Ninja -DCMAKE_BUILD_TYPE=Release

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

.PHONY: all setup demo test bench sanitize lint format meshes clean

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

test: setup
	$(call install,$(TEST_PACKAGES))
	$(CONFIGURE) -S . -B $(BUILD) -DBUILD_TESTING=ON
	cmake --build $(BUILD) -j $(JOBS)
	cd $(BUILD) && ctest --output-on-failure -j $(JOBS)

bench: setup
	$(call install,$(BENCH_PACKAGES))
	$(CONFIGURE) -S . -B $(BUILD) -DDRYCUT_BENCH=ON
	cmake --build $(BUILD) -j $(JOBS) --target drycut_bench
	$(BUILD)/drycut_bench

sanitize: setup
	$(call install,$(TEST_PACKAGES))
	$(CONFIGURE) -S . -B $(BUILD)-sanitize -DBUILD_TESTING=ON -DDRYCUT_SANITIZE=ON
	cmake --build $(BUILD)-sanitize -j $(JOBS)
	cd $(BUILD)-sanitize && LSAN_OPTIONS=suppressions=$(CURDIR)/tests/sanitize.supp ctest --output-on-failure -j $(JOBS)

lint: setup
	$(call install,$(LINT_PACKAGES) $(TEST_PACKAGES))
	clang-format --dry-run -Werror $(SOURCES)
	$(CONFIGURE) -S . -B $(BUILD)-lint -DBUILD_TESTING=ON -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON
	printf '%s\n' $(filter %.cpp,$(SOURCES)) | xargs -P $(JOBS) -n 4 clang-tidy -quiet -p $(BUILD)-lint

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
	rm -rf $(BUILD) $(BUILD)-sanitize $(BUILD)-lint out
