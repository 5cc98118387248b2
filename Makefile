# Short commands around CMake; `make help` lists them.  Only make and a shell are needed to begin:
# tools/deps.sh says what else is missing and installs it.
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
PREFIX ?= /usr/local
DESTDIR ?=
FUZZ_SECONDS ?= 20
FUZZ_EVENTS ?= 1000000
TORTURE_MINUTES ?= 60
TORTURE_FLAGS ?=
MUTATE_FLAGS ?=
BENCH_SCENE ?= scenes/managed_ice.yaml
BENCH_FLAGS ?=
VALIDATE_FLAGS ?=
# Debian's own Python knows Debian's packages.
PYTHON ?= $(firstword $(wildcard /usr/bin/python3) python3)
CTEST = ctest --output-on-failure --no-label-summary -j$(JOBS)
STAMPS = build/stamps

.DEFAULT_GOAL = build
.PRECIOUS: $(STAMPS)/% build/%/build.ninja
# Every target with a line of help is a command, not a file.
.PHONY: $(shell awk -F ':.*## ' '/^[a-z-]+:.*## / { print $$1 }' Makefile)

# What `make install` installs, all of it: fram_fmu is what `fram fmu` puts into a unit.
build: build/release/build.ninja ## build the command, build/release/fram, and the library
	@cmake --build --preset release -j$(JOBS) --target fram_command fram_shared fram_static fram_fmu

build/%/build.ninja: CMakePresets.json | $(STAMPS)/core
	@cmake --preset $* --log-level=WARNING
build/fuzz/build.ninja build/clang/build.ninja: | $(STAMPS)/dev

# One test more than there are cores: those of scripts and browsers wait for much of their time.
test: build/release/build.ninja ## run every test
	@cmake --build --preset release -j$(JOBS)
	@cd build/release && $(CTEST) -j$$(($(JOBS) + 1)) --output-junit tests.xml

viewer: build/viewer/playback.html ## build the page that plays a run in a browser

build/viewer/playback.html: $(wildcard viewer/*.json viewer/*.mjs viewer/.npmrc viewer/src/*) | $(STAMPS)/viewer
	@tools/viewer.sh

demo: build ## run scenes/demo.yaml with a playback page, and say which files to look at
	@tools/demo.sh

site: | $(STAMPS)/site ## the documents as pages with search, build/site/index.html, which open from disk
	@$(PYTHON) tools/site/site.py

pictures: viewer build | $(STAMPS)/views $(STAMPS)/site ## screenshots of all pages at two widths, docs/pictures/pages
	@$(PYTHON) tools/pictures.py

scenes: build ## run the ready scenes of vessels on station for ten minutes each, results under out/
	@tools/scenes.sh

management: build ## run the ready scenes of ice management to their end, with a page of each: most of an hour of two cores
	@tools/management.sh

answers: build ## what README and tutorials say of ready scenes beside what these give now (minutes; ANSWERS_FLAGS="--long --write")
	@$(PYTHON) tools/answers.py $(ANSWERS_FLAGS)

readme-picture: viewer build | $(STAMPS)/views ## the moving picture of the README, docs/pictures/demo.webp (a minute)
	@$(PYTHON) tools/readme_picture.py

test-views: viewer build | $(STAMPS)/views ## the playback page in headless Chromium
	@cd build/release && $(CTEST) -L '^views$$'

test-kill: build ## kill -9 a run at FRAM_KILLS (50) random moments and resume it
	@FRAM="$(CURDIR)/build/release/fram" FRAM_KILLS=$${FRAM_KILLS:-50} $(PYTHON) tests/sim/test_kill.py

CYCLES ?= 10000
test-cycles: build/release/build.ninja ## CYCLES (10,000) random saves, loads, copies and steps of two worlds (minutes)
	@cmake --build --preset release -j$(JOBS) --target test_api_live
	@FRAM_CYCLES=$(CYCLES) CK_RUN_CASE=live CK_DEFAULT_TIMEOUT=7200 CK_FORK=no build/release/tests/test_api_live

python: build/python/build.ninja | $(STAMPS)/python ## the wheel of the Python package, under build/python
	@cmake --build --preset python -j$(JOBS) --target fram_shared fram_fmu
	@$(PYTHON) tools/python_wheel.py build/python build/python

wasm: build/viewer/playback.html | $(STAMPS)/core $(STAMPS)/wasm ## one page that simulates in a browser, build/wasm/fram.html (20 minutes the first time)
	@tools/wasm.sh

bench-python: build | $(STAMPS)/python ## what reading poses and outlines from Python costs, against its bound
	@$(PYTHON) bench/run_python.py $(BENCH_FLAGS)

bench-recording: build ## what recording costs in time and bytes, against its bounds
	@$(PYTHON) bench/run_recording.py $(BENCH_FLAGS)

books: build/release/build.ninja ## whether parts of the ice load add up to it in every step of every ready scene (half an hour, idle)
	@cmake --build --preset release -j$(JOBS) --target books_bench
	@$(PYTHON) bench/run_books.py $(BENCH_FLAGS)

test-sanitize: test-asan test-tsan ## run the tests under ASan + UBSan, and those with threads under TSan

# Statistics of many trials, and studies killed on the way: other tests of their rooms walk the same code, as those of
# crushing do for its oracles.
MANY_TRIALS = study/(worst|station|kills|annual_coverage|extremes_coverage|extremes_doubts)|ice/field_sized
# What the command says of scenarios, one key after another: how they are read is walked by fuzzers under sanitizers.
WORDS = idle_keys|sanity|sanity_gear|sanity_units|verdict|faults|vessel_list
# Left to the release build: scripts around the program, browsers, and commands of which each has its own test here or,
# as readers of hulls, its fuzzer.
test-asan: build/asan/build.ninja
	@cmake --build --preset asan -j$(JOBS)
	@cd build/asan && $(CTEST) -LE '^(package|tools|slurm|views|python)$$' \
		-E '^($(MANY_TRIALS)|ice/crushing_oracles|dynamics/oracles|cli/($(WORDS)|bench|packed_field|tutorials|capability_met|effective|check|field|hull_files|json|tracks|capability|channels|pressure|why|inputs|hull|manage|ice|results))$$'

test-tsan: build/tsan/build.ninja
	@cmake --build --preset tsan -j$(JOBS) --target tests_threads
	@cd build/tsan && $$(../../tools/plain_memory.sh) $(CTEST) -L '^threads$$' -LE '^runs$$'

# What is left out: scripts around the program, readers, which fuzzers built by clang walk further, what is made of runs
# that are there, and runs that are stopped, which are of the system and not of the compiler. What is not run is not
# built: lint has clang's warnings on it.
CLANG_ROOMS = base geometry bodies fluid dynamics ice vessel model sim runs api
test-clang: build/clang/build.ninja ## run the tests of a build by clang: the same hashes, to the bit
	@cmake --build --preset clang -j$(JOBS) --target fram_command example_controller $(CLANG_ROOMS:%=tests_%)
	@cd build/clang && $(CTEST) -LE '^(package|tools|slurm|python|fmi|views|cli|io|fuzz|study|results)$$' \
		-E '^(ice/field_sized|sim/(build_stopped|kill))$$'

test-bare: build/bare/build.ninja ## build without the optional libraries, and run the tests that meet them
	@cmake --build --preset bare -j$(JOBS) --target fram_command example_controller \
		tests_io tests_api tests_results
	@cd build/bare && $(CTEST) -L '^(io|cli|api|results)$$' \
		-E '^(cli/($(WORDS)|bench|packed_field|hull_files|check|effective|tracks|capability_met|channels|json)|io/geojson)$$'

lint: build/release/build.ninja $(STAMPS)/dev ## check form, includes, libm and the static analysers
	@tools/lint.sh

format: $(STAMPS)/dev ## put every C file into the form that lint asks for
	@tools/sources.sh '*.c' '*.h' | xargs clang-format -i

fuzz: build/fuzz/build.ninja ## fuzz every reader for FUZZ_SECONDS (20) each
	@cmake --build --preset fuzz -j$(JOBS) --target fuzz_targets
	@tools/fuzz.sh build/fuzz $(FUZZ_SECONDS) $(JOBS)

fuzz-fracture: build/release/build.ninja build/asan/build.ninja ## break FUZZ_EVENTS (1,000,000) random floes, and sheets as often
	@cmake --build --preset release -j$(JOBS) --target test_ice_fracture_fuzz test_ice_fracture_fuzz_sheet
	@cmake --build --preset asan -j$(JOBS) --target test_ice_fracture_fuzz test_ice_fracture_fuzz_sheet
	@tools/fuzz_fracture.sh build/release/tests build/asan/tests $(FUZZ_EVENTS)

.PHONY: torture torture-short mutate mutate-check

torture: build ## the campaign of faults for TORTURE_MINUTES (60), findings under out/torture (docs/torture.md)
	@$(PYTHON) tools/torture/torture.py --minutes $(TORTURE_MINUTES) --jobs $(JOBS) $(TORTURE_FLAGS)

torture-short: ## the first 150 cases of each part, in two minutes at most: the same ones on every machine
	@$(MAKE) --no-print-directory torture TORTURE_MINUTES=2 TORTURE_FLAGS="--cases 150 $(TORTURE_FLAGS)"

mutate: build/release/build.ninja ## make each small fault of tests/mutants and say which test caught it (hours)
	@$(PYTHON) tools/mutate/mutate.py --jobs $(JOBS) $(MUTATE_FLAGS)

mutate-check: ## whether each fault of tests/mutants still fits the code (seconds)
	@$(PYTHON) tools/mutate/mutate.py --check

bench: build ## measure the speed of BENCH_SCENE (managed ice); BENCH_FLAGS go to `fram bench`
	@build/release/fram bench $(BENCH_SCENE) $(BENCH_FLAGS)

bench-users: build ## scenes of users, step by step; BENCH_FLAGS="--old FRAM" beside an older build
	@$(PYTHON) bench/run_users.py $(BENCH_FLAGS)

bench-channel: build | $(STAMPS)/python ## what more and more channel behind a ship costs (its first call simulates 5 km: an hour)
	@$(PYTHON) bench/run_channel.py $(BENCH_FLAGS)

bench-peers: build | $(STAMPS)/peers ## Fram beside Bullet and ODE (Box3D, Jolt) on the same scenes; BENCH_FLAGS go to bench/run_peers.py
	@bench/run_peers.py $(BENCH_FLAGS)

test-slurm: build | $(STAMPS)/slurm ## studies by a real Slurm of four nodes on this machine, which it installs (as root)
	@cd build/release && $(CTEST) -L '^slurm$$'

test-statistics: build | $(STAMPS)/statistics ## fits of extremes beside scipy's and R's evd, which it installs (260 MB)
	@cd build/release && $(CTEST) -R '^study/statistics$$'

slurm-thousand: build | $(STAMPS)/slurm ## the same with 1,002 runs (SLURM_SEEDS=334 of three conditions)
	@FRAM=build/release/fram FRAM_SLURM_SEEDS=$(or $(SLURM_SEEDS),334) $(PYTHON) tests/slurm/test_arrays.py

slurm-overhead: build | $(STAMPS)/slurm ## what scheduling by Slurm costs a study, of 20 tasks of 12 s (10 minutes)
	@$(PYTHON) bench/slurm_overhead.py

extremes-coverage: build/release/build.ninja ## how often intervals of extremes hold the truth: 1,000 trials of each sample (15 minutes)
	@cmake --build --preset release -j$(JOBS) --target test_study_extremes_coverage test_study_annual_coverage
	@cd build/release && FRAM_TEST_LONG=1 CK_FORK=no ./tests/test_study_extremes_coverage
	@cd build/release && FRAM_TEST_LONG=1 CK_FORK=no ./tests/test_study_annual_coverage

acer-example: build/release/build.ninja ## the synthetic example of Naess, Gaidai and Karpa (2013), 100 samples (half a minute)
	@cmake --build --preset release -j$(JOBS) --target test_study_acer_example
	@FRAM_TEST_LONG=1 CK_FORK=no CK_DEFAULT_TIMEOUT=900 build/release/tests/test_study_acer_example

extremes-hours: build/release/build.ninja ## 100 long runs against what sets of 20 short ones say of them (half a minute)
	@cmake --build --preset release -j$(JOBS) --target test_study_three_hours
	@FRAM_TEST_LONG=1 CK_FORK=no CK_DEFAULT_TIMEOUT=900 build/release/tests/test_study_three_hours

bench-views: viewer build ## speed of the playback page with 10,000 floes, against its bounds
	@$(PYTHON) bench/run_playback.py $(BENCH_FLAGS)

validate: build | $(STAMPS)/validate $(STAMPS)/peers ## the validation book (VALIDATE_FLAGS=--quick: its short cases)
	@$(PYTHON) validation/run.py $(VALIDATE_FLAGS)

validate-status: ## which pages of the validation book were made on other code than there is now
	@$(PYTHON) validation/status.py

soak: build/release/build.ninja ## a million steps of a small packed field: no jitter, no drift (a few minutes)
	@cmake --build --preset release -j$(JOBS) --target test_dynamics_packed
	@FRAM_SOAK_STEPS=1000000 CK_FORK=no build/release/tests/test_dynamics_packed

coverage: build/coverage/build.ninja $(STAMPS)/dev ## line coverage of src/ by the tests
	@cmake --build --preset coverage -j$(JOBS)
	@tools/coverage.sh build/coverage $(JOBS)

install: build ## install under DESTDIR and PREFIX (/usr/local)
	@$(PYTHON) tools/manual_page.py build/release/fram build/release/fram.1
	@umask 022 && DESTDIR="$(DESTDIR)" cmake --install build/release --prefix "$(PREFIX)"
	@if [ -z "$(DESTDIR)" ] && [ "$$(id -u)" = 0 ] && command -v ldconfig >/dev/null; then ldconfig; fi

deb: | $(STAMPS)/core $(STAMPS)/deb ## Debian packages of this machine's kind under build/packages, checked by lintian
	@JOBS=$(JOBS) tools/package.sh deb

archive: | $(STAMPS)/core $(STAMPS)/deb ## a relocatable tar archive under build/packages
	@JOBS=$(JOBS) tools/package.sh archive

test-packages: build | $(STAMPS)/trial ## the packages and the archive in empty Debian 12 roots (as root, with a network)
	@JOBS=$(JOBS) tools/try_packages.sh

deps: ## install all that building and checking needs
	@tools/deps.sh --install core dev python

$(STAMPS)/%: tools/deps.sh
	@tools/deps.sh --install $*
	@mkdir -p $(@D) && touch $@

clean: ## remove what was built (installed packages stay)
	@rm -rf build out

help: ## this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-15s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)
