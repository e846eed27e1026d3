"""What the page says: errors where the scene is wrong, limits, and nothing that belongs to another scene."""
import json
import math
import sys

import pytest

from browser import Browser
from support import distance, embedded, handle, no_browser, page, root, tip_mm

section = {"length_mm": 100, "stiffness": {"bending_Nmm2": 1000, "torsion_Nmm2": 800}}
force = {"kind": "force", "at": "tip", "frame": "fixed"}
half_typed = [({**force}, "loads[0].value_N = (missing)"), ({**force, "value_N": [0, 1]}, "loads[0].value_N = [0,1]"),
              ({**force, "value_N": ["a", 1, 2]}, "loads[0].value_N[0]"), (None, "loads[0] = null"),
              ({"kind": "push"}, "loads[0].kind"), ({"kind": "tendon"}, "loads[0]")]


def show(browser, loads):
    text = json.dumps(json.dumps({"rod": {"sections": [section]}, "loads": loads}))
    browser.run(f"explorer.then(page => {{ page.show({text}); return page.settled; }})")


def said(browser, name):
    return browser.run(f"document.getElementById('{name}').textContent")


def fact(browser, row):
    """The cells of a row of the table, once none of them is awaited."""
    return browser.run(f"""new Promise((resolve, reject) => {{
        const start = performance.now(), look = () => {{
            const cells = [...[...document.getElementById('facts').rows].find(each => each.cells[0].textContent === '{row}').cells];
            const words = cells.slice(1).map(cell => cell.textContent);
            if (!words.includes('…')) resolve(words);
            else if (performance.now() - start > 20000) reject(new Error('nothing comes'));
            else setTimeout(look, 50);
        }};
        look();
    }})""")


def test_page_holds_the_chart_of_these_results():
    sys.path.insert(0, str(root / "explore"))
    import make_page
    assert embedded()["chart"] == make_page.chart(), "results/work_precision has changed: ./page builds the page again"


def test_page_names_the_commit_alone():
    assert len(embedded()["commit"]) == 12, "commit the sources, then ./page"


@no_browser
@pytest.mark.parametrize("load, line", half_typed, ids=lambda value: value if isinstance(value, str) else "")
def test_half_typed_load_gets_the_line_of_fam_and_no_rod(browser, load, line):
    show(browser, [load])
    assert line in said(browser, "scene-error")
    assert browser.run("explorer.then(page => page.rods().length)") == 0
    assert fact(browser, "time of a solve") == ["–", "–"]
    show(browser, [{**force, "value_N": [0, 0.1, 0]}])
    assert said(browser, "scene-error") == ""
    assert browser.complaints == []


@no_browser
def test_broken_link_is_told():
    browser = Browser(1280, 900)
    try:
        browser.open(page.as_uri() + "#scene=%7Bbroken")
        assert "holds no scene" in said(browser, "link-note")
        assert browser.complaints == []
    finally:
        browser.close()


@no_browser
@pytest.mark.parametrize("stiffer", [1, 1.05])
def test_column_buckles_where_euler_says(browser, stiffer):
    """Half of pi^2 EI / (4 L^2) on a column: it buckles at twice the load; one 5 % stiffer at 2.1 times."""
    half = 0.5 * math.pi ** 2 * 1000 / (4 * 100 ** 2)
    column = json.dumps(json.dumps({"rod": {"sections": [{"length_mm": 100, "stiffness": {
        "bending_Nmm2": 1000 * stiffer, "torsion_Nmm2": 800}}]}, "loads": [{**force, "value_N": [-half, 0, 0]}]}))
    browser.run(f"explorer.then(page => {{ page.show({column}); return page.settled; }})")
    factor = 2 * stiffer
    assert fact(browser, "as the load grows")[0] == f"buckles (branch point) at {factor:.4g} × this load"
    assert fact(browser, "stable")[0] == "yes"


@no_browser
def test_keys_find_a_load_that_they_can_change(browser):
    browser.run("explorer.then(page => page.open(page.data.scenes.findIndex(entry => entry.name === 'colonoscope')))")
    before = tip_mm(browser)  # gravity is its first load
    browser.run("document.getElementById('view').focus()")
    browser.press("ArrowUp", 38)
    assert distance(before, tip_mm(browser)) > 1e-3


@no_browser
def test_a_finger_drags_and_two_zoom(browser):
    browser.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=2)
    touch = lambda kind, *points: browser.call("Input.dispatchTouchEvent", type=kind, touchPoints=[  # noqa: E731
        {"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)])
    before, (x, y) = tip_mm(browser), handle(browser, 0)
    touch("touchStart", (x, y))
    for step in range(1, 6):
        touch("touchMove", (x - 8 * step, y + 6 * step))
    touch("touchEnd")
    dragged = tip_mm(browser)
    assert distance(before, dragged) > 0.5
    x, y = browser.run("(({x, y, height}) => [x + 60, y + height - 60])(document.getElementById('view').getBoundingClientRect())")
    zoom = browser.run("explorer.then(page => page.view.zoom)")
    touch("touchStart", (x, y), (x + 60, y))
    touch("touchMove", (x, y), (x + 120, y))
    touch("touchEnd")
    assert browser.run("explorer.then(page => page.view.zoom)") > 1.5 * zoom
    assert tip_mm(browser) == dragged
    assert browser.complaints == []
