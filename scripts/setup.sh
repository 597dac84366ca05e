#!/bin/sh
# Makes the virtual environment. Needs Python 3.11 or newer with pip; says in one line what is missing.
set -eu
PYTHON=${PYTHON:-python3}
VENV=${VENV:-.venv}

if ! "$PYTHON" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then
    echo "viscorig needs Python 3.11 or newer as '$PYTHON' (set PYTHON=...)" >&2
    exit 1
fi

# Debian splits ensurepip off into python3-venv.
if ! "$PYTHON" -c 'import ensurepip, venv' 2>/dev/null; then
    if [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null; then
        echo "installing python3-venv"
        apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq python3-venv >/dev/null
    else
        echo "missing: run  sudo apt-get install python3-venv" >&2
        exit 1
    fi
fi

echo "setting up $VENV"
[ -x "$VENV/bin/python" ] || "$PYTHON" -m venv "$VENV"
"$VENV/bin/python" -m pip install --quiet --disable-pip-version-check --editable '.[dev]'
