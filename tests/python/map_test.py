"""Maps as data of other libraries."""

import numpy as np
import pytest

import hapticwall as hw

X, Y = "wall.stiffness_n_per_m", "device.damping_n_s_per_m"
MAP = hw.map(
    hw.load("press").replace({"duration_s": 1.2}),
    x=(X, [300.0, 3e3, 3e4]),
    y=(Y, [0.3, 3.0]),
    algorithms=["none", "energy-bounding"],
)


def test_a_map_knows_its_keys_and_units():
    assert (MAP.x_key, MAP.y_key, MAP.x_unit, MAP.y_unit) == (X, Y, "N/m", "N·s/m")
    speeds = hw.map("press", x=("hand.path_speed_m_per_s", [0.1]), y=("sampling.rate_hz", [1e3]), algorithms=["none"])
    assert (speeds.x_unit, speeds.y_unit) == ("m/s", "Hz")
    wall = hw.map("layers", x=("wall[1].stiffness_n_per_m", [3e3]), y=("device.delay_ticks", [1]), algorithms=["none"])
    assert (wall.x_unit, wall.y_unit) == ("N/m", "ticks")


def test_a_map_is_an_xarray_dataset(tmp_path):
    xarray = pytest.importorskip("xarray", reason="xarray is not installed")
    found = MAP.to_xarray()
    assert isinstance(found, xarray.Dataset)
    assert dict(found.sizes) == {"algorithm": 2, Y: 2, X: 3}
    assert found[X].attrs["units"] == "N/m" and found[Y].attrs["units"] == "N·s/m"
    for key in MAP.columns:
        expected = MAP.verdict if key == "verdict" else MAP[key]
        np.testing.assert_array_equal(found[key].to_numpy(), expected)
    one = found.sel({"algorithm": "energy-bounding", X: 3e3, Y: 3.0})
    assert one["peak_force_n"] == MAP["peak_force_n"][1, 1, 1]
    units = {key: found[key].attrs.get("units") for key in found}
    assert units["peak_force_n"] == "N" and units["tail_peak_to_peak_m"] == "m"
    assert units["displayed_stiffness_n_per_m"] == "N/m" and units["shake_m_per_s2"] == "m/s²"
    assert units["passivity_margin_j"] == "J" and units["given_w"] == "W"
    assert units["contacts"] is None and units["saturated_ticks"] is None


def test_a_map_without_xarray_says_so(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "xarray", None)
    with pytest.raises(ImportError, match="xarray"):
        MAP.to_xarray()
