"""Take the pictures of README and docs again: `make pictures`, which needs a browser (`make browser`).

Two pages: the single bend at mu = 0.6 in light, in which the hose rucks, and the whole guidance route in dark.
"""

import io
import sys
import tempfile
from pathlib import Path
from typing import Any

import fairlead
from fairlead.analysis.margins.quasi_static import against_statics
from fairlead.analysis.margins.ruck import verdicts
from fairlead.analysis.statics.to_show import shown_besides
from fairlead.report import page
from tests.browser.browser import missing, opened, settled, show

FIGURES = Path(__file__).resolve().parents[2] / "docs" / "figures"
WIDTH, COLOURS = 1200, 255
PICTURES = (
    ("page_light.png", "single_bend", {"mu": 0.6}, 13.0, False, 1290),
    ("page_dark.png", "guidance_route", {}, 20.0, True, 1110),
)  # file, model, values, time shown [s], dark, height [px]


def main() -> int:
    """Take them all; 1 without a browser."""
    if why := missing():
        print(why, file=sys.stderr)
        return 1
    with tempfile.TemporaryDirectory() as folder, opened() as driver:
        for file, name, values, t, dark, height in PICTURES:
            model = fairlead.load(name, set=values)
            shown_besides(model)
            result = model.run(out=Path(folder) / name)
            result.run |= {"ruck": verdicts(result), "against_statics": against_statics(model.flat, result)}
            show(driver, page.write(result), WIDTH, height, dark)
            settled(driver)
            driver.execute_script(f"fairlead.clock.set({t}); scrollTo(0, 0)")
            driver.execute_async_script("setTimeout(arguments[0], 500)")
            written = small(driver.get_screenshot_as_png())
            (FIGURES / file).write_bytes(written)
            print(f"wrote {FIGURES.name}/{file}, {len(written) / 1e3:.0f} kB")
    return 0


def small(png: bytes) -> bytes:
    """The same picture with few colours, which the flat ones of a page do with."""
    from PIL import Image

    made: Any = Image.open(io.BytesIO(png)).convert("RGB").quantize(COLOURS, dither=Image.Dither.NONE)
    out = io.BytesIO()
    made.save(out, "PNG", optimize=True)
    return out.getvalue()


if __name__ == "__main__":
    sys.exit(main())
