# Every target works first and alone in a fresh clone: it makes .venv and installs what it needs.
# Python 3.11 or newer with venv is the only thing that must be there; PYTHON=... names another.

PYTHON ?=
PY := .venv/bin/python

# Tests start Python a hundred times and more: what it compiles is kept.
unexport PYTHONDONTWRITEBYTECODE

.DEFAULT_GOAL := help
.PHONY: help demo test lint verify manual bench report docs clean

help:
	@echo "make demo     run the four-point bending beam and draw it"
	@echo "make test     all tests but those of minutes"
	@echo "make lint     ruff and mypy"
	@echo "make verify   the studies of minutes against reference answers"
	@echo "make manual   all benchmarks, and the pages that show them in docs/verification"
	@echo "make bench    measured ratios, all in one run"
	@echo "make report   what accuracy costs, measured anew into docs/accuracy_cost"
	@echo "make docs     the manual as HTML in docs/_build"
	@echo "make clean    remove everything that can be made again"

demo: .venv/.kernels
	.venv/bin/nmm demo

# Each worker of a fresh clone would compile the kernels of contact for itself.
test: .venv/.dev .venv/.kernels
	$(PY) -m pytest -n auto --dist worksteal -m "not slow"

lint: .venv/.dev
	.venv/bin/ruff check .
	.venv/bin/ruff format --check .
	.venv/bin/mypy

verify: .venv/.dev
	$(PY) -m pytest -m slow --durations=0

manual: .venv/.runtime
	.venv/bin/nmm verify --slow --out docs/verification

bench: .venv/.dev
	@mkdir -p build
	$(PY) -m pytest benchmarks --benchmark-json=build/benchmarks.json
	@$(PY) benchmarks/page.py build/benchmarks.json

report: .venv/.runtime
	$(PY) examples/studies/report.py docs/accuracy_cost

docs: .venv/.docs
	$(PY) -m sphinx -q -W --keep-going docs docs/_build
	@echo "docs/_build/index.html"

clean:
	rm -rf .venv build dist runs docs/_build .pytest_cache .mypy_cache .ruff_cache .hypothesis
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

.venv/.made:
	@for python in "$(PYTHON)" python3.14 python3.13 python3.12 python3.11 python3 python; do \
	  if [ -n "$$python" ] && \
	     "$$python" -c 'import sys, venv; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then \
	    echo "making .venv with $$python"; "$$python" -m venv .venv && touch $@; exit $$?; fi; done; \
	  echo "no Python 3.11 or newer with venv found: name one, as in make PYTHON=/path/to/python3.11"; \
	  exit 1

.venv/.runtime: .venv/.made pyproject.toml
	$(PY) -m pip install --quiet --disable-pip-version-check --editable .
	@touch $@

# Kernels of contact, once; those that change later are compiled by the run that needs them.
.venv/.kernels: .venv/.runtime
	.venv/bin/nmm compile
	@touch $@

.venv/.dev: .venv/.made pyproject.toml
	$(PY) -m pip install --quiet --disable-pip-version-check --editable '.[dev]'
	@touch $@ .venv/.runtime

.venv/.docs: .venv/.made pyproject.toml
	$(PY) -m pip install --quiet --disable-pip-version-check --editable '.[docs]'
	@touch $@
