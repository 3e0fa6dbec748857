"""Window: a page of the browser that draws a tower as often as it is shown, with the view of notebooks."""

from __future__ import annotations

import base64
import json
import threading
import webbrowser
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import numpy as np

from teeter import World
from teeter.notebook import bundle

__all__ = ["Window"]

#: Time after which a page without news is told that there is none, s.
QUIET = 10.0
SECURITY = "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; object-src 'none'"
PAGE = """\
<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>Teeter</title>
<link rel="icon" href="data:,">
<style>html, body { margin: 0; height: 100%; background: #d9cdbb }</style>
<body></body>
<script type="module" src="window.js"></script>
</html>
"""
SCRIPT = """\
import widget from './widget.js';

const bytes = text => new DataView(Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer);
const none = bytes('');
const values = {
  sizes: none, poses: none, readings: none, interval: 1, frame: 0, playing: false, selected: -1,
  height: innerHeight - 8,
};
const listeners = {};
const emit = name => (listeners[`change:${name}`] ?? []).forEach(callback => callback());
const model = {
  get: name => values[name],
  set: (name, value) => ((values[name] = value), emit(name)),
  save_changes: () => {},
  on: (event, callback) => (listeners[event] ??= []).push(callback),
  off: (event, callback) => (listeners[event] = listeners[event]?.filter(other => other !== callback)),
};
widget.render({ model, el: document.body });
addEventListener('resize', () => model.set('height', innerHeight - 8));
let sizes = '';
new EventSource('states').onmessage = ({ data }) => {
  const state = JSON.parse(data);
  values.poses = bytes(state.poses);
  // Poses of other blocks come with their sizes.
  if (state.sizes !== sizes) model.set('sizes', bytes((sizes = state.sizes)));
  else emit('poses');
};
"""


class Window:
    """Page on this machine, at ``address``. It answers to no other name and no other machine.

    Raises UnavailableError where the view was not built.
    """

    def __init__(self) -> None:
        bundle.require()
        self._news = threading.Condition()
        self._state: str | None = None
        self._number = 0
        self._is_open = True
        window = self

        class Handler(_Handler):
            owner = window

        self._server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self._server.daemon_threads = True
        self.address = f"http://127.0.0.1:{self._server.server_port}/"
        threading.Thread(target=self._server.serve_forever, daemon=True).start()

    def open(self) -> None:
        """Opens the page in the browser of the user."""
        webbrowser.open(self.address)

    def show(self, world: World) -> None:
        """Draws a world in its present state."""
        state = json.dumps({"sizes": _encoded(world.sizes), "poses": _encoded(world.poses)})
        with self._news:
            self._state, self._number = state, self._number + 1
            self._news.notify_all()

    def close(self) -> None:
        """Ends the page: it keeps its last picture."""
        with self._news:
            self._is_open = False
            self._news.notify_all()
        self._server.shutdown()
        self._server.server_close()

    def wait(self, number: int) -> tuple[int, str | None]:
        """Waits for a state after that of a number. Returns its number and the state, None where none came."""
        with self._news:
            self._news.wait_for(lambda: self._number > number or not self._is_open, QUIET)
            return self._number, self._state if self._number > number else None

    @property
    def is_open(self) -> bool:
        """True until the window was closed."""
        return self._is_open


def _encoded(values: Any) -> str:
    return base64.b64encode(np.ascontiguousarray(values, np.float32).tobytes()).decode()


class _Handler(BaseHTTPRequestHandler):
    owner: Window

    def do_GET(self) -> None:
        """Answers with a file of the page, or with states as they come."""
        # A page of the web must not read it by a name that leads to this machine.
        if self.headers.get("Host") != self.owner.address.split("/")[2]:
            self.send_error(421)
        elif self.path == "/states":
            self._send_states()
        elif self.path == "/":
            self._send("text/html; charset=utf-8", PAGE.encode())
        elif self.path == "/window.js":
            self._send("text/javascript; charset=utf-8", SCRIPT.encode())
        elif self.path == "/widget.js":
            self._send("text/javascript; charset=utf-8", bundle.require().read_bytes())
        else:
            self.send_error(404)

    def log_message(self, *_: Any) -> None:
        """Writes nothing: the program of the user has the terminal."""

    def _begin(self, kind: str) -> None:
        self.send_response(200)
        self.send_header("Content-Type", kind)
        self.send_header("Cache-Control", "no-store")
        self.send_header("Content-Security-Policy", SECURITY)

    def _send(self, kind: str, content: bytes) -> None:
        self._begin(kind)
        self.send_header("Content-Length", str(len(content)))
        self.end_headers()
        self.wfile.write(content)

    def _send_states(self) -> None:
        self._begin("text/event-stream")
        self.end_headers()
        number = 0
        while self.owner.is_open:
            number, state = self.owner.wait(number)
            line = ": none\n\n" if state is None else f"data: {state}\n\n"
            try:
                self.wfile.write(line.encode())
                self.wfile.flush()
            except OSError:
                # The page was closed.
                return
