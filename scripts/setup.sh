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

# What Qt asks of the system, without a screen and with one; and a screen without a monitor, for the tests.
QT_PACKAGES="libegl1 libgl1 libxkbcommon0 libdbus-1-3 libfontconfig1 libglib2.0-0 fonts-dejavu-core \
libxcb-cursor0 libxcb-icccm4 libxcb-keysyms1 libxcb-shape0 libxkbcommon-x11-0 xvfb xdotool"
if command -v dpkg-query >/dev/null; then
    missing=
    for package in $QT_PACKAGES; do
        # Newer releases name some of them with t64 behind.
        dpkg-query -W -f '${Status}\n' "$package" "${package}t64" 2>/dev/null | grep -q "ok installed" \
            || missing="$missing $package"
    done
    if [ -n "$missing" ] && [ "$(id -u)" = 0 ]; then
        echo "installing$missing"
        apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq $missing >/dev/null
    elif [ -n "$missing" ]; then
        echo "the window and its tests need: run  sudo apt-get install$missing" >&2
    fi
fi

echo "setting up $VENV"
[ -x "$VENV/bin/python" ] || "$PYTHON" -m venv "$VENV"
# Python compiles what it uses when it does: half a minute less, most of it for what nobody imports.
"$VENV/bin/python" -m pip install --quiet --quiet --disable-pip-version-check --no-compile --editable '.[dev]'
