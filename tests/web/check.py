"""Uses the page in Chromium as people do: check.py BUILD

BUILD has page/ and page_tested/ (hapticwall_page, hapticwall_page_tested). Pictures go to BUILD/pictures.
"""

import pathlib
import shutil
import statistics
import sys
import time

from browser import Browser, served

build = pathlib.Path(sys.argv[1])
pictures = build / "pictures"
press_script = (pathlib.Path(__file__).parent / "press.js").read_text()
failures = []


def check(condition, what):
    if not condition:
        failures.append(what)
        print(f"FAILED: {what}", flush=True)


def open_page(browser, url, frames=30, width=1280, height=800, scale=1, touch=False):
    browser.log.clear()
    browser.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale, mobile=touch)
    browser.call("Emulation.setTouchEmulationEnabled", enabled=touch)
    browser.call("Page.navigate", url="about:blank")
    browser.call("Page.navigate", url=url)
    if frames:
        browser.wait_for(f"window.Module && Module.frames && Module.frames.length >= {frames}", f"{frames} frames of {url}")
        browser.ask(press_script + "; 0")


def facts(browser):
    return browser.ask("see()")


def press_key(browser, code, number):
    browser.ask(f"key('{code}', {number})")


def figures_of_a_page(browser, url):
    for name in ("index.html", "hapticwall.html"):
        open_page(browser, f"{url}/page/{name}", frames=120)
        times = browser.ask("Module.frames.slice(1)")
        first = browser.ask("Module.firstFrame")
        print(f"{name}: first frame {first / 1e3:.2f} s, a frame {statistics.median(times):.1f} ms by a software renderer")
        check(not browser.problems(), f"{name} is silent: {browser.problems()}")
    browser.picture(str(pictures / "first.png"))


def wrong_links(browser, url):
    message = "(document.getElementById('message') || {textContent: ''}).textContent"
    for wrong, named in (("scene=tapp", "tapp"), ("algorithm=eba", "eba"),
                         ("set=wall.stiffness_n_per_m=-1", "stiffness_n_per_m"), ("set=nonsense", "nonsense")):
        open_page(browser, f"{url}/page/index.html?{wrong}", frames=0)
        browser.wait_for(f"{message}.includes('{named}')", f"a line about {wrong}")
        print(f"{wrong}: {browser.ask(message)}")


def link(browser, url):
    open_page(browser, f"{url}/page_tested/index.html?scene=tap&algorithm=half-sample&set=wall.stiffness_n_per_m=5000")
    seen = facts(browser)
    check(seen["scene"] == "tap" and seen["algorithm"] == 6, f"the link chooses scene and algorithm: {seen}")
    for algorithm in range(8):
        press_key(browser, f"Digit{algorithm + 1}", 49 + algorithm)
        check(facts(browser)["algorithm"] == algorithm, f"key {algorithm + 1} chooses its algorithm")


def every_control(browser, url):
    # High enough that nothing has to be scrolled to.
    open_page(browser, f"{url}/page_tested/index.html", width=1280, height=1800)
    start = time.monotonic()
    report = browser.ask("pressEverything(1500)", limit_s=900)
    print(f"{report['pressed']} controls pressed, {report['presses']} presses in {time.monotonic() - start:.0f} s")
    check(report["pressed"] >= 150, "all of the window was reached")
    check(not report["left"], f"nothing is left: {report['left']}")
    frames = facts(browser)["frames"]
    check(facts(browser)["frames"] > frames, "the page lives")
    check(not browser.problems(), f"no control brings an exception: {browser.problems()}")
    browser.picture(str(pictures / "pressed.png"))


def hidden(browser, url):
    open_page(browser, f"{url}/page_tested/index.html")
    before = facts(browser)["time_s"]
    other = browser.call("Target.createTarget", url="about:blank")["targetId"]
    browser.call("Target.activateTarget", targetId=other)
    time.sleep(10)
    state = browser.ask("document.visibilityState")
    browser.call("Target.closeTarget", targetId=other)
    browser.call("Target.activateTarget", targetId=browser.target)
    after = facts(browser)
    print(f"hidden for 10 s ({state}): the session went on by {after['time_s'] - before:.2f} s, {after['missed']} ticks missed")
    check(state == "hidden", "the page was hidden")
    check(after["time_s"] - before < 5, "the time of a hidden page is left out")
    check(after["missed"] == 0, "and counts as no missed tick")
    check(not browser.problems(), f"hidden: {browser.problems()}")


def sizes(browser, url):
    open_page(browser, f"{url}/page_tested/index.html")
    for width, height, scale in ((1024, 680, 1), (1600, 1000, 1), (1280, 800, 2), (820, 1180, 2)):
        browser.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale, mobile=False)
        browser.wait_for(f"Module.canvas.width === {width * scale} && Module.canvas.height === {height * scale}",
                         f"a canvas of {width} x {height} at {scale}")
        browser.ask("frames(20)")
        check(facts(browser)["scale"] == scale, f"the scale {scale}")
        browser.picture(str(pictures / f"{width}x{height}-{scale}.png"))
    check(not browser.problems(), f"sizes: {browser.problems()}")


def touch(browser, url):
    open_page(browser, f"{url}/page_tested/index.html", touch=True)
    place = {"x": 150.0, "y": 280.0}
    browser.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=[place])
    for step in range(1, 11):
        moved = {"x": place["x"] + 5 * step, "y": place["y"]}
        browser.call("Input.dispatchTouchEvent", type="touchMove", touchPoints=[moved])
        browser.ask("frames(2)")
    seen = facts(browser)
    browser.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
    check(seen["led"], f"a finger leads the hand: {seen}")
    check(not browser.problems(), f"touch: {browser.problems()}")
    browser.picture(str(pictures / "touch.png"))


# The keys of the five lessons, in order; what each waits for is judged by the tour itself.
LESSONS = (("1",), ("3",), ("2", "r"), ("4", "r"), ("1", "4", "r"))


def tour(browser, url):
    open_page(browser, f"{url}/page_tested/index.html")
    browser.ask("see()")
    browser.ask("(c => click(c.x, c.y))(Module.controls.find(each => each.label.includes('begin tour')))")
    for number, keys in enumerate(LESSONS, 1):
        check(facts(browser)["tour"] == number, f"step {number} of the tour")
        for each in keys:
            press_key(browser, f"Digit{each}" if each.isdigit() else "KeyR", ord(each.upper()))
            time.sleep(4)
        for _ in range(30):
            if facts(browser)["seen"] >= number:
                break
            time.sleep(0.5)
        check(facts(browser)["seen"] >= number, f"lesson {number} is seen")
        browser.picture(str(pictures / f"tour-{number}.png"))
        browser.ask("see().then(() => (c => click(c.x, c.y))(Module.controls.find(each => each.label.includes('tour next'))))")
    check(facts(browser)["tour"] == 6, "the tour has its end")
    browser.picture(str(pictures / "tour-end.png"))
    check(not browser.problems(), f"tour: {browser.problems()}")


def main():
    pictures.mkdir(exist_ok=True)
    program = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if not program:
        sys.exit("there is no Chromium here")
    browser = Browser(program)
    try:
        with served(str(build)) as url:
            for part in (figures_of_a_page, wrong_links, link, sizes, touch, hidden, tour, every_control):
                print(f"-- {part.__name__}", flush=True)
                part(browser, url)
    finally:
        browser.close()
    print(f"{len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
