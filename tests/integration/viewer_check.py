"""viewer_check.py PROGRAM: `placegraph view` and `run --view`, asked over sockets.

Renders a drive, runs it, and checks what the server answers, that it refuses what is not its own
page's, that loops can be edited, and that a run can be followed, paused and stepped.
"""
import http.client
import json
import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
import time

PROGRAM = os.path.abspath(sys.argv[1])
ADDRESS = re.compile(r"http://127\.0\.0\.1:(\d+)/([0-9a-f]{32})/")


class Server:
    """A process of the program that serves a page, with its port and token."""

    def __init__(self, arguments, folder, stream):
        self.process = subprocess.Popen([PROGRAM, *arguments], cwd=folder, text=True,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        for line in getattr(self.process, stream):
            found = ADDRESS.search(line)
            if found:
                self.port, self.token = int(found.group(1)), found.group(2)
                return
        raise SystemExit(f"{arguments}: no address: {self.process.stderr.read()}")

    def ask(self, path, method="GET", body=None, headers=None):
        """Status, header fields and content of the answer."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        connection.request(method, f"/{self.token}/{path}", body, headers or {})
        answer = connection.getresponse()
        return answer.status, answer.headers, answer.read()

    def post(self, path, content):
        status, _, body = self.ask(path, "POST", json.dumps(content), {
            "Content-Type": "application/json", "Origin": f"http://127.0.0.1:{self.port}"})
        return status, body

    def raw(self, request):
        """First line of the answer to these bytes; empty if the server only closes."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=20) as connection:
            try:
                connection.sendall(request)
                connection.shutdown(socket.SHUT_WR)
                return connection.recv(4096).split(b"\r\n")[0].decode("latin-1")
            except (ConnectionResetError, BrokenPipeError):
                return ""

    def end(self):
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(30)


def check(condition, text):
    if not condition:
        raise SystemExit("viewer_check: " + text)


def request(method, target, headers, body=b""):
    lines = [f"{method} {target} HTTP/1.1"] + [f"{name}: {value}" for name, value in headers]
    if body:
        lines.append(f"Content-Length: {len(body)}")
    return "\r\n".join(lines).encode("latin-1") + b"\r\n\r\n" + body


def requests_to_refuse(server):
    """More than 200 requests that must not be answered."""
    own = ("Host", f"127.0.0.1:{server.port}")
    root = f"/{server.token}/"
    paths = ["", "report.json", "edits.json", "edits", "runs/0/frames/0/image.jpg",
             "runs/0/frames/0/observations.json"]
    requests = []
    for path in paths:
        for host in ("evil.example", f"evil.example:{server.port}", "127.0.0.1", "", "[::1]",
                     "127.0.0.1:1", f"127.0.0.1:{server.port}.evil.example", "0.0.0.0"):
            requests.append(request("GET", root + path, [("Host", host)]))
        for wrong in ("/" + path, f"/{'0' * 32}/{path}", f"/{server.token[:-1]}/{path}",
                      f"/{server.token.upper()[::-1]}/{path}", f"//{path}", f"/x{root}{path}"):
            requests.append(request("GET", wrong, [own]))
        for origin in ("http://evil.example", "null", f"https://127.0.0.1:{server.port}"):
            requests.append(request("POST", root + path, [
                own, ("Origin", origin), ("Content-Type", "application/json")], b"{}"))
        for method in ("PUT", "DELETE", "OPTIONS", "PATCH", "TRACE", "HEAD", "CONNECT"):
            requests.append(request(method, root + path, [own]))
        requests.append(request("GET", root + path, [own, ("Sec-Fetch-Site", "cross-site")]))
        requests.append(request("POST", root + path, [own, ("Content-Type", "text/plain")], b"x"))
        requests.append(request("GET", root + path, []))
    for path in ("..", "../", "../../etc/passwd", "runs/../../../etc/passwd", "%2e%2e/etc/passwd",
                 "..%2fetc%2fpasswd", "%252e%252e/x", "..;/x", "runs/0/frames/..%5c..%5cx/image.jpg",
                 "/etc/passwd", "file:///etc/passwd", "runs/0/frames/-1/image.jpg",
                 "runs/0/frames/99999999999999999999/image.jpg", "runs/9/frames/0/image.jpg",
                 "runs/0/frames/1e3/image.jpg", "runs/0/frames/0/other.jpg", "map.db", "../map.db",
                 "report.json?x=1", "report.json#x", "report%00.json", "report.json%0d%0aX: y",
                 "a" * 600, "a" * 20000, "%" * 100, "~root", "con", "edits/", "control", "events",
                 "live/state.json", "\xff\xfe", "runs//0/frames/0/image.jpg", "RUNS/0", "./."):
        requests.append(request("GET", root + path, [own]))
    requests += [b"\r\n\r\n", b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n", b"\x00" * 64, b"\x16\x03\x01",
                 b"GET " + root.encode() + b"\r\n\r\n", b"A" * 100000, b"GET / HTTP/1.1\r\n" + b"x" * 9000,
                 request("POST", root + "edits", [own, ("Content-Type", "application/json"),
                                                  ("Content-Length", "99999999999")]),
                 request("POST", root + "edits", [own, ("Content-Type", "application/json")], b"x" * 200000),
                 request("GET", root, [own, ("X", "y" * 10000)])]
    for body in (b"", b"{", b"[]", b"null", b'"x"', b'{"action":7}', b'{"action":"drop"}',
                 b'{"action":"refuse"}', b'{"action":"refuse","query_frame":-1,"match_frame":0}',
                 b'{"action":"refuse","query_frame":"1","match_frame":0}',
                 b'{"action":"refuse","query_frame":1e99,"match_frame":0}',
                 b'{"action":"save","name":"../x"}', b'{"action":"save","name":""}',
                 b'{"action":"save","name":"a/b"}', b'{"action":"save","name":"a.db"}',
                 b'{"action":"undo"}', b'{"action":"add","query_frame":1,"match_frame":1}',
                 b"[" * 10000):
        requests.append(request("POST", root + "edits", [
            own, ("Content-Type", "application/json"),
            ("Origin", f"http://127.0.0.1:{server.port}")], body))
    return requests


def check_page(server):
    status, headers, page = server.ask("")
    policy = headers["Content-Security-Policy"]
    nonce = re.search(r"'nonce-([0-9a-f]{32})'", policy).group(1)
    check(status == 200 and b"placegraph-live" in page, "the page is not served")
    check(f'nonce="{nonce}"'.encode() in page, "the scripts of the page do not carry the nonce")
    check(b"placegraph-nonce" not in page and b"http-equiv" not in page, "the page has another policy")
    check(server.ask("")[1]["Content-Security-Policy"] != policy, "the nonce is used again")
    for name in ("X-Content-Type-Options", "Referrer-Policy", "Cache-Control"):
        check(name in headers, f"no header {name}")


def check_view(folder):
    before = sorted(os.listdir(os.path.join(folder, "out")))
    server = Server(["view", "out"], folder, "stdout")
    check_page(server)
    report = json.loads(server.ask("report.json")[2])
    check(report["format"] == "placegraph-report-1" and len(report["runs"]) == 1, "no report")
    status, headers, image = server.ask("runs/0/frames/3/image.jpg")
    check(status == 200 and headers["Content-Type"] == "image/jpeg" and image[:2] == b"\xff\xd8",
          "no image")
    status, _, seen = server.ask("runs/0/frames/0/observations.json")
    check(status == 200 and json.loads(seen)["points"]["width"] == 3, "no observations")

    requests = requests_to_refuse(server)
    check(len(requests) >= 200, f"only {len(requests)} requests")
    for number, sent in enumerate(requests):
        answer = server.raw(sent)
        check(answer == "" or answer.split(" ")[1].startswith(("4", "5")), f"request {number} was answered: {sent[:200]} -> {answer}")
    print(f"{len(requests)} requests refused")
    check(sorted(os.listdir(os.path.join(folder, "out"))) == before, "a file was written")
    check(server.ask("report.json")[0] == 200, "the server no longer answers")
    check_slow(server)

    status, answer = server.post("edits", {"action": "add", "query_frame": 30, "match_frame": 0})
    check(status in (200, 409), f"no answer to an edit: {status} {answer}")
    status, answer = server.post("edits", {"action": "optimize"})
    check(status == 200 and json.loads(answer)["optimized"], f"not optimized: {answer}")
    status, answer = server.post("edits", {"action": "save", "name": "mended"})
    check(status == 200 and not json.loads(answer)["unsaved"], f"not saved: {answer}")
    check(server.post("edits", {"action": "save", "name": "mended"})[0] == 409, "overwritten")
    check(server.end() == 0, "the viewer does not end well")
    check(subprocess.run([PROGRAM, "map", "validate", "out/mended.db"], cwd=folder,
                         stdout=subprocess.DEVNULL).returncode == 0, "the saved map is damaged")


def events_of(server):
    """Yields (name, data) of the events of a run."""
    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=120)
    connection.request("GET", f"/{server.token}/events")
    answer = connection.getresponse()
    name = ""
    while True:
        line = answer.readline().decode()
        if not line:
            return
        if line.startswith("event: "):
            name = line[7:].strip()
        elif line.startswith("data: "):
            yield name, json.loads(line[6:])


def frames_done(server):
    """Number of frames of a halted run: that of a frame that was begun counts when it is done."""
    before = -1
    while True:
        done = json.loads(server.ask("live/state.json")[2])["done"]
        if done == before:
            return done
        before = done
        time.sleep(0.5)


def check_slow(server):
    """Connections that never complete a request do not keep others from an answer for long."""
    slow = []
    for _ in range(50):
        connection = socket.create_connection(("127.0.0.1", server.port), timeout=20)
        connection.sendall(b"GET / HTTP/1.1\r\nX: ")
        slow.append(connection)
    check(server.ask("edits.json")[0] == 200, "slow requests silence the server")
    for connection in slow:
        connection.close()


def check_live(folder):
    server = Server(["run", "drive", "--out", "live", "--view"], folder, "stderr")
    check(server.post("control", {"action": "pause"})[0] == 200, "not paused")
    check(server.post("control", {"action": "drop"})[0] == 400, "an unknown control is taken")
    done = frames_done(server)
    time.sleep(1)
    check(frames_done(server) == done, "the run goes on although it is halted")
    check(server.post("control", {"action": "step"})[0] == 200, "no step")
    for _ in range(100):
        time.sleep(0.05)
        if frames_done(server) > done:
            break
    time.sleep(0.5)
    check(frames_done(server) == done + 1, "a step is not one frame")
    frames, stages, verdict = [], 0, None
    events = events_of(server)
    check(server.post("control", {"action": "resume"})[0] == 200, "not resumed")
    for name, data in events:
        if name == "frame":
            frames.append(data)
            if len(frames) == 10:
                image = json.loads(server.ask("live/image.json")[2])
                check(image["image"].startswith("data:image/jpeg;base64,"), "no live image")
                check(server.ask("report.json")[0] == 404, "a report of a run that goes on")
        elif name == "stages":
            stages += 1
        elif name == "done":
            verdict = data["verdict"]
            break
    state = json.loads(server.ask("live/state.json")[2])
    check(state["done"] == state["total"] == 40 and state["finished"], f"not all frames: {state['done']}")
    check(len(frames) >= 40 - done - 2 and frames[-1]["index"] == 39, f"{len(frames)} events of frames")
    check(stages > 0 and verdict in ("good", "doubtful", "failed"), f"{stages} {verdict}")
    report = json.loads(server.ask("report.json")[2])
    check(report["runs"][0]["summary"]["frames"] == 40, "no report after the run")
    events.close()
    check(server.end() == 0, "the run does not end well")


def check_same_results(folder):
    """A run that nobody looks at ends by itself, with the same results."""
    subprocess.run([PROGRAM, "run", "drive", "--out", "unseen", "--view", "--quiet"], cwd=folder,
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=300)
    for run in ("live", "unseen"):
        with open(os.path.join(folder, run, "trajectory_optimized.tum")) as watched, \
                open(os.path.join(folder, "out", "trajectory_optimized.tum")) as alone:
            check(watched.read() == alone.read(), f"{run}: another trajectory than without --view")


with tempfile.TemporaryDirectory() as folder:
    for arguments in (["synth", "sequence", "town-loop", "--frames", "40", "--size", "320x240",
                       "--stereo", "--out", "drive"], ["run", "drive", "--out", "out"]):
        subprocess.run([PROGRAM, *arguments], cwd=folder, check=True, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)
    check_view(folder)
    check_live(folder)
    check_same_results(folder)
