"""The C interface from Python's ctypes, without any package: prints the critical load of a request file.

  python3 critical_load.py LIBRARY REQUEST.json        such as build/release/libsnapthrough.so examples/buried_pipe.json

clients/python has a package that does this and more.
"""
import ctypes
import json
import sys


class Document(ctypes.Structure):
    """snapthrough_document."""

    _fields_ = [("text", ctypes.c_void_p), ("length", ctypes.c_size_t), ("status", ctypes.c_int)]


library = ctypes.CDLL(sys.argv[1])
library.snapthrough_solve.restype = ctypes.POINTER(Document)
library.snapthrough_solve.argtypes = [ctypes.c_char_p, ctypes.c_size_t] + 3 * [ctypes.c_void_p]
library.snapthrough_free.argtypes = [ctypes.POINTER(Document)]
library.snapthrough_free.restype = None

with open(sys.argv[2], "rb") as file:
    request = file.read()
document = library.snapthrough_solve(request, len(request), None, None, None)
text, status = ctypes.string_at(document.contents.text, document.contents.length), document.contents.status
library.snapthrough_free(document)

if status != 0:
    sys.exit(text.decode())
summary = json.loads(text)["summary"]
print(summary["critical_load_factor"], summary["critical_type"])
