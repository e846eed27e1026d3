"""results/explore/index.html in Chromium without a window: it loads, moves, and solves as `fam solve` does."""
import base64
import gzip
import json
import os
import re
import subprocess
import time

import pytest

from browser import Browser
from support import distance, embedded, handle, no_browser, page, root, tip_mm

fam = os.environ.get("FAM_COMMAND", str(root / "build/release/bin/fam"))
limit_over_L = 1e-10  # of the distance between the WebAssembly tip and the native one, the same arcs
measured_over_L = 1.4e-15  # largest of the scenes below


def test_page_is_small_and_needs_no_network():
    text = page.read_text()
    assert len(text.encode()) < 1.5e6
    assert not re.search(r'(?:src|href)="(?:https?:)?//', text)
    wasm = re.search(r'<script type="text/plain" id="wasm">(.*?)</script>', text, re.S).group(1)
    assert gzip.decompress(base64.b64decode(wasm))[:4] == b"\0asm"


def test_page_holds_the_scripts_and_scenes_of_this_project():
    text = page.read_text()
    for file in [*(root / "explore").glob("*.js"), root / "explore/style.css"]:
        assert file.read_text() in text, f"{file.name} has changed: ./page builds the page again"
    listed = {entry["name"]: entry["scene"] for entry in embedded()["scenes"]}
    files = [file for folder in ("study1", "robots") for file in (root / "studies/cases" / folder).glob("*.json")]
    assert len(files) == len(listed)
    for file in files:
        assert listed[file.stem.replace("_", " ")] == json.loads(file.read_text()), f"{file}: ./page builds the page again"


@no_browser
def test_loads_without_errors(browser):
    time.sleep(2)  # the slow questions
    assert browser.complaints == []
    assert browser.run("document.getElementById('facts').rows.length") == 8
    assert "away at most" in browser.run("document.getElementById('outcome').textContent")
    assert "suffice" in browser.run("document.getElementById('reason').textContent")


@no_browser
def test_drag_changes_the_shape(browser):
    before, (x, y) = tip_mm(browser), handle(browser, 0)
    browser.mouse("mousePressed", x, y)
    for step in range(1, 6):
        browser.mouse("mouseMoved", x - 8 * step, y + 6 * step)
    browser.mouse("mouseReleased", x - 40, y + 30)
    assert distance(before, tip_mm(browser)) > 0.5
    x_after, y_after = handle(browser, 0)
    assert abs(x_after - x) + abs(y_after - y) > 10
    assert browser.complaints == []


@no_browser
def test_a_frame_asks_once_and_the_rest_waits_until_it_is_quiet(browser):
    calls, reason = browser.run("""explorer.then(async page => {
        const worker = page.solver.worker, post = worker.postMessage.bind(worker), calls = [];
        clearTimeout(page.quiet);
        worker.postMessage = message => { calls.push(message.calls.map(call => call[0])); post(message); };
        page.pull(0, [0, 3, 0]);
        clearTimeout(page.quiet);
        await page.settled;
        return [calls, document.getElementById('reason').textContent];
    })""")
    assert calls == [["solve", "solve"]]
    assert reason == "…"
    browser.run("explorer.then(page => page.changed())")
    wait_until = time.monotonic() + 20
    while "suffice" not in browser.run("document.getElementById('reason').textContent"):
        assert time.monotonic() < wait_until
        time.sleep(0.1)
    assert browser.run("explorer.then(page => document.getElementById('scene-text').value === page.text)")


@no_browser
def test_drag_beside_the_handles_turns_the_view_alone(browser):
    before = tip_mm(browser)
    yaw = browser.run("explorer.then(page => page.view.yaw)")
    x, y = browser.run("(({x, y, height}) => [x + 30, y + height - 30])(document.getElementById('view').getBoundingClientRect())")
    for kind, way in (("mousePressed", 0), ("mouseMoved", 40), ("mouseReleased", 40)):
        browser.mouse(kind, x + way, y)
    assert browser.run("explorer.then(page => page.view.yaw)") != yaw
    assert tip_mm(browser) == before


@no_browser
def test_keyboard_alone_changes_loads_and_view(browser):
    for _ in range(20):
        browser.press("Tab", 9)
        if browser.run("document.activeElement.id") == "view":
            break
    assert browser.run("document.activeElement.id") == "view"
    before = tip_mm(browser)
    browser.press("ArrowRight", 39)
    after = tip_mm(browser)
    assert distance(before, after) > 1e-3
    selected = browser.run("explorer.then(page => page.selected)")
    browser.press("n", 78)
    assert browser.run("explorer.then(page => page.selected)") != selected
    yaw = browser.run("explorer.then(page => page.view.yaw)")
    browser.press("ArrowLeft", 37, modifiers=8)
    assert browser.run("explorer.then(page => page.view.yaw)") != yaw
    assert tip_mm(browser) == after


@no_browser
@pytest.mark.parametrize("browser", [(400, 800)], indirect=True)
def test_400_pixels_of_width_suffice(browser):
    assert browser.run("document.documentElement.scrollWidth") <= 400
    assert browser.run("document.getElementById('view').clientWidth") > 300


@no_browser
def test_wrong_scene_gets_the_line_of_fam_and_no_rod(browser):
    browser.run("""explorer.then(page => page.show(JSON.stringify({rod: {sections: [{length_mm: 40,
        stiffness: {bending_Nmm2: -1, torsion_Nmm2: 500}}]}, loads: []})))""")
    browser.run("explorer.then(page => page.settled)")
    line = browser.run("document.getElementById('scene-error').textContent")
    assert "rod.sections[0].stiffness.bending_Nmm2" in line and "-1" in line, line
    assert browser.run("explorer.then(page => page.rods().filter(rod => !rod.dashed).length)") == 0


@no_browser
def test_what_does_not_converge_is_not_drawn(browser):
    browser.run("""explorer.then(page => page.show(JSON.stringify({rod: {sections: [{length_mm: 100,
        stiffness: {bending_Nmm2: 1000, torsion_Nmm2: 800}, rest_curvature_per_mm: [0, 0, 0.02]}]},
        loads: [{kind: "force", at: "tip", frame: "follower", value_N: [1e6, 0, 0]}]})))""")
    browser.run("explorer.then(page => page.settled)")
    status = browser.run("explorer.then(page => page.accurate.status)")
    drawn = browser.run("explorer.then(page => page.rods().filter(rod => !rod.dashed).length)")
    converged = browser.run("explorer.then(page => [page.accurate, page.compared].filter(a => a.status === 'converged').length)")
    assert drawn == converged, status


@no_browser
def test_link_brings_the_scene_back(browser):
    browser.run("explorer.then(page => page.open(page.data.scenes.findIndex(entry => entry.name === 'colonoscope')))")
    tip = tip_mm(browser)
    browser.run("document.getElementById('link').click()")
    address = browser.run("location.href")
    assert "#scene=" in address
    again = Browser(800, 600)
    try:
        again.open(address)
        assert tip_mm(again) == tip
        assert again.complaints == []
    finally:
        again.close()


@no_browser
def test_slider_names_the_fastest_method(browser):
    for target in range(8):
        browser.run(f"""(slider => {{ slider.value = {target}; slider.dispatchEvent(new Event('input')); }})
                        (document.getElementById('accuracy'))""")
        advice = browser.run("document.getElementById('advice').textContent")
        curves = embedded()["chart"]["groups"]["follower"]["curves"]
        called = [curve for curve in curves if curve["kind"] in ("called", "both")]
        wins = dict.fromkeys((curve["name"] for curve in called), 0)
        for scene in zip(*(curve["by_scene_us"][target] for curve in called)):
            there = [(time_us, curve["name"]) for time_us, curve in zip(scene, called) if time_us is not None]
            if there:
                wins[min(there)[1]] += 1
        best = max(wins.values())
        assert any(f"Take {name}:" in advice for name in wins if wins[name] == best), (target, advice)


@no_browser
def test_webassembly_tips_are_the_native_ones(browser, tmp_path):
    files = sorted(file for folder in ("study1", "robots", "third_party") for file in (root / "studies/cases" / folder).glob("*.json"))
    compared, largest = 0, 0.0
    for file in files:
        scene = json.loads(file.read_text())
        length_mm = sum(section["length_mm"] for section in scene["rod"]["sections"])
        native = json.loads(subprocess.run([fam, "solve", str(file), "--format", "json", "--law", "sixth_order", "--arcs", "40"],
                                           capture_output=True, text=True).stdout)
        options = json.dumps({"law": "sixth_order", "arcs": 40})
        answer = browser.run(f"explorer.then(page => page.solver.ask('solve', {json.dumps(json.dumps(scene))}, {json.dumps(options)}))")
        assert answer["status"] == native["status"], file
        if native["status"] != "converged":
            continue
        largest = max(largest, distance(answer["tip"]["position_mm"], native["tip"]["position_mm"]) / length_mm)
        compared += 1
    print(f"{compared} scenes, largest distance {largest:.1e} L")
    assert compared >= 50
    assert largest < limit_over_L
    # The twin: a rod 5 % stiffer is told from this one.
    scene = json.loads((root / "studies/cases/study1/S1_fixed.json").read_text())
    scene["rod"]["sections"][0]["material"]["youngs_modulus_MPa"] *= 1.05
    stiffer = browser.run(f"explorer.then(page => page.solver.ask('solve', {json.dumps(json.dumps(scene))}, {json.dumps(options)}))")
    native = json.loads(subprocess.run([fam, "solve", str(root / "studies/cases/study1/S1_fixed.json"), "--format", "json", "--law",
                                        "sixth_order", "--arcs", "40"], capture_output=True, text=True).stdout)
    assert distance(stiffer["tip"]["position_mm"], native["tip"]["position_mm"]) > 1e-3 * 40


@no_browser
def test_frames_a_second_are_told(browser):
    """60 are asked for; how many there are depends on the machine and is printed, not judged."""
    frames, shapes, seconds = browser.run("""explorer.then(async page => {
        let frames = 0, shapes = 0, last = page.accurate;
        const start = performance.now();
        for (; performance.now() - start < 2000; frames++) {
            page.pull(0, [0, 0.02 * Math.sin(frames / 10), 0]);
            await new Promise(requestAnimationFrame);
            if (page.accurate !== last) shapes++;
            last = page.accurate;
        }
        return [frames, shapes, (performance.now() - start) / 1000];
    })""")
    print(f"{frames / seconds:.0f} frames a second while a load is pulled, {shapes / seconds:.0f} of them with a new shape")
    assert shapes > 0
