#!/usr/bin/env python3
"""What the package adds to a call of the library and to a request to the service, measured side by side in one run.

  bench_overhead.py BUILD_FOLDER [CALLS]

A call of the package and the bare one take turns, so that a busy machine slows both; lower quartiles of CALLS (default
400) are compared, since what else runs on the machine only ever adds time. The bare call is the C function through ctypes, its document left unread; the bare request is
http.client with the same body on a kept connection. Ctrl-C is pressed ten times each; a table of 20 000 rows becomes a
data frame where pandas is there.
"""
import http.client
import itertools
import json
import os
import pathlib
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time

HERE = pathlib.Path(__file__).resolve().parent
SHARED = HERE.parent.parent / "tests" / "clients"
sys.path.insert(0, str(HERE))

import snapthrough  # noqa: E402
from snapthrough._library import Library  # noqa: E402


def milliseconds(function):
    """Time of one call."""
    start = time.perf_counter()
    function()
    return 1e3 * (time.perf_counter() - start)


def compare(name, bare, ours, calls):
    """A line of the table: lower quartiles and their difference."""
    pairs = []
    for number in range(calls + 10):
        pairs.append((milliseconds(bare), milliseconds(ours)) if number % 2 else
                     tuple(reversed((milliseconds(ours), milliseconds(bare)))))
    bare_ms, our_ms = (statistics.quantiles(times, n=4)[0] for times in zip(*pairs[10:]))
    print(f"| {name} | {bare_ms:.3f} | {our_ms:.3f} | {our_ms - bare_ms:+.3f} | {our_ms / bare_ms:.2f} |")


def in_process(library_path, calls):
    """Local.solve beside snapthrough_solve."""
    local, library = snapthrough.Local(library_path), Library(library_path)
    for name in ("not_held", "buckling", "arch"):
        request = (SHARED / "requests" / f"{name}.json").read_bytes()

        def ours(request=request):
            try:
                local.solve(request)
            except snapthrough.AnalysisFailed:
                pass

        size = len(library.solve(request).text)
        compare(f"in process, {name}.json, {size / 1000:.0f} kB", lambda request=request: library.solve(request), ours,
                calls)
    request = (SHARED / "requests" / "arch.json").read_bytes()
    compare("in process, arch.json, with its attributes read", lambda: library.solve(request),
            lambda: local.solve(request).summary.critical_load_factor, calls)


def by_service(client, port, calls):
    """Client.solve beside a bare request, for results that the service knows and for requests that it does not."""
    connection = http.client.HTTPConnection("127.0.0.1", port)

    def bare(request):
        connection.request("POST", "/v1/jobs", request, {"Content-Type": "application/json"})
        connection.getresponse().read()

    for name in ("buckling", "arch"):
        request = (SHARED / "requests" / f"{name}.json").read_bytes()
        compare(f"HTTP, {name}.json, known", lambda request=request: bare(request),
                lambda request=request: client.solve(request), calls)
        titles = (json.dumps({**json.loads(request), "model": {**json.loads(request)["model"], "title": str(number)}})
                  .encode("utf-8") for number in itertools.count())
        compare(f"HTTP, {name}.json, new each time", lambda titles=titles: bare(next(titles)),
                lambda titles=titles: client.solve(next(titles)), calls)
    connection.close()


def interruption(name, call):
    """Seconds between Ctrl-C and the exception."""
    found = []
    for _ in range(10):
        pressed = []

        def press(pressed=pressed):
            pressed.append(time.perf_counter())
            os.kill(os.getpid(), signal.SIGINT)

        threading.Timer(0.4, press).start()
        try:
            call()
        except KeyboardInterrupt:
            found.append(1e3 * (time.perf_counter() - pressed[0]))
    print(f"| Ctrl-C, {name} | {statistics.median(found):.1f} | {max(found):.1f} |")


def frames(library_path):
    """A table of 20 000 rows as a data frame."""
    try:
        import pandas  # noqa: F401
    except ImportError:
        return
    table = snapthrough.Local(library_path).sweep((SHARED / "sweep_500.json").read_text()).table()
    large = snapthrough.Table(table.columns, 20000)
    for index in range(20000):
        large.append(index, table.rows[index % 500], table.text_of(index % 500))
    print(f"| 20 000 rows of {len(table.columns)} columns to a data frame | {milliseconds(large.to_pandas):.0f} |")
    print(f"| the same to CSV | {milliseconds(large.to_csv):.0f} |")
    text = large.to_json().encode("utf-8")
    print(f"| the same from JSON with its digits kept | "
          f"{milliseconds(lambda: snapthrough._spans.parts_of_table(text.decode('utf-8'))):.0f} |")


def start_service(executable, folder):
    """The service's process and its port."""
    process = subprocess.Popen([executable, "serve", "--listen", "127.0.0.1:0", "--store", folder + "/store.db"],
                               stderr=subprocess.PIPE, text=True, start_new_session=True)
    for line in process.stderr:
        event = json.loads(line)
        if event.get("event") == "listening":
            threading.Thread(target=lambda: [None for _ in process.stderr], daemon=True).start()
            return process, event["port"]
    raise SystemExit("the service did not start")


def main(build, calls=400):
    folder = pathlib.Path(build).resolve()
    library = str(folder / "libsnapthrough.so.1")
    print("| ms, lower quartiles | bare | package | difference | ratio |\n| --- | --- | --- | --- | --- |")
    in_process(library, calls)
    with tempfile.TemporaryDirectory() as store:
        process, port = start_service(str(folder / "snapthrough"), store)
        client, local = snapthrough.Client(f"http://127.0.0.1:{port}"), snapthrough.Local(library)
        by_service(client, port, calls)
        long = (SHARED / "requests" / "cancelled.json").read_bytes()
        print("\n| ms | median | largest of 10 |\n| --- | --- | --- |")
        interruption("in process", lambda: local.solve(long))
        interruption("in process, with a callback", lambda: local.solve(long, on_progress=lambda progress: None))
        interruption("HTTP", lambda: client.solve(long))
        interruption("HTTP, with a callback", lambda: client.solve(long, on_progress=lambda progress: None))
        process.terminate()
        process.wait()
        process.stderr.close()
    print("\n| | ms |\n| --- | --- |")
    frames(library)


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        raise SystemExit(__doc__)
    main(sys.argv[1], *map(int, sys.argv[2:]))
