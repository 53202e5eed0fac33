"""Take the pictures of README and docs again: `make pictures`, which needs a browser (`make browser`).

Two pages: the single bend at mu = 0.6 in light, in which the hose rucks, and the whole guidance route in dark.
"""

import io
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import fairlead
from fairlead.analysis.margins.quasi_static import against_statics
from fairlead.analysis.margins.ruck import verdicts
from fairlead.analysis.statics.to_show import shown_besides
from fairlead.report import page
from fairlead.results.placing import place
from tests.browser.browser import missing, opened, show

FIGURES = Path(__file__).resolve().parents[2] / "docs" / "figures"
WIDTH, COLOURS = 1200, 255
LONG = 280.0
"""Patience with a page on a busy machine [s]; below that of the driver with its browser."""


class Picture(NamedTuple):
    """A picture of the top of a page: the time that its moving picture shows [s], height [px]."""

    file: str
    model: str
    values: dict[str, Any]
    t: float
    dark: bool
    height: int


PICTURES = (
    Picture("page_light.png", "single_bend", {"mu": 0.6}, 13.0, False, 1530),
    Picture("page_dark.png", "guidance_route", {}, 20.0, True, 1370),
)


def main(wanted: Sequence[str]) -> int:
    """Take those named, or all; 1 without a browser, or when one could not be taken."""
    if why := missing():
        print(why, file=sys.stderr)
        return 1
    from selenium.common.exceptions import WebDriverException

    failed = 0
    for picture in PICTURES:
        if wanted and picture.file not in wanted:
            continue
        print(f"{picture.file}: running {picture.model} ...", flush=True)
        try:
            with tempfile.TemporaryDirectory() as folder:
                written = taken(page_of(picture, Path(folder)), picture)
        except (WebDriverException, fairlead.RunError) as error:  # the others are taken all the same
            print(f"{picture.file} was not taken, the old one stays: {error}", file=sys.stderr, flush=True)
            failed = 1
            continue
        place(FIGURES / picture.file, written)
        print(f"wrote {FIGURES.name}/{picture.file}, {len(written) / 1e3:.0f} kB", flush=True)
    return failed


def page_of(picture: Picture, folder: Path) -> Path:
    """Run the model of a picture and write its page."""
    model = fairlead.load(picture.model, set=picture.values)
    shown_besides(model)
    result = model.run(out=folder / picture.model)
    result.run |= {"ruck": verdicts(result), "against_statics": against_statics(model.flat, result)}
    return page.write(result)


def taken(file: Path, picture: Picture) -> bytes:
    """The top of a page as a small PNG. What stands below is not drawn for it: that takes minutes under load."""
    with opened() as driver:
        driver.set_script_timeout(LONG)
        show(driver, file, WIDTH, picture.height, picture.dark, LONG)
        driver.execute_script(f"fairlead.clock.set({picture.t}); scrollTo(0, 0)")
        driver.execute_async_script("setTimeout(arguments[0], 500)")
        return small(driver.get_screenshot_as_png())


def small(png: bytes) -> bytes:
    """The same picture with few colours, which the flat ones of a page do with."""
    from PIL import Image

    made: Any = Image.open(io.BytesIO(png)).convert("RGB").quantize(COLOURS, dither=Image.Dither.NONE)
    out = io.BytesIO()
    made.save(out, "PNG", optimize=True)
    return out.getvalue()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
