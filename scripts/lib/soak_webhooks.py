"""The receiver of the soak test's callbacks, and the account of who has to be told what."""
import base64
import hashlib
import hmac
import http.server
import json
import os
import random
import threading
import time

REFUSED = 0.02       # of the news, once each, with 503: it has to come again
LONGEST_WAIT = 60.0  # s from an end to the news of it


class Account:
    """Ends that a receiver must be told of, and those it was told of."""

    def __init__(self, findings):
        self.findings = findings
        self.lock = threading.Lock()
        self.expected = {}   # id -> (status document, since when)
        self.told = {}       # id -> (status document, since when)
        self.seen = set()    # webhook ids
        self.refused = set()
        self.delivered = 0

    def expect(self, document):
        """The job or sweep of this status document has ended, and its receiver must be told just that."""
        with self.lock:
            self.expected[document["id"]] = (document, time.monotonic())

    def forgive(self, identifier):
        """It was removed: its receiver may be told or not, of whatever end."""
        with self.lock:
            self.expected[identifier] = (None, time.monotonic())

    def take(self, webhook, document):
        """The status that news is answered with; some is refused once, and news that comes twice counts once."""
        with self.lock:
            if random.random() < REFUSED and webhook not in self.refused and webhook not in self.seen:
                self.refused.add(webhook)
                return 503
            if webhook not in self.seen:
                self.seen.add(webhook)
                self.delivered += 1
                self.told[document["id"]] = (document, time.monotonic())
            return 204

    def settle(self):
        """Compares both sides; the number of ends that wait for their news."""
        with self.lock:
            late = time.monotonic() - LONGEST_WAIT
            for identifier in self.expected.keys() & self.told.keys():
                right, told = self.expected.pop(identifier)[0], self.told.pop(identifier)[0]
                if right is not None and right != told:
                    self.findings.add(f"webhook: told {json.dumps(told)}\n  the service shows {json.dumps(right)}")
            for identifier in [key for key, (_, since) in self.expected.items() if since < late]:
                document = self.expected.pop(identifier)[0]
                if document is not None:
                    self.findings.add(f"webhook: no news within {LONGEST_WAIT:.0f} s of {json.dumps(document)}")
            for identifier in [key for key, (_, since) in self.told.items() if since < late - LONGEST_WAIT]:
                self.findings.add(f"webhook: news of what nobody waits for: {json.dumps(self.told.pop(identifier)[0])}")
            return sum(document is not None for document, _ in self.expected.values())


class Receiver(http.server.ThreadingHTTPServer):
    daemon_threads = True

    def __init__(self, findings):
        super().__init__(("127.0.0.1", 0), Handler)
        self.findings = findings
        self.account = Account(findings)
        self.key = os.urandom(32)
        self.host = f"localhost:{self.server_port}"
        self.address = f"http://{self.host}/ended"

    def secret(self):
        return "whsec_" + base64.b64encode(self.key).decode()

    def is_genuine(self, headers, body):
        signed = f"{headers['webhook-id']}.{headers['webhook-timestamp']}.".encode() + body
        mac = base64.b64encode(hmac.new(self.key, signed, hashlib.sha256).digest()).decode()
        fresh = abs(time.time() - int(headers["webhook-timestamp"])) < 300
        return fresh and f"v1,{mac}" in headers["webhook-signature"].split()


class Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    disable_nagle_algorithm = True

    def do_POST(self):
        body = self.rfile.read(int(self.headers["Content-Length"]))
        status = 401
        if self.server.is_genuine(self.headers, body):
            status = self.server.account.take(self.headers["webhook-id"], json.loads(body))
        else:
            self.server.findings.add(f"webhook: signature of {dict(self.headers)} {body[:500]!r}")
        self.send_response(status)
        self.send_header("Content-Length", "0")
        self.end_headers()

    def log_message(self, *_):
        pass
