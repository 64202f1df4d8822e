# Two commands on a fresh machine with Python >= 3.11, make and a C compiler: `make demo` and `make test`.

PYTHON ?= python3
VENV ?= .venv
WORKERS ?= 2
MANIFOLDS := $(wildcard manifolds/*.yaml)

BIN := $(VENV)/bin
STAMP := $(VENV)/installed
RUN := runs/demo

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:

.PHONY: help
help: ## this list
	@echo "make TARGET, where TARGET is one of"
	@sed -n 's/^\([a-z]*\):[^#]*## \(.*\)/  \1\t\2/p' $(firstword $(MAKEFILE_LIST)) | expand -t 12

.PHONY: setup
setup: $(STAMP) compiler ## a virtual environment with everything pinned in constraints.txt, once

.PHONY: demo
demo: setup ## compile two manifolds, train a field on a torus, judge it, plan with it, draw it
	$(BIN)/rsrm-gen manifolds/so3.yaml manifolds/torus.yaml --force
	$(BIN)/rsrm train examples/torus.yaml -o $(RUN) --force
	$(BIN)/rsrm eval $(RUN)
	$(BIN)/rsrm plan $(RUN) --from 2.5,1.0 --from 0.3,0.8
	@echo "The field, its level lines, the obstacles and some paths are drawn in $(RUN)/field.png and $(RUN)/field.pdf."

.PHONY: test
test: setup lint ## lint, types and all tests; fails if any of them does
	$(BIN)/pytest -q -n $(WORKERS)

.PHONY: lint
lint: $(STAMP) ## ruff and mypy
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/mypy

.PHONY: format
format: $(STAMP) ## rewrite the source as ruff has it
	$(BIN)/ruff check --fix
	$(BIN)/ruff format

.PHONY: update
update: $(STAMP) ## generate the code in generated/ and the table of its operations again, from manifolds/
	$(BIN)/rsrm-gen $(MANIFOLDS)
	$(BIN)/python -m rsrm_gen.compiler.operations docs/operations.md $(MANIFOLDS)

.PHONY: clean
clean: ## remove what was built, but not runs/
	rm -rf $(VENV) build dist .pytest_cache .mypy_cache .ruff_cache .hypothesis *.egg-info
	find rsrm_gen tests -name __pycache__ -type d -prune -exec rm -rf {} +

.PHONY: compiler
compiler:
	@command -v $(firstword $(CC)) >/dev/null || \
	  echo "No C compiler ($(CC)) was found: the C code is generated but neither compiled nor checked; torch is used."

# torch first: by its own, pip takes it from where the machine has it, and nothing later changes it.
$(STAMP): pyproject.toml constraints.txt
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	  { echo "Python 3.11 or newer is needed; $(PYTHON) is older or missing. Say make PYTHON=python3.12, for example."; exit 1; }
	$(PYTHON) -m venv $(VENV)
	$(BIN)/pip install -q --disable-pip-version-check -c constraints.txt torch
	$(BIN)/pip install -q --disable-pip-version-check -c constraints.txt -e '.[dev]'
	@touch $@
