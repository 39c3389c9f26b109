#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Drives the page of `homeward explore --serve` and `homeward map serve` in Chromium, as people do.

Usage: dashboard_test.py HOMEWARD WORLD [--pictures FOLDER]

Selenium, because Debian packages it with its chromedriver; Playwright would have to come from
elsewhere. An error in the page's console is a failure."""

import argparse
import base64
import json
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

try:
    from selenium import webdriver
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
except ImportError:
    print("skipped: no selenium (Debian: python3-selenium)")
    sys.exit(77)

CHROMIUM = pathlib.Path("/usr/bin/chromium")
DRIVER = pathlib.Path("/usr/bin/chromedriver")


def browser():
    options = Options()
    options.binary_location = str(CHROMIUM)
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=1440,1000"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service(str(DRIVER)), options=options)


def wait(what, condition, seconds=60.0):
    """Until the condition holds; fails with its last value."""
    end = time.monotonic() + seconds
    value = condition()
    while not value:
        if time.monotonic() > end:
            raise AssertionError(f"{what}: not within {seconds:.0f} s, last {value!r}")
        time.sleep(0.05)
        value = condition()
    return value


class Page:
    """The page in a browser."""

    def __init__(self, driver, url):
        self.driver = driver
        driver.get("about:blank")
        driver.get(url)

    def script(self, text, *arguments):
        return self.driver.execute_script(text, *arguments)

    def text(self, name):
        return self.script("return document.getElementById(arguments[0]).textContent", name)

    def robot(self):
        return self.script("return document.body.dataset.robot")

    def nodes(self):
        return int(self.script("return document.getElementById('map').dataset.nodes || '0'"))

    def click(self, name):
        wait(f"{name} can be clicked", lambda: self.driver.find_element(By.ID, name).is_enabled() and
             self.driver.find_element(By.ID, name).is_displayed())
        self.driver.find_element(By.ID, name).click()

    def press(self, keys):
        self.driver.switch_to.active_element.send_keys(keys)

    def answer(self, words):
        return wait(f"the answer '{words}'", lambda: words in self.text("answer"))

    def focus(self, name):
        self.script("document.getElementById(arguments[0]).focus()", name)

    def picture(self, file, width, height=1000):
        size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
        time.sleep(0.4)
        over = self.script("return document.documentElement.scrollWidth - window.innerWidth")
        assert over <= 0, f"{width} pixels: the page is {over} pixels wider than the window"
        if file:
            self.script("scrollTo(0, 0)")
            shot = self.driver.execute_cdp_cmd("Page.captureScreenshot", {"captureBeyondViewport": True})
            pathlib.Path(file).write_bytes(base64.b64decode(shot["data"]))
        self.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})

    def expect_no_complaints(self):
        """Errors of the page; a command that was refused and a program that has ended are none."""
        messages = [line["message"] for line in self.driver.get_log("browser") if line["level"] == "SEVERE"]
        messages = [message for message in messages if "Failed to load resource" not in message]
        assert messages == [], messages


class Program:
    """homeward with its page open."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        line = self.process.stdout.readline()
        if "built without its page" in line:
            print("skipped: " + line.strip())
            sys.exit(77)
        assert line.startswith("open http"), line + self.process.stdout.read()
        self.url = line.split()[1]

    def end(self):
        """@return exit status and all that it said since"""
        self.process.send_signal(signal.SIGINT)
        try:
            said = self.process.communicate(timeout=30)[0]
        except subprocess.TimeoutExpired:
            self.process.kill()
            raise
        return self.process.returncode, said


def explore(driver, homeward, world, folder, pictures):
    """A whole exploration, with all that can be commanded on the way."""
    file = folder / "lab.hwm"
    program = Program(homeward, "explore", "--world", world, "--map", file, "--serve", "0")
    try:
        page = Page(driver, program.url)
        wait("three places", lambda: page.nodes() >= 3)
        assert "token" not in driver.current_url

        page.click("pause")
        wait("it stands", lambda: page.robot() == "stands")
        before = page.nodes()
        time.sleep(0.7)
        assert page.nodes() == before, "it went on while it was paused"
        page.press("p")  # the same by key
        page.answer("it goes on")
        wait("it drives", lambda: page.robot() == "drives")
        wait("more places", lambda: page.nodes() > before + 1)

        page.focus("map")
        page.press(Keys.ESCAPE)
        page.answer("emergency stop")
        wait("emergency", lambda: page.robot() == "emergency")
        wait("it stands", lambda: driver.find_element(By.ID, "resume").is_displayed())
        page.press("p")
        page.answer("release the emergency stop first")
        page.click("release")
        wait("it stands", lambda: page.robot() == "stands")
        page.click("resume")
        wait("it drives", lambda: page.robot() == "drives")
        if pictures:
            wait("it drives home", lambda: "arrow points" in page.text("viewWords"))
            for width in (1440, 1024, 390):
                page.picture(pictures / f"dashboard-{width}.png", width)

        wait("the end", lambda: "done" in page.text("words"), 400)
        places = page.nodes()

        # By keyboard alone: choose a place, go there, name it, take that back.
        page.focus("map")
        page.press(Keys.ARROW_RIGHT)
        wait("a place is chosen", lambda: page.text("placeTitle") == "Place 0")
        page.press(Keys.ENTER)
        page.answer("it drives to node 0")
        wait("it arrived", lambda: "arrived at node 0" in page.text("words"), 120)
        page.focus("name")
        page.press("the kitchen" + Keys.ENTER)
        page.answer("node 0 is the kitchen")
        page.focus("map")
        wait("its name", lambda: page.text("placeTitle") == "Place 0, the kitchen")
        page.press("u")
        page.answer("undone: node 0 is the kitchen")
        wait("no name", lambda: page.text("placeTitle") == "Place 0")

        # By mouse: another place.
        page.press(Keys.ARROW_RIGHT)
        wait("another place", lambda: page.text("placeTitle") != "Place 0")
        title = page.text("placeTitle")
        at = [int(word) for word in page.script("return document.getElementById('map').dataset.chosenAt").split()]
        page.press(Keys.ARROW_LEFT)
        page.press(Keys.ARROW_DOWN)
        wait("a third place", lambda: page.text("placeTitle") != title)
        canvas = driver.find_element(By.ID, "map")
        size = canvas.rect
        ActionChains(driver).move_to_element_with_offset(
            canvas, at[0] - size["width"] // 2, at[1] - size["height"] // 2).click().perform()
        wait("the place that was clicked", lambda: page.text("placeTitle") == title)
        page.click("go")
        node = title.split()[1]
        page.answer(f"it drives to node {node}")
        wait("it arrived", lambda: f"arrived at node {node}" in page.text("words"), 120)
        assert page.nodes() == places
        for width in (1440, 1024, 390):
            page.picture(pictures / f"dashboard-done-{width}.png" if pictures else None, width)
        page.expect_no_complaints()
    finally:
        status, said = program.end()
    assert status == 0, said
    assert "done: arrived at node 0" in said, said
    return file


def other_browser(driver, homeward, file):
    """A second tab is told that somebody else commands; it can take over."""
    program = Program(homeward, "map", "serve", file)
    try:
        first = Page(driver, program.url)
        wait("the map", lambda: first.nodes() > 5)
        first.focus("map")
        first.press(Keys.ARROW_RIGHT)
        first.script("document.querySelector('#place tbody button:not([disabled])')")
        first.press("u")
        first.answer("undone" if "undone" in first.text("answer") else "edit")
        home = driver.current_window_handle
        driver.switch_to.new_window("tab")
        second = Page(driver, program.url)
        wait("the map", lambda: second.nodes() > 5)
        wait("take over is offered", lambda: driver.find_element(By.ID, "take").is_displayed())
        assert not driver.find_element(By.ID, "undo").is_enabled()
        second.click("take")
        second.answer("you command now")
        wait("nothing to take", lambda: not driver.find_element(By.ID, "take").is_displayed())
        # The timeline plays the exploration again.
        second.click("play")
        wait("few places", lambda: second.nodes() < 4)
        wait("all places again", lambda: second.text("timeWords") == "all of it")
        driver.close()
        driver.switch_to.window(home)
        wait("it may command again", lambda: not driver.find_element(By.ID, "take").is_displayed(), 10)
        first.expect_no_complaints()
    finally:
        program.end()


def large_map(driver, homeward, file):
    """Frames of a large map while it is moved."""
    program = Program(homeward, "map", "serve", file)
    try:
        page = Page(driver, program.url)
        wait("the map", lambda: page.nodes() == 2000, 90)
        frames = driver.execute_async_script("""
            const done = arguments[arguments.length - 1];
            const map = document.getElementById('map');
            const times = [];
            let last = performance.now();
            const step = (now) => {
              times.push(now - last);
              last = now;
              map.dispatchEvent(new WheelEvent('wheel', {deltaY: times.length % 2 ? 100 : -90, cancelable: true}));
              times.length < 120 ? requestAnimationFrame(step) : done(times.slice(5).sort((a, b) => a - b));
            };
            requestAnimationFrame(step);""")
        median, late = frames[len(frames) // 2], frames[int(0.95 * len(frames))]
        draw = page.script("return document.getElementById('map').dataset.drawMs")
        print(f"2000 places: {median:.1f} ms a frame, 95 % within {late:.1f} ms; drawing takes {draw} ms")
        assert late < 100, frames
        page.expect_no_complaints()
    finally:
        program.end()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("homeward")
    parser.add_argument("world")
    parser.add_argument("--large", help="map of 2000 places")
    parser.add_argument("--pictures", type=pathlib.Path, help="folder for screenshots")
    arguments = parser.parse_args()
    if not CHROMIUM.exists() or not DRIVER.exists():
        print("skipped: no Chromium (Debian: chromium, chromium-driver)")
        sys.exit(77)
    driver = browser()
    try:
        with tempfile.TemporaryDirectory() as folder:
            file = explore(driver, arguments.homeward, arguments.world, pathlib.Path(folder), arguments.pictures)
            other_browser(driver, arguments.homeward, file)
            if arguments.large:
                large_map(driver, arguments.homeward, arguments.large)
    finally:
        driver.quit()


if __name__ == "__main__":
    main()
