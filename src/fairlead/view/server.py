"""Answers the page of `fairlead view`, on this machine only and to nobody but who has the address.

The address holds a random token. A request without it, or one that another page sends (a foreign `Host` or `Origin`, as
after a DNS rebinding), is refused. Answers may not be kept, framed or used by other sites.
"""

from __future__ import annotations

import functools
import hmac
import json
import secrets
import shutil
import sys
import tempfile
import threading
from collections.abc import Mapping, Sequence
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

from fairlead.errors import FairleadError, UsageError
from fairlead.report.page import PAGE_FILE
from fairlead.view.draft import Draft
from fairlead.view.workers import Helper, Runner

HERE = "127.0.0.1"
PARTS = Path(__file__).parent / "parts"
MOST_BYTES = 2**25
"""Of a request: more than a netlist may have."""


class View:
    """A netlist, its checks and runs, and the server that shows them; close it when nobody looks any more."""

    def __init__(self, name: str, settings: Mapping[str, str] | None = None, libraries: Sequence[str] = (), *,
                 allow_fmu: bool = False, port: int = 0) -> None:  # fmt: skip
        """Read the netlist and take a port (any that is free by default). Raises ModelError, UsageError."""
        self.draft = Draft(name)
        self.libraries = tuple(libraries)
        self._given = {"file": str(self.draft.file), "set": dict(settings or {}), "libraries": list(libraries),
                       "allow_fmu": allow_fmu}  # fmt: skip
        self._folder = tempfile.TemporaryDirectory(prefix="fairlead-view-", ignore_cleanup_errors=True)
        self.checker, self.completer, self.runner = Helper("check"), Helper("complete"), Runner(self._tidy)
        self.token = secrets.token_urlsafe(24)
        try:
            self._server = _Server((HERE, port), functools.partial(_Handler, self))
        except OSError as error:
            self._folder.cleanup()
            raise UsageError(f"Port {port} cannot be had: {error.strerror}. Choose another with --port.") from error
        self.hosts = tuple(f"{host}:{self._server.server_address[1]}" for host in (HERE, "localhost"))

    @property
    def address(self) -> str:
        """What to open in a browser of this machine."""
        return f"http://{self.hosts[0]}/{self.token}/"

    def serve(self) -> None:
        """Answer until `close` is called or an exception ends it."""
        begin = {**self.request(""), "cursor": 0}
        threading.Thread(target=self.completer.ask, args=(begin,), daemon=True).start()  # all types are read in for it
        self._server.serve_forever(poll_interval=0.2)

    def close(self) -> None:
        """End what goes on, and remove the results that nobody has kept."""
        self._server.server_close()
        self.runner.end()
        self.checker.end()
        self.completer.end()
        self._folder.cleanup()

    def request(self, text: str) -> dict[str, Any]:
        """What a worker is asked about a text."""
        return {**self._given, "text": text}

    def results(self, number: int) -> Path:
        """The folder of a run."""
        return Path(self._folder.name) / f"run-{number}"

    def keep(self, number: int) -> Path:
        """Copy the results of a run to a new folder below `results/`. Raises UsageError."""
        if not (self.results(number) / PAGE_FILE).exists():
            raise UsageError("There are no results to keep; run the netlist first.")
        name = self.draft.file.stem
        for k in range(1, 10_000):
            target = Path("results") / (name if k == 1 else f"{name}-{k}")
            if not target.exists():
                break
        try:
            shutil.copytree(self.results(number), target)
        except OSError as error:
            raise UsageError(f"The results cannot be kept in {target}: {error}.") from error
        return target

    def _tidy(self, number: int) -> None:
        """Of runs before this one nothing is shown any more."""
        for before in range(1, number):
            shutil.rmtree(self.results(before), ignore_errors=True)

    def page(self) -> tuple[str, str]:
        """The text of the page, and the word that lets its own script and style in, and no others."""
        import jinja2

        loader = jinja2.FileSystemLoader(PARTS)
        made = jinja2.Environment(loader=loader, autoescape=True, trim_blocks=True, lstrip_blocks=True)
        nonce = secrets.token_urlsafe(18)
        style, script = ((PARTS / name).read_text(encoding="utf-8") for name in ("view.css", "view.js"))
        return made.get_template("view.html").render(
            file=self.draft.shown, text=self.draft.text, refusal=self.draft.refusal, nonce=nonce, style=style,
            script=script,
        ), nonce  # fmt: skip


class _Server(ThreadingHTTPServer):
    daemon_threads = True

    def handle_error(self, *given: Any) -> None:
        """A page that is closed while it is answered is no error."""
        if not isinstance(sys.exc_info()[1], ConnectionError):
            super().handle_error(*given)


class _Handler(BaseHTTPRequestHandler):
    server_version, sys_version = "fairlead", ""
    protocol_version = "HTTP/1.1"
    timeout = 60

    def __init__(self, view: View, *given: Any) -> None:
        self.view = view
        super().__init__(*given)

    def do_GET(self) -> None:
        """The page, how far the run is, the page of a run."""
        what = self._asked()
        if what is None:
            return
        if what == "":
            page, nonce = self.view.page()
            own = f"script-src 'nonce-{nonce}'; style-src 'nonce-{nonce}'; connect-src 'self'; frame-src 'self'"
            self._answer(200, page, "text/html", f"default-src 'none'; img-src data:; {own}; frame-ancestors 'none'; "
                         "base-uri 'none'; form-action 'none'")  # fmt: skip
        elif what == "state":
            self._json(self.view.runner.state)
        elif what.startswith("report/") and what[7:].isdigit():
            file = self.view.results(int(what[7:])) / PAGE_FILE
            if file.exists():
                self._answer(200, file.read_text(encoding="utf-8"), "text/html", "frame-ancestors 'self'")
            else:
                self._refuse(404, "There is no such run.")
        else:
            self._refuse(404, "There is nothing here.")

    def do_POST(self) -> None:
        """What the person does: check, complete, run, stop, save, keep."""
        what = self._asked()
        if what is None:
            return
        try:
            size = int(self.headers.get("Content-Length", ""))
            if self.headers.get_content_type() != "application/json" or not 0 <= size <= MOST_BYTES:
                raise ValueError
            given = json.loads(self.rfile.read(size))
            text = given.get("text", "")
            if not isinstance(text, str):
                raise TypeError
            work = WORK[what]
        except (ValueError, TypeError, AttributeError, KeyError):
            self.close_connection = True
            self._refuse(400, "This is no request of the page.")
            return
        try:
            self._json(work(self.view, given, text))
        except FairleadError as error:
            self._json({"refused": str(error)})

    def _asked(self) -> str | None:
        """What is asked for behind the token; None when the request is refused."""
        host, origin = self.headers.get("Host", ""), self.headers.get("Origin")
        token, _, what = self.path.removeprefix("/").partition("/")
        known = hmac.compare_digest(token.encode(), self.view.token.encode())
        if known and host in self.view.hosts and origin in (None, f"http://{host}"):
            return what.partition("?")[0]
        self.close_connection = True
        self._refuse(403, "Open the address that fairlead view printed.")
        return None

    def _json(self, words: Any) -> None:
        self._answer(200, json.dumps(words), "application/json")

    def _refuse(self, code: int, why: str) -> None:
        self._answer(code, why + "\n", "text/plain")

    def _answer(self, code: int, text: str, kind: str, policy: str = "default-src 'none'") -> None:
        data = text.encode()
        self.send_response(code)
        for name, value in (
            ("Content-Type", f"{kind}; charset=utf-8"), ("Content-Length", str(len(data))),
            ("Cache-Control", "no-store"), ("Content-Security-Policy", policy), ("X-Content-Type-Options", "nosniff"),
            ("Referrer-Policy", "no-referrer"), ("Cross-Origin-Resource-Policy", "same-origin"),
        ):  # fmt: skip
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(data)

    def log_message(self, format: str, *args: Any) -> None:
        """Nothing: the terminal is for the address."""


def _check(view: View, _: Any, text: str) -> Any:
    return view.checker.ask(view.request(text)) or {"newer": True}


def _complete(view: View, given: Any, text: str) -> Any:
    cursor = given.get("cursor")
    cursor = cursor if isinstance(cursor, int) else len(text)
    answer = view.completer.ask({**view.request(text), "cursor": cursor})
    return answer if answer and "items" in answer else {"begin": cursor, "items": []}  # why not is what checks tell


def _run(view: View, _: Any, text: str) -> Any:
    begun = view.runner.start(view.request(text), str(view.results(view.runner.number + 1)))
    return {"begun": begun}


def _stop(view: View, _: Any, __: str) -> Any:
    view.runner.stop()
    return {}


def _save(view: View, _: Any, text: str) -> Any:
    view.draft.save(text)
    return {"saved": f"Saved to {view.draft.shown}."}


def _keep(view: View, _: Any, __: str) -> Any:
    return {"saved": f"Results are kept in {view.keep(view.runner.number)}."}


WORK = {"check": _check, "complete": _complete, "run": _run, "stop": _stop, "save": _save, "keep": _keep}
