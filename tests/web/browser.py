"""Chromium without a display, driven through the pipe of its DevTools protocol."""

import base64
import contextlib
import functools
import http.server
import json
import os
import select
import subprocess
import tempfile
import threading
import time


class Browser:
    """One page. Every call raises TimeoutError after `limit_s` without an answer."""

    def __init__(self, program: str, limit_s: float = 60.0):
        self.limit_s = limit_s
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        read_here, write_there = os.pipe()
        read_there, write_here = os.pipe()
        self.to, self.from_ = write_here, read_here

        def as_3_and_4():
            kept = os.dup(write_there)
            os.dup2(read_there, 3)
            os.dup2(kept, 4)

        options = ("--headless=new --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader --mute-audio "
                   "--disable-background-networking --disable-component-update --disable-sync --no-first-run "
                   "--disable-quic --remote-debugging-pipe --window-size=1280,800").split()
        self.process = subprocess.Popen(
            [program, *options, f"--user-data-dir={self.profile.name}", "about:blank"], pass_fds=(3, 4),
            preexec_fn=as_3_and_4, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        os.close(read_there)
        os.close(write_there)
        self.rest, self.number, self.log, self.session = b"", 0, [], None
        pages = [each for each in self.call("Target.getTargets")["targetInfos"] if each["type"] == "page"]
        self.target = pages[0]["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=self.target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime"):
            self.call(f"{domain}.enable")

    def close(self):
        with contextlib.suppress(OSError):
            os.killpg(self.process.pid, 9)
        self.process.wait()
        self.profile.cleanup()

    def _message(self, until: float) -> dict:
        while b"\0" not in self.rest:
            left = until - time.monotonic()
            if left <= 0 or not select.select([self.from_], [], [], left)[0]:
                raise TimeoutError("the browser does not answer")
            self.rest += os.read(self.from_, 1 << 20)
        line, _, self.rest = self.rest.partition(b"\0")
        return json.loads(line)

    def call(self, method: str, limit_s: float | None = None, **parameters) -> dict:
        self.number += 1
        wanted = {"id": self.number, "method": method, "params": parameters}
        if self.session and not method.startswith("Target."):
            wanted["sessionId"] = self.session
        os.write(self.to, json.dumps(wanted).encode() + b"\0")
        until = time.monotonic() + (limit_s or self.limit_s)
        while True:
            message = self._message(until)
            if message.get("method") in ("Runtime.exceptionThrown", "Runtime.consoleAPICalled"):
                self.log.append(message)
            if message.get("id") == self.number:
                if "error" in message:
                    raise RuntimeError(f"{method}: {message['error']['message']}")
                return message["result"]

    def ask(self, script: str, limit_s: float | None = None):
        """The value of a JavaScript expression, or of its promise."""
        answer = self.call("Runtime.evaluate", limit_s, expression=script, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(answer["exceptionDetails"]["exception"].get("description", "an exception"))
        return answer["result"].get("value")

    def wait_for(self, condition: str, what: str):
        until = time.monotonic() + self.limit_s
        while not self.ask(condition):
            if time.monotonic() > until:
                raise TimeoutError(f"{what} has not come: {self.problems()}")
            time.sleep(0.05)

    def picture(self, path: str):
        with open(path, "wb") as file:
            file.write(base64.b64decode(self.call("Page.captureScreenshot")["data"]))

    def problems(self) -> list[str]:
        """Exceptions, and what the page has written to its console as an error or a warning."""
        found = []
        for message in self.log:
            if message["method"] == "Runtime.exceptionThrown":
                details = message["params"]["exceptionDetails"]
                found.append(details.get("exception", {}).get("description", details["text"]))
            elif message["params"]["type"] in ("error", "warning", "assert"):
                found.append(" ".join(str(each.get("value", each)) for each in message["params"]["args"]))
        return found


class _Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


@contextlib.contextmanager
def served(folder: str):
    """The address of a web server for a folder."""
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(_Quiet, directory=folder))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}"
    server.shutdown()
