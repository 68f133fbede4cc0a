"""A workbook in LibreOffice without a window: cells are set, everything is computed anew, cells are read.

Run by Debian's python3, which has the module uno:  office.py WORKBOOK PICTURE.pdf < steps.json > answers.json
Steps are ["set", sheet, cell, value], ["recalculate"] or ["get", sheet, range]; the answers are those of the last kind, in order.
"""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

import uno
from com.sun.star.beans import PropertyValue
from com.sun.star.connection import NoConnectException

FULL_UPDATE = 3  # com.sun.star.document.UpdateDocMode: links are loaded
SECONDS = 240


def option(name, value):
    """A named value, as LibreOffice takes them."""
    one = PropertyValue()
    one.Name, one.Value = name, value
    return one


def desktop(pipe):
    """Waits for the program that listens on the pipe."""
    context = uno.getComponentContext()
    resolver = context.ServiceManager.createInstanceWithContext("com.sun.star.bridge.UnoUrlResolver", context)
    end = time.monotonic() + SECONDS
    while True:
        try:
            remote = resolver.resolve(f"uno:pipe,name={pipe};urp;StarOffice.ComponentContext")
            return remote.ServiceManager.createInstanceWithContext("com.sun.star.frame.Desktop", remote)
        except NoConnectException:
            if time.monotonic() > end:
                raise
            time.sleep(0.2)


def run(document, steps):
    """Does the steps."""
    answers = []
    for kind, *rest in steps:
        if kind == "recalculate":
            document.calculateAll()
            continue
        cells = document.Sheets.getByName(rest[0]).getCellRangeByName(rest[1])
        if kind == "get":
            answers.append([[cell for cell in row] for row in cells.getDataArray()])
        elif isinstance(rest[2], str):
            cells.setString(rest[2])
        else:
            cells.setValue(rest[2])
    return answers


# What a user allows by a click: the links of workbooks in this folder are loaded.
TRUST = """<?xml version="1.0" encoding="UTF-8"?>
<oor:items xmlns:oor="http://openoffice.org/2001/registry">
<item oor:path="/org.openoffice.Office.Calc/Content/Update"><prop oor:name="Link" oor:op="fuse"><value>0</value></prop></item>
<item oor:path="/org.openoffice.Office.Common/Security/Scripting"><prop oor:name="SecureURL" oor:op="fuse"><value>
<it>FOLDER</it></value></prop></item>
</oor:items>"""


def main():
    given, picture = (pathlib.Path(name).resolve() for name in sys.argv[1:3])
    steps = json.load(sys.stdin)
    with tempfile.TemporaryDirectory() as profile:
        workbook = pathlib.Path(profile) / "workbook/copy.xlsx"  # LibreOffice locks what it opens
        workbook.parent.mkdir()
        shutil.copy(given, workbook)
        settings = pathlib.Path(profile) / "user/registrymodifications.xcu"
        settings.parent.mkdir()
        settings.write_text(TRUST.replace("FOLDER", workbook.parent.as_uri()), encoding="utf-8")
        pipe = "snapthrough" + pathlib.Path(profile).name
        office = subprocess.Popen(["soffice", "--headless", "--norestore", "--nologo", f"-env:UserInstallation=file://{profile}",
                                   f"--accept=pipe,name={pipe};urp;"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            shell = desktop(pipe)
            document = shell.loadComponentFromURL(workbook.as_uri(), "_blank", 0,
                                                  (option("Hidden", True), option("UpdateDocMode", FULL_UPDATE)))
            json.dump(run(document, steps), sys.stdout)
            document.storeToURL(picture.as_uri(), (option("FilterName", "calc_pdf_Export"),))
            document.close(True)
            shell.terminate()
            office.wait(timeout=SECONDS)
        finally:
            office.kill()


if __name__ == "__main__":
    main()
