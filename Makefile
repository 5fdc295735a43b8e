# make demo: build and run the main job.   make test: all tests.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
SOURCES := $(shell find cpp src scenarios CMakeLists.txt pyproject.toml -type f -not -name '*.pyc' -not -name '*.so')

.PHONY: demo test clean prerequisites
.DELETE_ON_ERROR:

demo: $(VENV)/.built
	@$(BIN)/clearway demo --out demo-run

test: $(VENV)/.built $(VENV)/.test-ready
	@$(BIN)/python -m pytest -q

prerequisites:
	@command -v $(PYTHON) >/dev/null || { echo "Python is missing: apt-get install python3 python3-venv python3-dev"; exit 1; }
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { echo "Python 3.11 or newer is needed, $(PYTHON) is older: apt-get install python3.11 python3.11-venv python3.11-dev, then make PYTHON=python3.11"; exit 1; }
	@$(PYTHON) -c 'import venv, ensurepip' 2>/dev/null || { echo "Python's venv is missing: apt-get install python3-venv"; exit 1; }
	@$(PYTHON) -c 'import os, sys, sysconfig; sys.exit(not os.path.exists(os.path.join(sysconfig.get_paths()["include"], "Python.h")))' || { echo "Python's headers are missing: apt-get install python3-dev"; exit 1; }
	@command -v g++ >/dev/null || { echo "g++ is missing: apt-get install g++"; exit 1; }

$(BIN)/python: | prerequisites
	@$(PYTHON) -m venv $(VENV)

# A new build only where a source is newer; the second make demo runs at once.
$(VENV)/.built: $(SOURCES) | $(BIN)/python
	@echo "building Clearway (about two minutes the first time)"
	@CMAKE_BUILD_PARALLEL_LEVEL=$${CMAKE_BUILD_PARALLEL_LEVEL:-2} $(BIN)/python -m pip install --quiet --disable-pip-version-check .
	@touch $@

$(VENV)/.test-ready: pyproject.toml | $(VENV)/.built
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check '.[test]'
	@touch $@

clean:
	rm -rf $(VENV) build demo-run
