SHELL := bash
.SHELLFLAGS := -eu -o pipefail -c
.DEFAULT_GOAL := help

VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.polhode-ready
BROWSER := tests/browser/node_modules/.ready
FRONT_END := src/polhode/view/built/sources.sha256
EXTRAS := all,docs,test,dev
QUIETLY := -qq --disable-pip-version-check
PYTHON ?= $(shell for python in python3.11 python3.12 python3.13 python3; do \
	$$python -c 'import sys, ensurepip, venv; sys.exit(sys.version_info < (3, 11))' 2>/dev/null \
	&& echo $$python && break; done)

TEXTS ?= $(wildcard ../shared/reviews/*/)

.PHONY: help demo test check bench golden reviews proof wheel docs lock clean

help:
	@echo 'make demo    work through the systems of the problem set; writes tour/index.html'
	@echo 'make test    run the tests; make test T=tests/derive runs a part of them'
	@echo 'also: check bench golden reviews proof wheel docs lock clean (see CONTRIBUTING.md)'

# The lock file fixes every version; the extras are then resolved against it alone, so that a
# requirement missing from it is an error here and not a surprise elsewhere.
$(READY): pyproject.toml requirements.lock
	@echo 'preparing $(VENV) (a minute or two, once)'
	@test -n '$(PYTHON)' || { echo 'polhode needs Python 3.11 or newer, with venv' >&2; exit 1; }
	@test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	@$(BIN)/python -m pip install $(QUIETLY) -r requirements.lock
	@$(BIN)/python -m pip install $(QUIETLY) --no-index --no-build-isolation -e '.[$(EXTRAS)]'
	@touch $@

# Built with the package; again where its sources have changed since.
$(FRONT_END): build_frontend.py $(wildcard web/*.*) $(wildcard web/src/*) $(wildcard web/src/*/*) | $(READY)
	@$(BIN)/python build_frontend.py

demo: $(READY) $(FRONT_END)
	@$(BIN)/polhode tour

# Axe, and a browser for machines that have none.
$(BROWSER): tests/browser/package-lock.json
	@cd tests/browser && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error
	@touch $@

test: $(READY) $(FRONT_END) $(BROWSER)
	@$(BIN)/python -m pytest -n 2 --dist worksteal $(T)

check: $(READY)
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/mypy --strict src
	@cd web && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error && npm run check --silent

bench: $(READY)
	@$(BIN)/python -m pip install $(QUIETLY) -r benchmarks/requirements.txt
	@$(BIN)/python benchmarks/run.py
	@$(BIN)/python benchmarks/growth.py
	@$(BIN)/python benchmarks/contact.py
	@$(BIN)/python benchmarks/audit.py

# Verdicts and marks against those committed; `make golden ACCEPT=--write` accepts what is found.
golden: $(READY)
	@$(BIN)/python benchmarks/golden.py $(ACCEPT)

# Marks against the truth, on texts of others, which are no part of this repository.
reviews: $(READY)
	@$(BIN)/python benchmarks/reviews.py $(TEXTS)

# One log for each campaign, so that an interrupted proof is not lost; `make proof/algebra.txt` runs
# one of them again, and `make proof` those whose log is missing or older than the campaign.
CAMPAIGNS := $(patsubst tests/proof/test_%.py,%,$(wildcard tests/proof/test_*.py))
LOGS := $(CAMPAIGNS:%=proof/%.txt)

proof: proof/log.txt

proof/log.txt: $(LOGS)
	@cat $^ > $@

proof/%.txt: tests/proof/test_%.py | $(READY)
	@mkdir -p $(@D)
	@{ $(BIN)/python tests/proof/heading.py $*; \
		$(BIN)/python -m pytest $< --hypothesis-profile proof -n 2 -vv --no-header; } | tee $@.part
	@mv $@.part $@

docs: $(READY)
	@NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --quiet --strict

wheel: $(READY)
	@rm -rf dist build/wheel
	@$(BIN)/python -m build --wheel --no-isolation --outdir dist . | tail -n 1
	@for extras in base fast,figures,study; do \
		$(PYTHON) -m venv build/wheel/$$extras; \
		test $$extras = base && named= || named="[$$extras]"; \
		build/wheel/$$extras/bin/pip install $(QUIETLY) -c requirements.lock "$$(echo dist/*.whl)$$named"; \
		(cd build/wheel/$$extras && bin/python -I $(CURDIR)/tests/wheel_smoke.py $$extras); \
	done

# `make lock` takes the newest of everything; what is named here is needed to build polhode itself.
lock:
	@rm -rf build/lock
	@$(PYTHON) -m venv build/lock
	@build/lock/bin/pip install $(QUIETLY) hatchling hatch-vcs editables -e '.[$(EXTRAS)]'
	@{ echo '# Exact versions for .venv and CI, written by `make lock`.'; \
		build/lock/bin/pip freeze --all --exclude-editable | grep -v '^pip==' \
		| sed 's/^heyoka==.*/&; sys_platform == "linux"/'; } > build/requirements.lock
	@mv build/requirements.lock requirements.lock

clean:
	rm -rf $(VENV) build dist site tour
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
