# `make` lists the targets.
VENV    := .venv
PYTHON  := python3
BIN     := $(VENV)/bin
READY   := $(VENV)/.ready
OUT     := out

# The tests start hundreds of processes: each would compile every room anew where this is set.
export PYTHONDONTWRITEBYTECODE :=

.DEFAULT_GOAL := help
.PHONY: help setup demo test test-long checks unit coverage lint types contracts collected format bench benchmark docs clean

help:          ## list the targets
	@awk -F':.*## ' '/^[a-z-]+:.*## /{printf "  make %-10s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

setup: $(READY) ## virtual environment in .venv with viscorig and its tools

$(READY): pyproject.toml scripts/setup.sh
	@PYTHON=$(PYTHON) VENV=$(VENV) sh scripts/setup.sh
	@touch $@

demo: $(READY) ## a whole experiment on the simulated rig, then the published case; all in out/
	@$(BIN)/viscorig demo --out $(OUT)

test: checks unit ## all checks, and all tests but the long ones

# Beside each other: the types take longest, and one processor.
checks: $(READY) ## style, types and import directions
	@$(MAKE) --no-print-directory --jobs 2 types lint contracts collected

lint: $(READY)
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --check .
	@$(BIN)/python scripts/docstrings.py

types: $(READY)
	@$(BIN)/mypy

contracts: $(READY)
	@$(BIN)/lint-imports

# Once, while the types are looked at: every process of the tests would compile all of them anew.
collected: $(READY)
	@$(BIN)/pytest --collect-only > $(VENV)/collected || { cat $(VENV)/collected; exit 1; }

# Of glibc's allocator: memory of large arrays is kept for the next ones, not asked of the system each time.
KEEPING := MALLOC_MMAP_THRESHOLD_=1000000000 MALLOC_TRIM_THRESHOLD_=1000000000 MALLOC_TOP_PAD_=67108864

# Three for two processors: one of them often waits, for a process or a time constant.
unit: $(READY) ## the tests that take less than some seconds each
	@OPENBLAS_NUM_THREADS=1 $(KEEPING) $(BIN)/pytest -n 3 --dist worksteal -m "not timing and not long"

test-long: $(READY) ## the tests that take longer, and those that look at a clock
	@$(BIN)/pytest -m timing
	@OPENBLAS_NUM_THREADS=1 $(BIN)/pytest -n 2 --dist worksteal -m "long and not timing"

coverage: $(READY) ## the test suite once more, with the lines it does not reach
	@OPENBLAS_NUM_THREADS=1 $(BIN)/pytest -n 2 --dist worksteal -m "not timing" --cov --cov-report=term

format: $(READY) ## rewrite the sources in the project's style
	@$(BIN)/ruff check --fix . ; $(BIN)/ruff format .

bench: $(READY) ## the performance table
	@$(BIN)/viscorig bench

docs: $(VENV)/.docs ## the documentation site, in out/site; broken links are errors
	@NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --strict --site-dir $(OUT)/site

$(VENV)/.docs: $(READY)
	@echo "adding what builds the site to $(VENV)"
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[docs]'
	@touch $@

benchmark: $(READY) ## seconds of this machine, kept in .benchmarks/ and compared with the run before
	@OPENBLAS_NUM_THREADS=1 $(BIN)/pytest benchmarks --benchmark-enable --benchmark-autosave --benchmark-compare

clean:         ## remove what make has made
	rm -rf $(VENV) $(OUT) .coverage .mypy_cache .pytest_cache .ruff_cache .import_linter_cache .hypothesis
