"""What the tests of the page share."""
import json
import pathlib
import re

import pytest

from browser import program

root = pathlib.Path(__file__).resolve().parents[2]
page = root / "results/explore/index.html"
no_browser = pytest.mark.skipif(program is None, reason="Chromium is not installed")


def tip_mm(browser):
    return browser.run("explorer.then(async page => { await page.settled; return page.accurate.tip.position_mm; })")


def distance(a, b):
    return sum((x - y) ** 2 for x, y in zip(a, b)) ** 0.5


def handle(browser, index):
    """Where on the page the head of a load's arrow is, px."""
    return browser.run(f"""explorer.then(page => {{
        const box = page.view.canvas.getBoundingClientRect(), at = page.view.project(page.arrows()[{index}].to);
        return [box.x + page.view.canvas.clientLeft + at.x, box.y + page.view.canvas.clientTop + at.y];
    }})""")


def embedded():
    return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', page.read_text(), re.S).group(1))
