"""Uses the page in Chromium as people do: check.py BUILD

BUILD has page/ and page_tested/ (hapticwall_page, hapticwall_page_tested). Pictures go to BUILD/pictures.
"""

import functools
import http.server
import pathlib
import statistics
import sys
import threading
import time

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.support.ui import WebDriverWait

BUILD = pathlib.Path(sys.argv[1])
PICTURES = BUILD / "pictures"
PRESS = (pathlib.Path(__file__).parent / "press.js").read_text()
OPTIONS = ("--headless=new --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader --mute-audio "
           "--disable-background-networking --disable-component-update --disable-sync --no-first-run").split()
failures = []


class Server(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


class Page:
    """A page of BUILD in one browser."""

    def __init__(self):
        options = webdriver.ChromeOptions()
        for each in OPTIONS:
            options.add_argument(each)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
        self.driver.set_script_timeout(1200)
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Server, directory=BUILD))
        threading.Thread(target=server.serve_forever, daemon=True).start()
        self.url = f"http://127.0.0.1:{server.server_port}/"

    def open(self, path="page_tested/index.html", frames=30, width=1280, height=800, scale=1, touch=False):
        self.driver.get("about:blank")
        self.driver.get_log("browser")
        self.size(width, height, scale, touch)
        self.driver.get(self.url + path)
        if frames:
            self.wait(f"Module.frames.length >= {frames}")
            self.driver.execute_script("const all = document.createElement('script'); all.textContent = arguments[0];"
                                       "document.body.append(all);", PRESS)

    def size(self, width, height, scale, touch=False):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale, mobile=touch)
        self.call("Emulation.setTouchEmulationEnabled", enabled=touch)

    def call(self, method, **parameters):
        return self.driver.execute_cdp_cmd(method, parameters)

    def ask(self, script):
        return self.driver.execute_script(f"return {script}")

    def do(self, promise):
        """The value of a promise of press.js."""
        return self.driver.execute_async_script(f"({promise}).then(arguments[0])")

    def wait(self, condition):
        WebDriverWait(self.driver, 60).until(lambda _: self.ask(condition), condition)

    def key(self, code, number):
        self.do(f"key('{code}', {number})")

    def click(self, label):
        self.do(f"see().then(() => (c => click(c.x, c.y))(Module.controls.find(c => c.label.includes('{label}'))))")

    def picture(self, name):
        self.driver.save_screenshot(str(PICTURES / f"{name}.png"))

    def expect_silence(self):
        loud = [each["message"] for each in self.driver.get_log("browser") if each["level"] != "INFO"][:3]
        expect(not loud, f"the log of the page is empty: {loud}")


def expect(condition, what):
    if not condition:
        failures.append(what)
        print(f"FAILED: {what}", flush=True)


def figures(page):
    for name in ("index", "hapticwall"):
        page.open(f"page/{name}.html", frames=120)
        frame_ms = statistics.median(page.ask("Module.frames.slice(1)"))
        print(f"{name}.html: first frame {page.ask('Module.firstFrame') / 1e3:.2f} s, a frame {frame_ms:.1f} ms")
        page.expect_silence()
    page.picture("first")


def wrong_links(page):
    for wrong, named in (("scene=tapp", "tapp"), ("algorithm=eba", "eba"), ("set=nonsense", "nonsense"),
                         ("set=wall.stiffness_n_per_m=-1", "wall.stiffness_n_per_m: -1")):
        page.open(f"page/index.html?{wrong}", frames=0)
        page.wait(f"document.getElementById('message').textContent.includes('{named}')")


def links_and_keys(page):
    page.open("page_tested/index.html?scene=tap&algorithm=half-sample&set=wall.stiffness_n_per_m=5000")
    seen = page.do("see()")
    expect((seen["scene"], seen["algorithm"], seen["stiffness"]) == ("tap", 6, 5000), f"the link chooses: {seen}")
    for algorithm in range(8):
        page.key(f"Digit{algorithm + 1}", 49 + algorithm)
        expect(page.do("see()")["algorithm"] == algorithm, f"key {algorithm + 1} chooses its algorithm")
    page.expect_silence()


def sizes(page):
    page.open()
    for width, height, scale in ((1024, 680, 1), (1600, 1000, 1), (1280, 800, 2), (820, 1180, 2)):
        page.size(width, height, scale)
        page.wait(f"Module.canvas.width === {width * scale} && Module.canvas.height === {height * scale}")
        page.do("frames(20)")
        expect(page.do("see()")["scale"] == scale, f"the scale {scale}")
        page.picture(f"{width}x{height}-{scale}")
    page.expect_silence()


def touch(page):
    page.open(touch=True)
    for step in range(11):
        point = {"x": 150 + 5 * step, "y": 280}
        page.call("Input.dispatchTouchEvent", type="touchMove" if step else "touchStart", touchPoints=[point])
        page.do("frames(2)")
    seen = page.do("see()")
    page.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
    expect(seen["led"], f"a finger leads the hand: {seen}")
    page.expect_silence()


def hidden(page):
    page.open()
    page.ask("(window.states = [], document.addEventListener('visibilitychange', () => states.push(document.hidden)))")
    before = page.do("see()")["time_s"]
    here = page.driver.current_window_handle
    page.driver.switch_to.new_window("tab")
    time.sleep(10)
    page.driver.close()
    page.driver.switch_to.window(here)
    after = page.do("see()")
    print(f"hidden for 10 s: the session went on by {after['time_s'] - before:.2f} s, {after['missed']} ticks missed")
    expect(page.ask("states")[:1] == [True], "the page was hidden")
    expect(after["time_s"] - before < 5 and after["missed"] == 0, "the time of a hidden page is left out, not missed")
    page.expect_silence()


# The tour itself judges what a lesson waits for.
LESSONS = ("1", "3", "2R", "4R", "14R")


def tour(page):
    page.open()
    page.click("begin tour")
    for number, keys in enumerate(LESSONS, 1):
        expect(page.do("see()")["tour"] == number, f"step {number} of the tour")
        for each in keys:
            page.key(f"Digit{each}" if each.isdigit() else "KeyR", ord(each))
            time.sleep(4)
        until = time.monotonic() + 20
        while page.do("see()")["seen"] < number and time.monotonic() < until:
            time.sleep(0.2)
        expect(page.do("see()")["seen"] == number, f"lesson {number} is seen")
        page.picture(f"tour-{number}")
        page.click("tour next")
    expect(page.do("see()")["tour"] == len(LESSONS) + 1, "the tour has its end")
    page.picture("tour-end")
    page.expect_silence()


def every_control(page):
    page.open(height=2400)  # nothing has to be scrolled to
    report = page.do("pressEverything(1500)")
    print(f"{report['pressed']} controls, {report['presses']} presses")
    expect(report["pressed"] >= 300 and not report["left"], f"every control was reached: {report}")
    frames = page.do("see()")["frames"]
    expect(page.do("see()")["frames"] > frames, "the page lives")
    page.expect_silence()
    page.picture("pressed")


def main():
    PICTURES.mkdir(exist_ok=True)
    page = Page()
    try:
        for part in (figures, wrong_links, links_and_keys, sizes, touch, hidden, tour, every_control):
            print(f"-- {part.__name__}", flush=True)
            part(page)
    finally:
        page.driver.quit()
    print(f"{len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
