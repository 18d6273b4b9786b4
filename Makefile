# Two commands on a fresh machine: `make reproduce` and `make test`. Both make .venv themselves.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
# tests/conftest.py says which tests stay with one worker, and which begin.
PYTEST := $(BIN)/python -m pytest -n $(or $(WORKERS),auto) --no-loadscope-reorder

# Without stored bytecode every process that a test starts would translate all modules anew.
unexport PYTHONDONTWRITEBYTECODE

# A quarter of the modules that are installed is ever imported: these are translated then, in place of all of them now.
INSTALL := $(BIN)/python -m pip install --quiet --no-compile --editable

# Kernels are compiled once, before workers and the processes that tests start would each compile them.
WARM := $(BIN)/macroslip doctor --warm

.PHONY: reproduce reproduce-all validate test check test-fast test-lowest test-deep release lint types docs bench clean

reproduce: $(VENV)/.figures  ## the paper's study: report.html, figures and summary.json in results/
	$(BIN)/python -m paper -o results

reproduce-all: $(VENV)/.figures  ## the same with the sample over values that were estimated
	$(BIN)/python -m paper -o results --all

validate: $(VENV)/.figures  ## the program beside what was measured: the figures of docs/measurements.md, and its table
	$(BIN)/python -m validation $(ARGS)

test: $(VENV)/.lint  ## what a contributor runs: the package's own tests, and one run of each command
	@echo "stage 1 of 2: format, lint and types, while kernels are compiled"
	@$(WARM) >/dev/null & warming=$$!; $(MAKE) --no-print-directory lint && wait $$warming
	@echo "stage 2 of 2: tests"
	$(PYTEST) -m "not deep and not check" $(ARGS)

check: $(VENV)/.lint  ## all else that has to hold: documentation, paper, validation, benchmarks, golden numbers, lowest versions, release
	@echo "stage 1 of 5: types on the other systems, while kernels are compiled"
	@$(WARM) >/dev/null & warming=$$!; $(MAKE) --no-print-directory types && wait $$warming
	@echo "stage 2 of 5: tests of documentation, paper, validation, benchmarks and golden numbers, and second examples"
	$(PYTEST) -m "check and not deep" $(ARGS)
	@echo "stage 3 of 5: speed beside the last state"
	$(BIN)/python -m benchmarks.pair --whole --turns 1
	@echo "stage 4 of 5: the lowest versions"
	$(BIN)/python .ci/lowest >.lowest.txt
	$(MAKE) test-lowest
	@echo "stage 5 of 5: the release"
	$(MAKE) release

release:  ## what a user installs: wheel and sdist, in fresh environments
	bash .ci/release

test-fast: $(VENV)/.ready  ## the loop of development, a minute once kernels are compiled
	$(PYTEST) -m "not slow and not deep and not check" $(or $(ARGS),tests)

test-deep: $(VENV)/.ready  ## a search with fresh random examples and long runs; REPEAT rounds
	for round in $$(seq $(or $(REPEAT),5)); do $(PYTEST) -m "hypothesis or deep" --hypothesis-profile deep $(ARGS) || exit 1; done

test-lowest:  ## input, a computed case and results with the lowest versions that pyproject.toml allows
	$(MAKE) VENV=.venv-lowest CONSTRAINTS='-c .lowest.txt' .venv-lowest/.ready
	.venv-lowest/bin/python -m pytest -n $(or $(WORKERS),auto) tests/input tests/case tests/loads tests/lubricant tests/bearing src/macroslip/result/simulate.py

lint: $(VENV)/.lint  ## format, lint, types on this system, workflows and Dockerfile
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/pyright
	$(BIN)/zizmor --offline --quiet .github
	$(BIN)/check-jsonschema --builtin-schema vendor.github-workflows .github/workflows/*.yml
	$(BIN)/check-jsonschema --builtin-schema vendor.github-issue-forms .github/ISSUE_TEMPLATE/[!c]*.yml
	@if [ -x $(BIN)/hadolint ]; then $(BIN)/hadolint Dockerfile; else echo "hadolint has no wheel for this system: the Dockerfile is not checked"; fi

types: $(VENV)/.lint  ## types on the other two of three systems
	printf '%s\n' Linux Windows Darwin | grep -vx "$$(uname -s)" | xargs -P 2 -I@ $(BIN)/pyright --pythonplatform @

docs: $(VENV)/.ready  ## the documentation site in build/docs; warnings are errors
	$(BIN)/python -m sphinx -W --keep-going -q -b html docs build/docs

bench: $(VENV)/.ready  ## the integrator against its rivals, measured here and now
	$(INSTALL) '.[bench]'
	@$(INSTALL) '.[lsoda]' 2>/dev/null || echo "LSODA (numbalsoda) is left out: it is built from source, and that needs gfortran, g++ and CMake"
	$(BIN)/python -m benchmarks $(ARGS)

# What is installed for more holds what is installed for less, so that pip works once.
$(VENV)/.made: pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { echo "macroslip needs Python 3.11 or newer; name one with: make PYTHON=python3.12 $(MAKECMDGOALS)"; exit 1; }
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --upgrade pip
	touch $@

$(VENV)/.figures: $(VENV)/.made
	$(INSTALL) '.[figures]' $(CONSTRAINTS)
	touch $@

$(VENV)/.ready: $(VENV)/.made
	$(INSTALL) '.[test]' $(CONSTRAINTS)
	touch $(VENV)/.figures $@

$(VENV)/.lint: $(VENV)/.made
	$(INSTALL) '.[test,lint]' $(CONSTRAINTS)
	touch $(VENV)/.figures $(VENV)/.ready $@

clean:
	rm -rf $(VENV) results
