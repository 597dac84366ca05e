import re

import numpy as np
import pytest

from fitting.laws import LAWS
from fitting.plate.plate_numbers import tolerance
from fitting.stated.layers import Glue, Orthotropy
from fitting.stated.patches import Patch
from fitting.stated.tolerances import OF_TEMPERATURE, STATED
from instrument.errors import BadInput
from instrument.files.specimen_file import read_specimen
from instrument.paper_case import case_file

GOOD = case_file("zn1.toml").read_text(encoding="utf-8")


def write(tmp_path, text):
    path = tmp_path / "specimen.toml"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def test_shipped_specimen_is_the_papers():
    s = read_specimen(case_file("zn1.toml"))
    assert (s.length_m, s.width_m, s.boundary) == (pytest.approx(0.3002), pytest.approx(0.1999), "cantilever")
    assert s.substrate.young_pa == pytest.approx(68.9e9)
    assert s.constraining.thickness_m == pytest.approx(0.3e-3)
    assert s.modal_ratios[0] == pytest.approx(0.0029)
    assert s.pickup_m == pytest.approx((0.06, 0.06))
    assert s.mesh == (40, 26)
    # the printed start values are Young's moduli
    assert s.core.law.g0_pa == pytest.approx(1.2e6 / (2 * 1.49), rel=1e-4)
    assert s.core.law.ginf_pa == pytest.approx(12.5e6 / (2 * 1.49), rel=1e-4)


LAW_TABLES = {
    "fractional-zener": "g0_mpa = 0.3\nginf_mpa = 4.0\ntau_s = 1e-4\nalpha = 0.8",
    "constant": "g_mpa = 0.5\nloss_factor = 0.0",
    "isd112": "",
    "generalised-maxwell": "g_inf_mpa = 0.2\ng_mpa = [0.3, 1.0]\ntau_s = [1e-3, 1e-4]",
    "ghm": "g0_mpa = 0.3\nalpha = [0.8, 6.0]\nzeta = [1.5, 0.9]\nomega_rad_s = [1e3, 2e4]",
    "adf": "g0_mpa = 0.3\ndelta = [0.8, 6.0]\nomega_rad_s = [4e2, 8e3]",
    "table": "frequency_hz = [14.0, 300.0]\nstorage_modulus_pa = [3e5, 1e6]\nloss_factor = [0.3, 0.9]",
    "smooth": "frequency_hz = [14.0, 300.0]\ng_mpa = [0.3, 1.0]\nloss_factor = [0.3, 0.9]",
}


def with_law(kind, table):
    return re.sub(r"\[core\.law\].*?\n\n", f'[core.law]\nkind = "{kind}"\n{table}\n\n', GOOD, flags=re.S)


@pytest.mark.parametrize("kind", sorted(LAWS))
def test_every_law_can_be_read(tmp_path, kind):
    path = write(tmp_path, with_law(kind, LAW_TABLES[kind]))
    assert read_specimen(path).core.law.kind == kind


def test_knots_are_read_with_the_law_and_are_no_parameters(tmp_path):
    law = read_specimen(write(tmp_path, with_law("smooth", LAW_TABLES["smooth"]))).core.law
    assert law.frequency_hz == (14.0, 300.0)
    assert law.g_pa == pytest.approx((0.3e6, 1e6))
    assert law.names == ["g_1_pa", "g_2_pa", "loss_factor_1", "loss_factor_2"]


def test_core_and_mesh_may_be_left_out_and_the_reading_stated(tmp_path):
    bare = re.sub(r"\[constraining\].*?\[damping\]", "[damping]", GOOD, flags=re.S)
    s = read_specimen(write(tmp_path, bare))
    assert s.core is None
    assert s.constraining is None
    more = GOOD + "\n[mesh]\nelements_x = 10\nelements_y = 10\n"
    s = read_specimen(write(tmp_path, more.replace("y_mm = 60.0", 'y_mm = 60.0\nreads = "absolute"')))
    assert s.mesh == (10, 10)
    assert s.reads == "absolute"
    whole = GOOD.replace("length_mm = 300.2", "length_mm = 300")
    assert read_specimen(write(tmp_path, whole)).length_m == 0.3


FORCED = (
    re.sub(r"\[base\].*?\n\n", "\n", GOOD, flags=re.S)
    + """
[excitation]
kind = "force"
x_mm = 270.0
y_mm = 30.0
"""
)


def test_a_force_in_the_place_of_a_base(tmp_path):
    s = read_specimen(write(tmp_path, FORCED))
    assert (s.drive, s.force_m, s.drive_amplitude) == ("force", pytest.approx((0.27, 0.03)), 1.0)
    edges = FORCED.replace('"cantilever"', '"free-simply-supported-free-clamped"')
    assert read_specimen(write(tmp_path, edges)).edges == ("free", "simply-supported", "free", "clamped")


STATED_ALONE = re.sub(r"\n\[tolerances\].*", "", GOOD, flags=re.S)


def test_the_published_plate_is_exact(tmp_path):
    s = read_specimen(case_file("zn1.toml"))
    assert s.exact
    assert all(tolerance(s, name) == 0 for name in STATED)


def test_what_names_no_tolerance_has_a_typical_one(tmp_path):
    for text in (STATED_ALONE, STATED_ALONE + "\n[tolerances]\n"):
        s = read_specimen(write(tmp_path, text))
        assert (s.exact, s.tolerances) == (False, {})
        assert all(tolerance(s, name) == one.typical > 0 for name, one in STATED.items())


def test_a_number_that_only_a_shear_pair_has_is_refused(tmp_path):
    with pytest.raises(BadInput, match=r"tolerances\.area_percent: a plate has no such number"):
        read_specimen(write(tmp_path, f"{STATED_ALONE}\n[tolerances]\narea_percent = 1.0\n"))


def test_tolerances_are_read_in_their_units_and_the_others_are_typical(tmp_path):
    units = {"1": ("percent", 1e-2), "m": ("mm", 1e-3), "s": ("us", 1e-6), "rad": ("deg", np.pi / 180)}
    absent = ("area", "axial", *OF_TEMPERATURE)
    keys = {name: units[one.unit] for name, one in STATED.items() if name not in absent}
    table = "".join(f"{name}_{unit} = {n + 1}.5\n" for n, (name, (unit, _)) in enumerate(keys.items()))
    s = read_specimen(write(tmp_path, f"{STATED_ALONE}\n[tolerances]\n{table}"))
    expected = {name: (n + 1.5) * factor for n, (name, (_, factor)) in enumerate(keys.items())}
    assert s.tolerances == pytest.approx(expected)
    one = read_specimen(write(tmp_path, f"{STATED_ALONE}\n[tolerances]\nsubstrate_young_percent = 2.0\n"))
    assert one.tolerances == {"substrate_young": 0.02}
    assert tolerance(one, "substrate_young") == 0.02
    assert tolerance(one, "core_thickness") == STATED["core_thickness"].typical


def test_a_tolerance_of_zero_is_exact_in_that_number_alone(tmp_path):
    s = read_specimen(write(tmp_path, f"{STATED_ALONE}\n[tolerances]\ngain_percent = 0.0\n"))
    assert not s.exact
    assert tolerance(s, "gain") == 0
    assert tolerance(s, "delay") > 0


BAD = {
    "tolerance": (
        f"{STATED_ALONE}\n[tolerances]\nsubstrate_young_percent = 70\n",
        "tolerances.substrate_young_percent = 70, expected a standard deviation of at most 50 %",
    ),
    "negative tolerance": (f"{STATED_ALONE}\n[tolerances]\nlength_mm = -1\n", "tolerances.length_mm"),
    "unknown tolerance": (
        f"{STATED_ALONE}\n[tolerances]\nlength_percent = 1\n",
        "tolerances.length_percent: unknown key",
    ),
    "empty": ("", "empty"),
    "binary": (b"\x89PNG\r\n\x1a\n\xff\xfe", "a picture, expected text"),
    "nul": (b"[plate]\0", "NUL"),
    "not toml": ("plate = = 1", "not TOML"),
    "negative thickness": (
        GOOD.replace("thickness_mm = 1.9", "thickness_mm = -1.9"),
        "substrate.thickness_mm: -1.9",
    ),
    "zero width": (GOOD.replace("width_mm = 199.9", "width_mm = 0.0"), "plate.width_mm"),
    "nan": (GOOD.replace("young_gpa = 68.9", "young_gpa = nan"), "substrate.young_gpa"),
    "infinite": (GOOD.replace("young_gpa = 68.9", "young_gpa = inf"), "substrate.young_gpa"),
    "text for a number": (GOOD.replace("young_gpa = 68.9", 'young_gpa = "68.9"'), "substrate.young_gpa"),
    "unknown key": (
        GOOD.replace("young_gpa = 68.9", "young_gpa = 68.9\nyuong = 1"),
        "substrate.yuong: unknown key",
    ),
    "unknown table": (GOOD + "\n[coer]\nx = 1\n", "coer: unknown key"),
    "missing key": (GOOD.replace("density_kg_m3 = 2700.0\n", ""), "substrate.density_kg_m3: missing"),
    "missing plate": (GOOD.replace("[plate]", "[plates]"), "plate: missing"),
    "poisson": (GOOD.replace("poisson = 0.49", "poisson = 0.5"), "core.poisson"),
    "force nowhere": (GOOD + '\n[excitation]\nkind = "force"\n', "excitation: kind"),
    "force beside a base": (FORCED + "[base]\nacceleration_m_s2 = 1.0\n", "[base] with [excitation]"),
    "force off the plate": (FORCED.replace("270.0", "400.0"), "excitation.x_mm = 400 is off the plate"),
    "place of a base": (FORCED.replace('"force"', '"base"'), "expected kind"),
    "boundary": (GOOD.replace('"cantilever"', '"clamped"'), "plate.boundary"),
    "law kind": (GOOD.replace('"fractional-zener"', '"zener"'), "or a package installed that adds it"),
    "law out of bounds": (GOOD.replace("alpha = 0.89", "alpha = 1.5"), "alpha = 1.5"),
    "law negative": (GOOD.replace("g0_mpa = 0.40268", "g0_mpa = -0.4"), "g0_mpa = -0.4"),
    "law key": (GOOD.replace("alpha = 0.89", "alpah = 0.89"), "core.law.alpha: missing"),
    "law without its knots": (
        with_law("smooth", "g_mpa = [0.3, 1.0]\nloss_factor = [0.3, 0.9]"),
        "core.law.frequency_hz: missing",
    ),
    "law knots unsorted": (
        with_law("smooth", LAW_TABLES["smooth"].replace("14.0, 300.0", "300.0, 14.0")),
        "frequency_hz = [300, 14], expected two or more above 0, ascending",
    ),
    "law knots not positive": (
        with_law("smooth", LAW_TABLES["smooth"].replace("14.0", "0.0")),
        "frequency_hz = [0, 300], expected two or more above 0, ascending",
    ),
    "law without stiffness": (
        with_law("ghm", "g0_mpa = 0.3\nalpha = [10.0]\nzeta = [0.1]\nomega_rad_s = [1e3]"),
        "the storage modulus is -5.03 MPa at 142.4 Hz",
    ),
    "law not passive": (GOOD.replace("ginf_mpa = 4.1946", "ginf_mpa = 0.1"), "give energy back"),
    "spot off the plate": (GOOD.replace("x_mm = 60.0", "x_mm = 600.0"), "pickup.x_mm = 600 is off the plate"),
    "core alone": (
        re.sub(r"\[constraining\].*?\[core\]", "[core]", GOOD, flags=re.S),
        "[constraining] is missing",
    ),
    "ratio over 100 %": (GOOD.replace("0.29,", "290.0,"), "damping.modal_percent, number 1"),
    "absurd": (GOOD.replace("thickness_mm = 1.9", "thickness_mm = 1e300"), "substrate.thickness_mm"),
    "endless nesting": ("a = " + "[" * 5000, "not"),
    "endless digits": (GOOD.replace("length_mm = 300.2", "length_mm = 3" + "0" * 5000), "not a specimen"),
    "mesh": (GOOD + "\n[mesh]\nelements_x = 1\nelements_y = 10\n", "mesh.elements_x"),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_specimen_is_refused_in_one_line(tmp_path, case):
    text, expected = BAD[case]
    path = write(tmp_path, text)
    with pytest.raises(BadInput) as refused:
        read_specimen(path)
    message = str(refused.value)
    assert message.startswith(str(path))
    assert expected in message
    assert "\n" not in message


def test_missing_file_and_folder_are_refused(tmp_path):
    for path in (tmp_path / "none.toml", tmp_path):
        with pytest.raises(BadInput, match=re.escape(str(path))):
            read_specimen(path)


LAYERS = """
[[glue]]
thickness_mm = 0.05
shear_mpa = 400.0
density_kg_m3 = 1100.0
[[patch]]
from_x_mm = 0.0
to_x_mm = 120.0
from_y_mm = 20.0
to_y_mm = 180.0
[[patch]]
from_x_mm = 150.0
to_x_mm = 200.0
from_y_mm = 20.0
to_y_mm = 180.0
"""
OWN_AXES = "young_x_gpa = 72.0\nyoung_y_gpa = 66.0\nshear_gpa = 25.0\nangle_deg = 30.0"


def test_patches_glue_sides_and_own_axes_are_read(tmp_path):
    text = GOOD.replace("young_gpa = 68.9", OWN_AXES).replace(
        'boundary = "cantilever"', 'boundary = "cantilever"\nboth_sides = true'
    )
    s = read_specimen(write(tmp_path, text + LAYERS))
    assert s.both_sides
    assert s.patches[1] == Patch(0.15, 0.2, 0.02, pytest.approx(0.18))
    assert s.core.glue == (Glue(pytest.approx(5e-5), 400e6, 1100.0),)
    assert s.substrate.young_pa == 72e9
    assert s.substrate.rolled == Orthotropy(66e9, 25e9, np.radians(30))


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("to_x_mm = 120.0", "to_x_mm = 160.0"), "overlap"),
        (("to_x_mm = 200.0", "to_x_mm = 400.0"), "off the plate"),
        (("from_x_mm = 150.0", "from_x_mm = 250.0"), "less than"),
        (("young_gpa = 68.9", "young_gpa = 68.9\nangle_deg = 3.0"), "one or the other"),
        (("young_gpa = 68.9", "young_x_gpa = 68.9"), "young_y_gpa"),
        (("young_gpa = 68.9", "young_x_gpa = 1.0\nyoung_y_gpa = 90.0\nshear_gpa = 3.0"), "sqrt"),
    ],
)
def test_layers_that_cannot_be_are_refused_in_one_line(tmp_path, change, said):
    with pytest.raises(BadInput, match=said) as refused:
        read_specimen(write(tmp_path, (GOOD + LAYERS).replace(*change)))
    assert "\n" not in str(refused.value)


def test_a_bare_plate_has_no_patches(tmp_path):
    text = GOOD[: GOOD.index("[constraining]")] + LAYERS[LAYERS.index("[[patch]]") :]
    with pytest.raises(BadInput, match="treated plate"):
        read_specimen(write(tmp_path, text))


def test_what_a_metal_does_with_temperature_is_stated_of_beams_alone(tmp_path):
    warm = STATED_ALONE.replace("[constraining]", "young_percent_per_k = -0.05\n[constraining]")
    with pytest.raises(BadInput, match=r"substrate\.young_percent_per_k of a plate, expected it of a beam"):
        read_specimen(write(tmp_path, warm))
