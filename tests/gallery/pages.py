#!/usr/bin/env python3
"""Pictures of the dashboard's pages, of the programme that `seldinger demo --programme` makes.

    tests/gallery/pages.py build/release/seldinger LIBRARY docs/gallery/pages

Sets the passwords of the demo's accounts anew, and adds a study of the simulated people, a questionnaire, a workshop
and a round of ratings. Needs Chromium. A page is taken as the server gives it, with its style
sheet, script and pictures, and drawn from a copy, since a browser without a window has no session.
"""
import functools
import http.cookiejar
import http.server
import json
import os
import re
import secrets
import subprocess
import sys
import tempfile
import threading
import time
import urllib.parse
import urllib.request

WIDE, NARROW = (1280, 1100), (390, 1500)
BOTH = (WIDE, NARROW)
STUDY = "Needles"
WORKSHOP_STUDY = "Needles, people"


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
                        "--run-all-compositor-stages-before-draw", "--virtual-time-budget=4000",
                        "--screenshot=" + out, "--window-size=%d,%d" % size,
                        "http://127.0.0.1:%d/shown.html" % server.server_port],
                       check=True, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        server.shutdown()


class Commands:
    """The program's commands on a library."""

    def __init__(self, program, library):
        self.program, self.library = program, library

    def done(self, *words, typed=None):
        subprocess.run([self.program, *words, "--library", self.library], input=typed, check=True,
                       stdout=subprocess.DEVNULL)

    def said(self, *words):
        return subprocess.run([self.program, *words, "--library", self.library], check=True, text=True,
                              stdout=subprocess.PIPE).stdout

    def ask(self, *words):
        return json.loads(self.said(*words, "--json"))


def begin_study(commands, scratch, title):
    """A study that asks for consent; whether it is new."""
    if any(one["title"] == title for one in commands.ask("study", "list")["studies"]):
        return False
    text_file = scratch + "/consent.txt"
    with open(text_file, "w") as text:
        text.write("May your attempts be used, without your name, to find out what this training teaches?\n")
    commands.done("study", "new", title)
    commands.done("consent", "text", text_file, "--study", title)
    return True


def add_study(commands, scratch):
    """A study of the simulated people, with a plan that is frozen."""
    if not begin_study(commands, scratch, STUDY):
        return
    plan_file = scratch + "/plan.json"
    commands.done("study", "researcher", STUDY, "--user", "researcher")
    commands.done("study", "template", "--case", "Drill 1", "--out", plan_file)
    with open(plan_file) as file:
        plan = json.loads(file.read().replace("REPLACE: ", ""))  # as if it were filled in
    plan["people"] = "simulated"
    with open(plan_file, "w") as file:
        json.dump(plan, file)
    commands.done("study", "plan", STUDY, plan_file)
    commands.done("study", "freeze", STUDY)
    commands.done("study", "enrol", STUDY, "--all")
    commands.done("study", "look", STUDY)


def add_day(commands, scratch, attempt):
    """A questionnaire, a workshop's board and a round of ratings; their codes, and a rater's key."""
    forms = {}
    for form in ("workshop-2007", "osats-grs"):
        forms[form] = "%s/%s.json" % (scratch, form)
        subprocess.run([commands.program, "questionnaire", "template", form, "--out", forms[form]], check=True,
                       stdout=subprocess.DEVNULL)
        if not any(one["form"] == form for one in commands.ask("questionnaire", "list")["questionnaires"]):
            commands.done("questionnaire", "add", forms[form])
    asked = commands.ask("questionnaire", "open", "workshop-2007", "--title", "Study day", "--group", "trainee",
                         "--group", "expert")["code"]
    begin_study(commands, scratch, WORKSHOP_STUDY)  # real people come to a workshop
    board = commands.ask("workshop", "open", WORKSHOP_STUDY, "--title", "Autumn workshop", "--case", "Drill 1", "--case",
                         "Drill 2", "--station", "Talk")["code"]
    commands.done("workshop", "admit", board, "--user", "trainee", "--consent")
    rated = commands.ask("rating", "open", "osats-grs", "--title", "Spring replays", "--attempt", attempt)
    return asked, board, rated["keys"][0]["key"]


def post(browser, base, page, action, fields):
    token = re.search(r'name="token" value="([^"]+)"', browser.open(base + page).read().decode()).group(1)
    sent = urllib.parse.urlencode({"token": token, **fields}).encode()
    return browser.open(urllib.request.Request(base + action, sent, {"Origin": base})).geturl()[len(base):]


def report_of(browser, base, study):
    """The page of a job that makes the study's report, once it has ended."""
    page = post(browser, base, study, "/jobs", {"kind": "study_report", "study": study.rsplit("/", 1)[1]})
    for _ in range(600):
        state = json.load(browser.open(base + page + "/job.json"))["state"]
        if state not in ("waiting", "running"):
            return page
        time.sleep(0.2)
    raise SystemExit("the report's job has not ended: " + state)


def main():
    program, library, out = (os.path.abspath(argument) for argument in sys.argv[1:4])
    os.makedirs(out, exist_ok=True)
    commands = Commands(program, library)
    password = secrets.token_urlsafe(18)
    roles = ("trainee", "mentor", "director", "researcher", "admin")
    for name in roles:
        commands.done("user", "passwd", name, typed=password.encode())
    with tempfile.TemporaryDirectory() as scratch:
        add_study(commands, scratch)
        attempts = commands.ask("attempt", "list")["attempts"]
        asked, board, key = add_day(commands, scratch, attempts[0]["attempt_id"])
    invited = commands.said("user", "invite", "newcomer-" + secrets.token_hex(3), "--role", "trainee")
    server = subprocess.Popen([program, "serve", "--library", library, "--port", "0"], stdout=subprocess.PIPE, text=True,
                              stderr=subprocess.DEVNULL)
    base = server.stdout.readline().strip()
    try:
        browsers = {name: opened(base, name, password) for name in roles}
        for name in ("nobody", "respondent", "rater"):
            browsers[name] = urllib.request.build_opener(
                urllib.request.HTTPCookieProcessor(http.cookiejar.CookieJar()))
        mentor, researcher = browsers["mentor"], browsers["researcher"]
        learner = first_link(mentor, base, "/progress?standing=under_way", r'href="(/progress/[0-9a-f-]{36})"')
        attempt = first_link(mentor, base, learner, r'href="(/attempts/[0-9a-f-]{36})"')
        case = first_link(mentor, base, "/cases", r'href="(/cases/[0-9a-f-]{36})"')
        study = first_link(researcher, base, "/studies", r'href="(/studies/[0-9a-f-]{36})"')
        job = report_of(researcher, base, study)
        answering = post(browsers["respondent"], base, "/answer?code=" + asked, "/answer",
                         {"code": asked, "group": "trainee", "begin": "yes"})
        post(browsers["rater"], base, "/rate", "/rate", {"key": key})
        for name, who, path, sizes in (
                ("log-in", "nobody", "/login", BOTH),
                ("password", "nobody", "/password?link=" + invited.strip().rsplit("=", 1)[1], (WIDE,)),
                ("start-trainee", "trainee", "/", BOTH),
                ("start-mentor", "mentor", "/", BOTH),
                ("start-director", "director", "/", BOTH),
                ("start-researcher", "researcher", "/", BOTH),
                ("start-admin", "admin", "/", (WIDE,)),
                ("learners", "director", "/progress", BOTH),
                ("learner", "mentor", learner, BOTH),
                ("record", "director", learner + "/record", (WIDE,)),
                ("attempt", "mentor", attempt, BOTH),
                ("pictures", "mentor", attempt + "/pictures", (WIDE,)),
                ("progress", "trainee", "/progress", BOTH),
                ("attempts", "mentor", "/attempts", BOTH),
                ("metrics", "mentor", "/metrics", (WIDE,)),
                ("curriculum", "director", "/curricula", (WIDE,)),
                ("cases", "mentor", "/cases", BOTH),
                ("case", "mentor", case, BOTH),
                ("cohorts", "director", "/cohorts", (WIDE,)),
                ("stations", "director", "/stations", BOTH),
                ("stations-timing", "admin", "/stations/timing", (WIDE,)),
                ("jobs", "mentor", "/jobs", BOTH),
                ("job", "researcher", job, BOTH),
                ("researcher", "researcher", "/attempts", (WIDE,)),
                ("studies", "researcher", "/studies", (WIDE,)),
                ("study", "researcher", study, BOTH),
                ("answer", "respondent", answering, BOTH),
                ("board", "nobody", "/board?code=" + board, (WIDE,)),
                ("rate", "rater", "/rate/bench", (WIDE,)),
                ("rating", "rater", "/rate/replay?n=1", BOTH),
                ("accounts", "admin", "/accounts", (WIDE,)),
                ("audit", "admin", "/audit", (WIDE,)),
                ("log-ins", "admin", "/log-ins", (WIDE,)),
                ("me", "trainee", "/me", BOTH)):
            for size in sizes:
                draw(browsers[who], base, path, "%s/%s%s.png" % (out, name, "" if size == WIDE else "-narrow"), size)
    finally:
        server.terminate()
        server.wait()


main()
