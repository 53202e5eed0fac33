"""How large the page of a run is, and how soon it answers in a browser.

    python -m benchmarks.page [model ...]

For each model: size of the page, memory of its script, and the median and the worst time from a key press until the
next picture is painted, by the browser's own clock. All plots are drawn before, and nothing else should run.
"""

from __future__ import annotations

import statistics
import sys
import tempfile
from pathlib import Path

import fairlead
from fairlead.analysis.statics.to_show import shown_besides
from fairlead.report import page
from tests.browser.browser import missing, opened, settled, show

MODELS = ("guidance_route", "single_bend", "belt")
PRESSES = """
const done = arguments[0], stage = document.getElementById("stage"), took = [];
const painted = () => new Promise(then => requestAnimationFrame(() => setTimeout(then)));
(async () => {
  for (let k = 0; k < 21; k++) {
    const begun = performance.now();
    stage.dispatchEvent(new KeyboardEvent("keydown", {key: k % 3 ? "ArrowRight" : "ArrowLeft", bubbles: true}));
    await painted();
    took.push(performance.now() - begun);
  }
  done(took);
})();
"""


def main(names: list[str]) -> None:
    if why := missing():
        sys.exit(why)
    print("model             page MB   script MB   median ms   worst ms")
    with opened() as browser, tempfile.TemporaryDirectory() as folder:
        for name in names:
            model = fairlead.load(name)
            shown_besides(model)
            file = page.write(model.run(out=Path(folder) / name))
            show(browser, file)
            settled(browser)
            took = browser.execute_async_script(PRESSES)
            browser.execute_cdp_cmd("HeapProfiler.collectGarbage", {})
            memory = browser.execute_cdp_cmd("Runtime.getHeapUsage", {})
            used = memory["usedSize"] + memory.get("backingStorageSize", 0)
            print(f"{name:16} {file.stat().st_size / 1e6:8.2f} {used / 1e6:11.0f} "
                  f"{statistics.median(took):11.1f} {max(took):10.1f}")  # fmt: skip


if __name__ == "__main__":
    main(sys.argv[1:] or list(MODELS))
