"""Clients that break rules, stall or vanish, as actions of the soak test: each takes a Connection and a Random.

An action checks the refusal where the protocol asks for one. The clients beside it show that the service stays well.
"""
import json
import socket
import struct
import time

from lib.soak_client import check

BODY = 8 << 20         # bytes that a body may have (max_body_bytes)
HEAD = 16 << 10        # bytes that a head may have (max_head_bytes)
KEYS = 300_000         # keys that a document may have (max_json_keys)
LONGEST = 30           # s until a refusal must be there


class RawClient:
    """A socket that sends what it is given, whether it is HTTP or not."""

    def __init__(self, connection):
        self.connection = connection
        self.socket = socket.create_connection(("127.0.0.1", connection.port), timeout=LONGEST)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.socket.close()

    def send(self, data):
        self.connection.last = repr(data[:300])
        try:
            self.socket.sendall(data)
        except OSError:  # the service has refused and closed before all was sent
            pass

    def status(self):
        """The status of the answer; 0 when the service closed the connection without one."""
        try:
            line = self.socket.recv(4096).split(b"\r\n")[0]
        except ConnectionResetError:
            line = b""
        return int(line.split()[1]) if line.startswith(b"HTTP/1.") else 0

    def reset(self):
        """Ends the connection by RST, as a machine that vanishes behind a gateway."""
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        self.socket.close()


def head(length, path="/v1/jobs", extra=b""):
    return (f"POST {path} HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: application/json\r\n"
            f"Content-Length: {length}\r\n").encode() + extra + b"\r\n"


def refused(client, data, *statuses):
    client.send(data)
    status = client.status()
    check(status in statuses, f"status {status}, expected one of {statuses}")


class HostileActions:
    """The actions; `catalogue` has right requests and sweeps, which are cut, repeated or not read."""

    def __init__(self, catalogue):
        self.catalogue = catalogue

    def weights(self):
        """How often which action is taken, on the scale of Actions.weights()."""
        return {self.send_noise: 2, self.contradict_lengths: 2, self.exceed_sizes: 2, self.send_slowly: 2,
                self.vanish_within_a_body: 2, self.do_not_read: 2, self.exceed_keys: 0.2, self.nest_deeply: 0.5}

    def send_noise(self, connection, draw):
        """Random bytes are no request: the connection ends, with or without 400."""
        with RawClient(connection) as client:
            refused(client, draw.randbytes(draw.randint(1, 2000)) + b"\r\n\r\n", 0, 400, 501)

    def contradict_lengths(self, connection, draw):
        wrong = draw.choice([b"Content-Length: 7\r\n", b"Transfer-Encoding: chunked\r\n", b"Host: elsewhere\r\n",
                             b"Transfer-Encoding: gzip\r\n", b" folded: yes\r\n", b"X-Bell: \a\r\n"])
        with RawClient(connection) as client:
            refused(client, head(2, extra=wrong) + b"{}", 400, 501)

    def exceed_sizes(self, connection, draw):
        data, status = draw.choice([
            (head(BODY + 1), 413), (head(10 ** 30), 413), (head(2, path="/v1/jobs?" + "a" * HEAD), 414),
            (head(2, extra=b"X-Long: " + b"a" * HEAD + b"\r\n"), 431)])
        with RawClient(connection) as client:
            refused(client, data, status, 400, 431)

    def send_slowly(self, connection, draw):
        """A right request comes in pieces over some seconds, and is answered in spite of that."""
        request, _ = draw.choice(self.catalogue.jobs)
        body = json.dumps(request).encode()
        data = head(len(body), path="/v1/check") + body
        with RawClient(connection) as client:
            for begin in range(0, len(data), 1 + len(data) // 20):
                client.send(data[begin:begin + 1 + len(data) // 20])
                time.sleep(draw.uniform(0, 0.2))
            check(client.status() == 200, "a slow client has no answer")

    def vanish_within_a_body(self, connection, draw):
        request, _ = draw.choice(self.catalogue.jobs)
        body = json.dumps(request).encode()
        with RawClient(connection) as client:
            client.send(head(len(body)) + body[:draw.randrange(len(body))])
            time.sleep(draw.uniform(0, 1))
            client.reset()

    def do_not_read(self, connection, draw):
        """A job whose answer nobody reads, or a stream of events that ends unread."""
        request, _ = draw.choice([self.catalogue.slow, *self.catalogue.jobs])
        body = json.dumps(request).encode()
        with RawClient(connection) as client:
            client.send(head(len(body), extra=b"Cache-Control: no-cache\r\n") + body)
            time.sleep(draw.uniform(0, 3))
            client.reset()

    def exceed_keys(self, connection, draw):
        keys = ",".join(f'"{number}":0' for number in range(KEYS + draw.randint(1, 1000)))
        connection.post("/v1/check", f'{{"model":{{{keys}}}}}'.encode(), (400,))

    def nest_deeply(self, connection, draw):
        depth = draw.randint(1000, 1_000_000)
        connection.post("/v1/check", draw.choice([b"[", b'{"model":']) * depth, (400, 422, 413))
