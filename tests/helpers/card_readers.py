"""Readers of the cards, by the printed grammar of each program and nothing else."""

import csv
import json

import numpy as np


def words(line):
    return [w.strip() for w in line.split(",")]


def abaqus(text):
    """Keyword lines begin with one star, comments with two; E0 and nu; g, k, tau a line."""
    blocks, keyword = {}, None
    for line in text.splitlines():
        if line.startswith("**") or not line.strip():
            continue
        if line.startswith("*"):
            keyword = line.replace(" ", "").upper()
            blocks[keyword] = []
        else:
            blocks[keyword].append([float(w) for w in words(line)])
    (young, nu) = blocks["*ELASTIC,MODULI=INSTANTANEOUS"][0]
    g, k, tau = np.array(blocks["*VISCOELASTIC,TIME=PRONY"]).T
    assert any(key.startswith("*MATERIAL,NAME=") for key in blocks)
    for reference_c, c1, c2 in blocks.get("*TRS,DEFINITION=WLF", []):
        assert -100 < reference_c < 200
        assert c1 > 0
        assert c2 > 0
    assert np.all(g > 0)
    assert g.sum() < 1
    np.testing.assert_array_equal(g, k)
    return series(young / 2 / (1 + nu), g, tau)


def series(G_0, g, tau):
    def modulus(f):
        s = 2j * np.pi * np.multiply.outer(f, tau)
        return G_0 * (1 - g.sum() + (s / (1 + s)) @ g)

    return modulus


def ansys(text):
    """Two materials: by series, and by points of frequency, storage, loss."""
    elastic, prony, points, into = {}, {}, {}, None
    for line in text.splitlines():
        w = words(line)
        if line.startswith("!") or not line.strip() or w[0] == "/UNITS":
            continue
        if w[0] == "MP":
            elastic[w[2], w[1]] = float(w[3])
        elif w[:2] == ["TB", "PRONY"]:
            into = prony.setdefault((w[2], w[5]), [None] * (2 * int(w[4])))
        elif w[0] == "TBDATA":
            first = int(w[1]) - 1
            assert len(w) <= 8
            into[first : first + len(w) - 2] = [float(v) for v in w[2:]]
        elif w[:2] == ["TB", "EXPERIMENTAL"]:
            into = points.setdefault((w[2], w[5]), [])
        elif w[0] == "TBPT":
            into.append([float(v) for v in w[2:]])
        else:
            raise AssertionError(line)
    g, tau = np.array(prony["1", "SHEAR"]).reshape(-1, 2).T
    assert prony["1", "BULK"] == prony["1", "SHEAR"]
    nu = elastic["1", "PRXY"]
    shear, bulk = (np.array(points["2", part]) for part in ("GMODULUS", "KMODULUS"))
    np.testing.assert_allclose(bulk[:, 1:] / shear[:, 1:], 2 * (1 + nu) / 3 / (1 - 2 * nu))
    return series(elastic["1", "EX"] / 2 / (1 + nu), g, tau), straight(*shear.T)


def straight(f, storage, loss):
    return lambda at: np.interp(at, f, storage) + 1j * np.interp(at, f, loss)


def nastran(text):
    """Large fields: eight columns, then four of sixteen; a star continues."""
    entries = []
    for line in text.splitlines():
        if line.startswith("$") or not line.strip():
            continue
        assert len(line) <= 72
        fields = [line[8 + 16 * k : 24 + 16 * k].strip() for k in range(4)]
        if line.startswith("*"):
            entries[-1] += fields
        else:
            entries.append([line[:8].strip().rstrip("*"), *fields])
    by = {(e[0], e[1]): e for e in entries}
    mat, matf = by["MAT1", "1"], by["MATF1", "1"]
    tables = {}
    for (name, number), e in by.items():
        if name == "TABLED1":
            data = e[9:]
            end = data.index("ENDT")
            tables[number] = np.array(data[:end], dtype=float).reshape(-1, 2).T
    E, G, GE = tables[matf[2]], tables[matf[3]], tables[matf[8]]
    np.testing.assert_allclose(E[1], 2 * (1 + float(mat[4])) * G[1], rtol=1e-7)
    assert float(mat[3]) in G[1]
    assert float(mat[8]) in GE[1]
    return lambda f: np.interp(f, *G) * (1 + 1j * np.interp(f, *GE))


def comsol(text):
    """Comments begin with %; columns by spaces."""
    rows = [line.split() for line in text.splitlines() if not line.startswith("%")]
    f, storage, loss, eta = np.array(rows, dtype=float).T
    np.testing.assert_allclose(loss / storage, eta, rtol=1e-8)
    said = [line[1:].split() for line in text.splitlines() if line.startswith("%")]
    G, tau = np.array([w[1:] for w in said if w[0] == "branch"], dtype=float).T
    long = next(float(w[w.index("=") + 1]) for w in said if "G_inf" in w)
    return series(long + G.sum(), G / (long + G.sum()), tau), straight(f, storage, loss)


def plain_csv(text):
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    f, storage, eta = (
        np.array([float(r[k]) for r in rows]) for k in ("frequency_hz", "storage_modulus_pa", "loss_factor")
    )
    return straight(f, storage, storage * eta)


def plain_json(text):
    p = json.loads(text)["prony"]
    G, tau = np.array([(t["g_pa"], t["tau_s"]) for t in p["terms"]]).T
    return series(p["g_0_pa"], G / p["g_0_pa"], tau)
