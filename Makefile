# What one types to try, test and check fairlead. `make help` lists it all.
# Everything is installed into .venv beside this file; nothing outside this folder is touched.
# Every path below is relative, so that the folder's own name may contain spaces.

PYTHON ?=
VENV := .venv
RUN := $(VENV)/bin/python
MODEL ?= single_bend
TESTS ?= tests
BENCH ?= everything.py
HARD ?=
INVARIANCE ?=
WORKERS ?= auto
# Some machines forbid Python to keep what it compiled. Here it may: each process of a test, or of a command, would
# otherwise compile fairlead and its libraries again, two seconds at a time. `make clean` removes it.
export PYTHONDONTWRITEBYTECODE :=
AS_ROOT := $(if $(filter 0,$(shell id -u)),,sudo -n)

.PHONY: help demo test test-all test-every browser hard invariance lint types bench docs pictures clean
.DEFAULT_GOAL := help

help:  ## list these commands
	@awk -F '[:#]+' '/^[a-z-]+:.*##/ { printf "  make %-11s%s\n", $$1, $$NF }' Makefile
	@echo "  PYTHON=/path/to/python3.12 chooses the Python that the first call installs with."

demo: $(VENV)/fairlead.done  ## install, run the single bend with little and much friction, leave a page to look at
	@echo "The first run on a machine compiles the engine once, which takes half a minute."
	$(RUN) -m fairlead run $(MODEL) --report --force --out results/$(MODEL)
ifeq ($(MODEL),single_bend)
	$(RUN) -m fairlead run $(MODEL) --set mu=0.6 --report --force --out results/$(MODEL)_mu_0.6
	$(RUN) -m fairlead report results/$(MODEL)_mu_0.6 results/$(MODEL) --out results/$(MODEL)/report.html
endif
	@echo "Open results/$(MODEL)/report.html in a browser."

# Threads of numpy's BLAS wait for each other by turning round, which takes the cores from the other workers.
ONE_THREAD := OPENBLAS_NUM_THREADS=1

# Neighbours share runs, so each worker takes a stretch of the tests and steals from the end of another's.
test: engine  ## install with what the tests need, run the tests (WORKERS=0 in one process)
	$(ONE_THREAD) $(RUN) -m pytest -n $(WORKERS) --maxprocesses 8 --dist worksteal -m "not slow" $(TESTS)

test-all: engine  ## the rest of the tests, those that take long
	$(RUN) -m pytest -n $(WORKERS) --maxprocesses 8 --dist worksteal -m "slow and not exhaustive" $(TESTS)

test-every: engine  ## what test-all draws from: all values of every parameter (before a release)
	$(RUN) -m pytest -n $(WORKERS) --maxprocesses 8 --dist worksteal -m exhaustive $(TESTS)

# A worker would wait for the loop that another one compiles. That of rodas is exported by tests as well: all is made of
# such bitcode, so that one process types what the loops have in common, once, and another what tests of rooms call.
.PHONY: engine
engine: $(VENV)/test.done
	$(RUN) -m tests.compiling

browser:  ## install Debian's chromium, which the tests of pages drive; without it they are skipped
	@if command -v chromium >/dev/null && command -v chromedriver >/dev/null; then echo "chromium is installed"; \
	elif command -v apt-get >/dev/null && $(AS_ROOT) apt-get update -q >/dev/null 2>&1 \
	  && $(AS_ROOT) apt-get install -q -y chromium chromium-driver >/dev/null 2>&1; then echo "chromium was installed"; \
	else echo "chromium cannot be installed here: the browser tests are skipped"; fi

hard: $(VENV)/test.done  ## play all hard cases on all engines, write docs/stability.md (more with HARD="--only tether --table")
	$(RUN) -m tests.hard $(HARD)

invariance: $(VENV)/test.done  ## the same answer under other names, orders, processors, BLAS (fresh scenes with INVARIANCE="--fresh 20")
	$(RUN) -m tests.invariance $(INVARIANCE)

lint: $(VENV)/lint.done link-tree  ## look for mistakes and style with ruff
	$(RUN) -m ruff check .

types: $(VENV)/lint.done link-tree  ## check types with mypy
	MYPYPATH=typing $(RUN) -m mypy -p fairlead

bench: $(VENV)/bench.done  ## error, time and counters beside peers (an hour and a half; one case with BENCH="compare.py --case belt")
	$(RUN) benchmarks/$(BENCH)

docs: $(VENV)/docs.done  ## build the site into docs/_site, with pages and figures from the classes made again
	$(RUN) docs/make.py
	$(RUN) -m sphinx -q -W --keep-going -b html docs docs/_site
	@echo "Open docs/_site/index.html in a browser."

pictures: $(VENV)/test.done  ## take the pictures of pages in README and docs again, with a browser
	$(RUN) -m tests.browser

clean:  ## remove .venv, results and everything generated
	rm -rf $(VENV) typing results build dist .pytest_cache .mypy_cache .ruff_cache .hypothesis src/*.egg-info
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

# Type checkers cannot follow the package-dir mapping of pyproject.toml (components/ is
# fairlead.components), so they are given a tree of links that looks like the installed package.
.PHONY: link-tree
link-tree:
	@rm -rf typing && mkdir -p typing/fairlead
	@cd typing/fairlead && for each in ../../src/fairlead/* ../../components ../../models; do ln -s "$$each" .; done

# A stamp per set of dependencies: a second call installs nothing unless pyproject.toml changed.
# --no-compile halves the time: Python compiles what is imported, when it is first imported.
$(VENV)/fairlead.done: EXTRAS := [compile]
$(VENV)/test.done: EXTRAS := [test]
$(VENV)/lint.done: EXTRAS := [lint]
$(VENV)/bench.done: EXTRAS := [bench]
$(VENV)/docs.done: EXTRAS := [docs]
$(VENV)/%.done: pyproject.toml | $(VENV)/created
	@echo "Installing fairlead$(EXTRAS) into $(VENV) (about a minute the first time) ..."
	@$(RUN) -m pip install --quiet --disable-pip-version-check --no-compile --editable '.$(EXTRAS)' || { \
	  echo "pip could not install the dependencies (its own words are above)."; \
	  echo "Without a connection to a package index, point pip to one: PIP_INDEX_URL=https://... make $(MAKECMDGOALS)"; \
	  exit 1; }
	@touch $@

# Take the first Python of 3.11 or newer that runs; say how to get one, or its venv module, if there is none.
ENOUGH := import sys; sys.exit(sys.version_info < (3, 11))
$(VENV)/created:
	@for python in $(or $(PYTHON),python3 python3.13 python3.12 python3.11 python); do \
	  if "$$python" -c '$(ENOUGH)' 2>/dev/null; then found=$$python; break; fi; \
	done; \
	if [ -z "$$found" ]; then \
	  here=$$($(or $(PYTHON),python3) --version 2>/dev/null) || here="no $(or $(PYTHON),python3)"; \
	  echo "fairlead needs Python 3.11 or newer; here is $$here."; \
	  echo "  Debian, Ubuntu:  sudo apt install python3 python3-venv"; \
	  echo "  Fedora:          sudo dnf install python3"; \
	  echo "  macOS:           brew install python   (or the installer from https://www.python.org/downloads)"; \
	  echo "  installed elsewhere:  make $(MAKECMDGOALS) PYTHON=/path/to/python3.12"; \
	  exit 1; \
	fi; \
	if ! "$$found" -c 'import venv, ensurepip' 2>/dev/null; then \
	  echo "$$found comes without the venv and ensurepip modules, which make a private environment."; \
	  echo "  Debian, Ubuntu:  sudo apt install python3-venv"; \
	  echo "  or another one:  make $(MAKECMDGOALS) PYTHON=/path/to/python3.12"; \
	  exit 1; \
	fi; \
	rm -rf $(VENV); "$$found" -m venv $(VENV)
	@touch $@
