#!/usr/bin/env python3
"""Pictures of the dashboard's pages, of the programme that `seldinger demo --programme` makes.

    tests/gallery/pages.py build/release/seldinger LIBRARY docs/gallery/pages

Sets the passwords of the demo's accounts anew. Needs Chromium. A page is taken as the server gives it, with its style
sheet, script and pictures, and drawn from a copy, since a browser without a window has no session.
"""
import functools
import http.cookiejar
import http.server
import os
import re
import secrets
import subprocess
import sys
import tempfile
import threading
import urllib.parse
import urllib.request

WIDE, NARROW = (1280, 1100), (390, 1500)


def opened(base, name, password):
    browser = urllib.request.build_opener(urllib.request.HTTPCookieProcessor(http.cookiejar.CookieJar()))
    form = browser.open(base + "/login").read().decode()
    token = re.search(r'name="token" value="([^"]+)"', form).group(1)
    fields = urllib.parse.urlencode({"token": token, "name": name, "password": password}).encode()
    browser.open(urllib.request.Request(base + "/login", fields, {"Origin": base}))
    return browser


def first_link(browser, base, page, pattern):
    return re.search(pattern, browser.open(base + page).read().decode()).group(1)


def keep(folder, path, content):
    file = folder + path
    os.makedirs(os.path.dirname(file), exist_ok=True)
    with open(file, "wb") as out:
        out.write(content)


def draw(browser, base, path, out, size):
    with tempfile.TemporaryDirectory() as copy:
        page = browser.open(base + path).read()
        keep(copy, "/shown.html", page)
        for asset in sorted(set(re.findall(rb'(?:src|href|data-replay)="(/[^"]+\.(?:css|js|json|png))"', page))):
            keep(copy, asset.decode(), browser.open(base + asset.decode()).read())
        quiet = type("Quiet", (http.server.SimpleHTTPRequestHandler,), {"log_message": lambda *_: None})
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(quiet, directory=copy))
        threading.Thread(target=server.serve_forever, daemon=True).start()
        subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
                        "--virtual-time-budget=4000", "--screenshot=" + out, "--window-size=%d,%d" % size,
                        "http://127.0.0.1:%d/shown.html" % server.server_port],
                       check=True, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        server.shutdown()


def main():
    program, library, out = (os.path.abspath(argument) for argument in sys.argv[1:4])
    os.makedirs(out, exist_ok=True)
    password = secrets.token_urlsafe(18)
    for name in ("trainee", "mentor", "director", "researcher", "admin"):
        subprocess.run([program, "user", "passwd", name, "--library", library], input=password.encode(), check=True,
                       stdout=subprocess.DEVNULL)
    server = subprocess.Popen([program, "serve", "--library", library, "--port", "0"], stdout=subprocess.PIPE, text=True,
                              stderr=subprocess.DEVNULL)
    base = server.stdout.readline().strip()
    try:
        browsers = {name: opened(base, name, password)
                    for name in ("trainee", "mentor", "director", "researcher", "admin")}
        mentor = browsers["mentor"]
        learner = first_link(mentor, base, "/progress?standing=under_way", r'href="(/progress/[0-9a-f-]{36})"')
        attempt = first_link(mentor, base, learner, r'href="(/attempts/[0-9a-f-]{36})"')
        for name, who, path, sizes in (
                ("learners", "director", "/progress", (WIDE, NARROW)),
                ("learner", "mentor", learner, (WIDE, NARROW)),
                ("record", "director", learner + "/record", (WIDE,)),
                ("attempt", "mentor", attempt, (WIDE, NARROW)),
                ("pictures", "mentor", attempt + "/pictures", (WIDE,)),
                ("progress", "trainee", "/progress", (WIDE,)),
                ("start-trainee", "trainee", "/", (WIDE, NARROW)),
                ("start-mentor", "mentor", "/", (WIDE, NARROW)),
                ("start-director", "director", "/", (WIDE,)),
                ("start-admin", "admin", "/", (WIDE,)),
                ("attempts", "mentor", "/attempts", (WIDE,)),
                ("curriculum", "director", "/curricula", (WIDE,)),
                ("cases", "mentor", "/cases", (WIDE,)),
                ("cohorts", "director", "/cohorts", (WIDE,)),
                ("stations", "director", "/stations", (WIDE,)),
                ("stations-timing", "admin", "/stations/timing", (WIDE,)),
                ("jobs", "mentor", "/jobs", (WIDE,)),
                ("researcher", "researcher", "/attempts", (WIDE,)),
                ("accounts", "admin", "/accounts", (WIDE,)),
                ("audit", "admin", "/audit", (WIDE,)),
                ("me", "trainee", "/me", (WIDE,))):
            for size in sizes:
                draw(browsers[who], base, path, "%s/%s%s.png" % (out, name, "" if size == WIDE else "-narrow"), size)
    finally:
        server.terminate()
        server.wait()


main()
