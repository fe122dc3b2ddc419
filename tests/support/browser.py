"""A headless Chromium that is told what to do through a pipe (Chrome DevTools Protocol): nothing to install beside it."""
import base64
import json
import os
import shutil
import subprocess
import tempfile
import time
from pathlib import Path


def find():
    for name in ("chromium", "chromium-browser", "google-chrome"):
        if shutil.which(name):
            return name
    return None


class Browser:
    """One page. Faults of its scripts are in .faults, addresses that it asked for in .asked."""

    def __init__(self, width, height):
        self.folder = tempfile.mkdtemp()
        to_browser, self.write = os.pipe()
        self.read, from_browser = os.pipe()

        def pipes():
            a, b = os.dup(to_browser), os.dup(from_browser)
            os.dup2(a, 3)
            os.dup2(b, 4)

        self.process = subprocess.Popen(
            [find(), "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-sync",
             "--disable-background-networking", "--disable-component-update", "--remote-debugging-pipe", f"--user-data-dir={self.folder}",
             f"--window-size={width},{height}", "about:blank"],
            close_fds=False, preexec_fn=pipes, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self.buffer, self.next, self.answers = b"", 1, {}
        self.contexts, self.faults, self.asked = {}, [], []
        target = next(t for t in self.call("Target.getTargets")["targetInfos"] if t["type"] == "page")
        self.session = self.call("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]
        self.watch(self.session)
        self.page("Page.enable")

    def watch(self, session):
        for method in ("Runtime.enable", "Network.enable", "Log.enable"):
            self.post(session, method, {})
        self.post(session, "Target.setAutoAttach", {"autoAttach": True, "waitForDebuggerOnStart": False, "flatten": True})

    def post(self, session, method, params):
        message = {"id": self.next, "method": method, "params": params, **({"sessionId": session} if session else {})}
        self.next += 1
        os.write(self.write, json.dumps(message).encode() + b"\0")
        return message["id"]

    def listen(self):
        while b"\0" not in self.buffer:
            more = os.read(self.read, 1 << 20)
            assert more, "the browser is gone"
            self.buffer += more
        text, self.buffer = self.buffer.split(b"\0", 1)
        message = json.loads(text)
        params, session = message.get("params", {}), message.get("sessionId")
        if "id" in message:
            self.answers[message["id"]] = message
            return
        match message["method"]:
            case "Target.attachedToTarget" if session:
                if params["targetInfo"]["type"] == "iframe":
                    self.watch(params["sessionId"])
            case "Runtime.executionContextCreated":
                self.contexts[session, params["context"]["id"]] = params["context"]
            case "Runtime.executionContextDestroyed":
                self.contexts.pop((session, params["executionContextId"]), None)
            case "Runtime.executionContextsCleared":
                self.contexts = {k: v for k, v in self.contexts.items() if k[0] != session}
            case "Runtime.exceptionThrown":
                d = params["exceptionDetails"]
                self.faults.append(d.get("exception", {}).get("description", d["text"]))
            case "Log.entryAdded" if params["entry"]["level"] == "error":
                self.faults.append(params["entry"]["text"])
            case "Network.requestWillBeSent":
                self.asked.append(params["request"]["url"])

    def call(self, method, session=None, **params):
        number = self.post(session, method, params)
        while number not in self.answers:
            self.listen()
        answer = self.answers.pop(number)
        if "error" in answer:
            raise RuntimeError(f"{method}: {answer['error']}")
        return answer["result"]

    def page(self, method, **params):
        return self.call(method, self.session, **params)

    def evaluate(self, expression, where=None):
        session, context = where or (self.session, None)
        more = {"contextId": context} if context else {}
        result = self.call("Runtime.evaluate", session, expression=expression, returnByValue=True, awaitPromise=True, **more)
        if "exceptionDetails" in result:
            raise RuntimeError(f"{expression}: {result['exceptionDetails']['exception'].get('description')}")
        return result["result"].get("value")

    def wait(self, what, seconds, expression, where=None):
        """The first value of the expression that is true."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            value = self.evaluate(expression, where() if callable(where) else where)
            if value:
                return value
            time.sleep(0.1)
        raise AssertionError(f"{what}: not in {seconds} s")

    def frame_with(self, expression, seconds=20):
        """The context of the page or frame in which the expression is true."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            for place in list(self.contexts):
                try:
                    if self.evaluate(f"Boolean({expression})", place):
                        return place
                except RuntimeError:  # it is going
                    pass
            time.sleep(0.1)
        raise AssertionError(f"no frame where {expression}")

    def resize(self, width, height, phone):
        self.page("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=2 if phone else 1, mobile=phone)
        self.page("Emulation.setTouchEmulationEnabled", enabled=phone)

    def open(self, url):
        self.page("Page.navigate", url=url)

    def key(self, name):
        code = {"ArrowRight": 39, "ArrowLeft": 37, "Home": 36, " ": 32}[name]
        text = {"text": name} if len(name) == 1 else {}
        for kind in ("keyDown", "keyUp"):
            self.page("Input.dispatchKeyEvent", type=kind, key=name, code=name if name != " " else "Space", windowsVirtualKeyCode=code,
                      **(text if kind == "keyDown" else {}))

    def tap(self, x, y):
        self.page("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": x, "y": y}])
        self.page("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])

    def screenshot(self, path):
        Path(path).write_bytes(base64.b64decode(self.page("Page.captureScreenshot", format="png")["data"]))

    def close(self):
        self.process.kill()
        self.process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)
