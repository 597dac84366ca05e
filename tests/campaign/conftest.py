"""Cases of a coarse solid in the place of the campaign's own."""

import pytest
from coarse_solid import COARSE, MODULI, P2

from campaign.plates import cases, kept
from campaign.plates import reduced as reduced_plate


@pytest.fixture(scope="session")
def _coarse_cache(tmp_path_factory):
    return str(tmp_path_factory.mktemp("cache"))


@pytest.fixture(scope="module")
def coarse_plates(_coarse_cache):
    """Cases of the coarse solid, kept in a cache of their own."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("VISCORIG_CACHE", _coarse_cache)
        patch.setattr(kept, "Fineness", lambda: COARSE)
        patch.setattr(kept, "MODULI_PA", MODULI)
        patch.setattr(cases, "PLATES", (P2,))
        patch.setattr(reduced_plate, "_AIR_PANELS", 300)
        kept.clean_plate.cache_clear()
        kept.bare_plate.cache_clear()
        yield
        kept.clean_plate.cache_clear()
        kept.bare_plate.cache_clear()
