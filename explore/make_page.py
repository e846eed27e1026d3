"""Puts the page together: explore/index.html with style, scripts, WebAssembly and data in it.

usage: make_page.py BUILD_FOLDER OUTPUT
"""
import base64
import csv
import gzip
import json
import pathlib
import statistics
import subprocess
import sys

root = pathlib.Path(__file__).resolve().parent.parent
cases = root / "studies/cases"
results = root / "results/work_precision"
scripts = ["fam.js", "view.js", "editor.js", "chart.js", "facts.js", "hands.js", "explore.js"]
targets = [f"1e-{digit:02}" for digit in range(2, 10)]  # tip error over L
# A curve of the chart: its name, the methods of the study whose faster one counts, their rod model; as called, or a
# bare kernel that knows how many arcs, steps or elements it needs.
curves = [("FAM automatic", ["fam automatic"], "Reissner", "called"),
          ("RK4 shooting", ["rk4 shooting"], "Reissner", "both"),
          ("exact reference", ["exact reference"], "Reissner", "called"),
          ("finite elements", ["fe quadratic whole load", "fe quadratic adaptive"], "Reissner", "both"),
          ("FAM sixth order", ["fam sixth_order"], "Reissner", "kernel"),
          ("FAM fourth order", ["fam fourth_order"], "Reissner", "kernel"),
          ("FAM published", ["fam published"], "Kirchhoff", "neither")]


def rows(name):
    with open(results / name, newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def scenes():
    """Study I and the robots, as their files have them."""
    listed = []
    for group, folder in (("Study I", "study1"), ("Robots", "robots")):
        for path in sorted((cases / folder).glob("*.json")):
            scene = json.loads(path.read_text())
            listed.append({"name": path.stem.replace("_", " "), "group": group, "scene": scene})
    return listed


def chart():
    """For each group of scenes and each curve: the median time, µs, to each target (null: most scenes do not get
    there), and how many scenes get there; for each scene who is fastest. As results/work_precision counts."""
    time_us = {}
    for row in rows("timing.csv"):
        if row["start"] == "cold" and row["status"] == "converged":
            time_us[row["scene"], row["method"], row["model"], row["resolution"]] = float(row["median_us"])
    group_of = {row["scene"]: row["group"] for row in rows("timing_to_accuracy.csv")}
    best_us = {}  # by scene, curve, target
    for row in rows("accuracy.csv"):
        key = row["scene"], row["method"], row["model"], row["resolution"]
        if row["status"] != "converged" or key not in time_us:
            continue
        for name, methods, model, _ in curves:
            if row["method"] not in methods or row["model"] != model:
                continue
            for target in targets:
                asked = row["method"] != "fam automatic" or row["resolution"] == target + " L"
                if asked and float(row["tip_error_over_L"]) <= float(target):
                    at = row["scene"], name, target
                    best_us[at] = min(best_us.get(at, float("inf")), time_us[key])
    groups = {}
    for group in dict.fromkeys(group_of.values()):
        members = [scene for scene in group_of if group_of[scene] == group]
        groups[group] = {"scenes": len(members), "curves": []}
        for name, _, _, kind in curves:
            times = [[best_us.get((scene, name, target)) for scene in members] for target in targets]
            groups[group]["curves"].append({"name": name, "kind": kind, "by_scene_us": times,
                                            "median_us": [median(list_us) for list_us in times]})
    machine = (results / "timing.csv").read_text().splitlines()[0].lstrip("# ")
    return {"targets": [float(target) for target in targets], "groups": groups, "machine": machine}


def median(times_us):
    """Of all scenes, one that does not get there infinitely slow."""
    value = statistics.median(float("inf") if time is None else time for time in times_us)
    return None if value == float("inf") else round(value, 3)


def commit():
    def git(*arguments):
        return subprocess.run(["git", "-C", root, *arguments], capture_output=True, text=True)
    changed = git("diff", "--quiet", "HEAD", "--", ".", ":!results").returncode != 0
    return git("rev-parse", "--short=12", "HEAD").stdout.strip() + (" with changes" if changed else "")


def main(build, output):
    wasm = base64.b64encode(gzip.compress((build / "explore.wasm").read_bytes(), 9, mtime=0)).decode()
    data = json.dumps({"commit": commit(), "scenes": scenes(), "chart": chart()}, separators=(",", ":"))
    explore = root / "explore"
    parts = {"style": (explore / "style.css").read_text(),
             "loader": (build / "explore.js").read_text().replace("/home/web_user", "/"),  # of no machine, but looks like it
             "worker": (explore / "worker.js").read_text(),
             "scripts": "\n".join((explore / name).read_text() for name in scripts),
             "wasm": wasm, "data": data.replace("</", "<\\/")}
    page = (explore / "index.html").read_text()
    for name, text in parts.items():
        assert page.count("{{" + name + "}}") == 1, name
        before, after = page.split("{{" + name + "}}")
        page = before + text + after
    output.parent.mkdir(parents=True, exist_ok=True)
    output.write_text(page)
    print(f"{output}: {len(page.encode()) / 1e6:.2f} MB")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
