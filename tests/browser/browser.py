"""A headless Chromium, driven by selenium: what the tests of pages and the pictures of the documentation share.

Nothing is installed from here: `make browser` does that, and without a browser there is none to test with.
"""

import json
import shutil
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

FLAGS = (
    "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--disable-dev-shm-usage", "--hide-scrollbars",
)  # fmt: skip
STARTS = 4
PATIENCE = 100.0  # s; selenium itself gives up after 120


def missing() -> str:
    """Why there is no browser; "" when there is one."""
    if not shutil.which("chromium") or not shutil.which("chromedriver"):
        return "no chromium with chromedriver: make browser installs them"
    try:
        import selenium  # noqa: F401 - whether it is there
    except ImportError:
        return "selenium is not installed: it comes with the extra `test`"
    return ""


@contextmanager
def opened() -> Iterator[Any]:
    """A browser with a profile of its own, which goes when it does."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        driver = _started(Path(folder))
        driver.set_script_timeout(PATIENCE)
        try:
            yield driver
        finally:
            driver.quit()


def _started(folder: Path) -> Any:
    """A browser. On a machine where much else starts, it may take longer than selenium waits for it; then another."""
    from selenium import webdriver
    from selenium.common.exceptions import WebDriverException
    from selenium.webdriver.chrome.service import Service
    from urllib3.exceptions import HTTPError

    for turn in range(STARTS):
        options = webdriver.ChromeOptions()
        options.binary_location = str(shutil.which("chromium"))
        for flag in (*FLAGS, f"--user-data-dir={folder / str(turn)}"):
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        service = Service(str(shutil.which("chromedriver")))
        try:
            return webdriver.Chrome(options, service)
        except (WebDriverException, HTTPError):
            service.stop()  # and what it has started
            if turn + 1 == STARTS:
                raise
    raise AssertionError


def show(
    driver: Any, page: Path, width: int = 1440, height: int = 1000, dark: bool = False, patience: float = PATIENCE
) -> None:
    """Open a page from disk in a window of so many px, and wait until it is ready."""
    from selenium.webdriver.support.ui import WebDriverWait

    driver.get("about:blank")  # a page that is still there loads again when its colours change, which may win the race
    size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600}
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    wishes = {"prefers-color-scheme": "dark" if dark else "light", "prefers-reduced-motion": "reduce"}
    features = [{"name": name, "value": value} for name, value in wishes.items()]
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": features})
    driver.get_log("performance")  # what the browser did for itself before
    driver.get(page.resolve().as_uri())
    WebDriverWait(driver, patience).until(lambda it: it.execute_script("return document.body.dataset.ready === 'yes'"))


def settled(driver: Any) -> None:
    """Draw every plot, also those that nobody has scrolled to, and wait until they stand and nothing is left to do."""
    driver.execute_async_script(
        "const done = arguments[0], idle = () => new Promise(then => requestIdleCallback(then));"
        "(async () => { for (const make of fairlead.page.waiting) await make();"
        "await new Promise(then => setTimeout(then, 400)); for (let k = 0; k < 3; k++) await idle(); done();"
        "})().catch(e => done(String(e)))"
    )


def until(driver: Any, holds: Callable[[], Any], times: int = 1) -> None:
    """Wait until something holds, looked at so many times one after the other. Raises TimeoutException."""
    from selenium.webdriver.support.ui import WebDriverWait

    held = 0

    def look(_: Any) -> bool:
        nonlocal held
        held = held + 1 if holds() else 0
        return held >= times

    WebDriverWait(driver, PATIENCE, poll_frequency=0.2).until(look)


def complaints(driver: Any) -> list[str]:
    """Errors and warnings on the console."""
    return [entry["message"] for entry in driver.get_log("browser") if entry["level"] in ("SEVERE", "WARNING")]


def requests(driver: Any) -> list[str]:
    """Addresses that were asked for, but for the page itself and what it holds."""
    told = (json.loads(entry["message"])["message"] for entry in driver.get_log("performance"))
    asked = [one["params"]["request"]["url"] for one in told if one["method"] == "Network.requestWillBeSent"]
    return [address for address in asked if not address.startswith(("file:", "data:", "blob:", "chrome:"))]
