import pathlib

import matplotlib
import nbformat
import numpy as np
import pytest

NOTEBOOKS = pathlib.Path(__file__).resolve().parents[2] / "assets/examples/python"


@pytest.fixture(scope="module")
def cells():
    notebook = nbformat.read(NOTEBOOKS / "stability.ipynb", as_version=4)
    nbformat.validate(notebook)
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


@pytest.fixture(scope="module")
def names(cells):
    """Of the notebook after all its cells."""
    matplotlib.use("Agg")
    names = {}
    for cell in cells:
        exec(compile(cell.source, cell.id, "exec"), names)  # noqa: S102
    for number in names["plt"].get_fignums():
        names["plt"].figure(number).canvas.draw()
    return names


def test_the_file_holds_no_results(cells):
    assert all(cell.outputs == [] and cell.execution_count is None for cell in cells)


def test_the_figures_show_what_the_paper_says(names):
    verdicts = {name: run.summary["verdict"] for name, run in names["runs"].items()}
    assert verdicts == {"none": "oscillating", "virtual-coupling": "settled", "energy-bounding": "settled"}
    assert names["runs"]["none"].samples["energy_cv_j"].min() >= 0.0
    shown = {name: run.summary["displayed_stiffness_n_per_m"] for name, run in names["runs"].items()}
    assert shown["energy-bounding"] > shown["virtual-coupling"]
    assert len(names["plt"].get_fignums()) == 6


def test_the_map_has_stable_and_unstable_cells(names):
    share = names["grid"].settled.mean(axis=(1, 2))
    assert 0.0 < share[0] < share[2] <= 1.0


def test_the_chart_agrees_with_the_eigenvalues(names):
    for settled, radius in names["charts"].values():
        assert np.array_equal(settled, radius < 1.0)
        assert 0.3 < settled.mean() < 0.7


def test_the_fit_finds_the_simulated_observer(names):
    # 280 answers: the standard error is about 15 N/m of both.
    assert names["equality"] == pytest.approx(1000.0, abs=60.0)
    assert names["noticeable"] == pytest.approx(0.15 * 0.6745 * 1000.0, abs=45.0)
    assert np.diff(names["stiffer"]).sum() > 0
