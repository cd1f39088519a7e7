# `make check` is every check there is, the same for people and machines: what `.ci/run` runs, listed in `start.py`.
BIN := .venv/bin
INSTALL := $(BIN)/uv pip install --quiet --python $(BIN)/python -c constraints.txt -b constraints.txt

.PHONY: check format lint types law test demo bench constraints clean

check:
	python3 start.py check

.venv/ready: pyproject.toml constraints.txt start.py
	python3 start.py test --version
	@echo "==> installing the tools for development"
	$(INSTALL) -e '.[plot,record,studio]' --group dev
	@touch $@

format: .venv/ready
	$(BIN)/ruff check --fix
	$(BIN)/ruff format

lint:
	python3 start.py check format lint

types law:
	python3 start.py check $@

test:
	python3 start.py test

demo: .venv/ready
	$(BIN)/gaitwright demo

bench: .venv/ready
	$(BIN)/gaitwright bench

# Names and versions of all that is ever installed, for every supported Python and system. No addresses, no hashes.
constraints: .venv/ready
	@echo "==> resolving every dependency to its newest version"
	printf 'hatchling\nuv\n' | $(BIN)/uv pip compile pyproject.toml - --universal --python-version 3.11 --upgrade --quiet \
	    --all-extras --group dev --group page --no-header --no-annotate --no-emit-index-url --no-emit-find-links \
	    --output-file constraints.txt

clean:
	rm -rf .venv runs dist build .pytest_cache .ruff_cache .hypothesis .import_linter_cache
	find src tests -name __pycache__ -type d -prune -exec rm -rf {} +
