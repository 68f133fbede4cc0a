#!/usr/bin/env python3
"""Writes snapthrough.xlsx: a buried pipe as inputs, the request that they make, and the answer of the service.

  make_workbook.py [FILE]            default: snapthrough.xlsx beside this program
  make_workbook.py --check           exit status 1 when the file there is not what this program writes

A workbook is a zip archive of XML documents (ECMA-376); this one has no macros. The same program writes the same bytes.
"""
import pathlib
import sys
import xml.sax.saxutils
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
PATH_ROWS = 300
SWEEP_ROWS = 60
SWEEP_COLUMNS = 6
TEXT, INPUT, HEAD, NUMBER, LINE = 0, 1, 2, 3, 4  # styles, in the order of STYLES

# Cells of the sheet Pipe that others refer to.
ADDRESS, DIAMETER, WALL, MODULUS, SOIL, PRESSURE, REQUIRED = "B3", "B6", "B7", "B8", "B9", "B10", "B11"
REQUEST, JOB, SWEEP = "B14", "B17", "B26"

REQUEST_TEXT = """{"model": {"title": "Buried pipe of a workbook", "units": {"length": "m", "force": "kN"},
"nodes": [{"id": "invert", "x": 0, "y": <-B6/2>}, {"id": "crown", "x": 0, "y": <B6/2>}],
"sections": [{"id": "wall", "E": <B8>, "A": <B7>, "I": <B7^3/12>}],
"members": [{"id": "right", "start": "invert", "end": "crown", "section": "wall", "curve": {"type": "arc", "sweep_degrees": 180}},
{"id": "left", "start": "crown", "end": "invert", "section": "wall", "curve": {"type": "arc", "sweep_degrees": 180}}],
"supports": [{"node": "invert", "fixed": ["x"]}],
"foundations": [{"id": "soil right", "member": "right", "stiffness": <B9>, "reaction": "compression_only", "side": "right"},
{"id": "soil left", "member": "left", "stiffness": <B9>, "reaction": "compression_only", "side": "right"}],
"loads": [{"type": "distributed", "member": "right", "force": [0, <-B10>], "per": "horizontal", "range": [0.5, 1]},
{"type": "distributed", "member": "left", "force": [0, <-B10>], "per": "horizontal", "range": [0, 0.5]}],
"monitors": [{"id": "crown", "at": {"node": "crown"}, "component": "y"}]},
"analysis": {"type": "path", "stop": {"monitor": {"id": "crown", "range": [<-0.3*B6>, <0.1*B6>]}},
"output": {"path_points": 60}}}"""


def quoted(text):
    """A text as formulas have it, in pieces of at most 255 characters, which is all that Excel takes."""
    pieces = [text[i:i + 200] for i in range(0, len(text), 200)]
    return "&".join('"' + piece.replace('"', '""') + '"' for piece in pieces)


def request_formula():
    """The request text, with the cells in their places. Where the decimal sign is a comma, it is made a point."""
    parts = []
    for i, piece in enumerate(REQUEST_TEXT.replace("\n", " ").replace(">", "<").split("<")):
        parts.append(f'SUBSTITUTE({piece}&"",",",".")' if i % 2 else quoted(piece))
    return "&".join(parts)


def field(line, number):
    """A field of a line of CSV without quotes, counted from 1; each shorter than 300 characters."""
    return f'TRIM(MID(SUBSTITUTE({line},",",REPT(" ",300)),300*({number}-1)+1,300))'


def column_of(name, header):
    """Which field of a header line has this name: the number of commas before it, with one before the line."""
    before = f'LEFT(","&{header},FIND(",{name},",","&{header}&","))'
    return f'LEN({before})-LEN(SUBSTITUTE({before},",",""))'


def number(text):
    """The number of a text with a decimal point, whatever the decimal sign of the workbook; empty where there is none."""
    return f'IFERROR(_xlfn.NUMBERVALUE({text},"."),"")'


def web(path):
    """What the service answers at a path below its address."""
    return f'_xlfn.WEBSERVICE(Pipe!$B$3&{path})'


class Sheet:
    """Cells by their names, as XML."""

    def __init__(self, widths):
        self.rows = {}
        self.widths = widths

    def put(self, name, value, style=TEXT):
        """A text, a number, or a formula, which begins with "="."""
        column, row = name.rstrip("0123456789"), int(name.lstrip("ABCDEFGHIJKLMNOPQRSTUVWXYZ"))
        if isinstance(value, str) and value.startswith("="):
            body = f"<f>{xml.sax.saxutils.escape(value[1:])}</f>"
            cell = f'<c r="{name}" s="{style}">{body}</c>'
        elif isinstance(value, str):
            body = xml.sax.saxutils.escape(value)
            cell = f'<c r="{name}" s="{style}" t="inlineStr"><is><t xml:space="preserve">{body}</t></is></c>'
        else:
            cell = f'<c r="{name}" s="{style}"><v>{value!r}</v></c>'
        self.rows.setdefault(row, {})[column] = cell

    def xml(self, drawing):
        """The sheet as a document."""
        columns = "".join(f'<col min="{i}" max="{i}" width="{width}" customWidth="1"/>'
                          for i, width in enumerate(self.widths, 1))
        rows = "".join(f'<row r="{row}">' + "".join(cells[column] for column in sorted(cells)) + "</row>"
                       for row, cells in sorted(self.rows.items()))
        drawn = '<drawing r:id="rId1"/>' if drawing else ""
        return (f'{XML}<worksheet xmlns="{MAIN}" xmlns:r="{RELATIONS}"><cols>{columns}</cols><sheetData>{rows}</sheetData>'
                f"{drawn}</worksheet>")


XML = '<?xml version="1.0" encoding="UTF-8" standalone="yes"?>\n'
MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
RELATIONS = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
PACKAGE = "http://schemas.openxmlformats.org/package/2006"
DRAWING = "http://schemas.openxmlformats.org/drawingml/2006"
OFFICE = "application/vnd.openxmlformats-officedocument"


def pipe_sheet():
    """Inputs, request and answer."""
    sheet = Sheet([30, 42, 20, 62])
    sheet.put("A1", "Buried flexible pipe per metre: does it snap through?", HEAD)
    sheet.put("A3", "Service")
    sheet.put(ADDRESS, "http://127.0.0.1:8080", INPUT)
    sheet.put("A5", "Inputs (units: m, kN)", HEAD)
    rows = [(DIAMETER, "diameter", 1, "m"), (WALL, "wall thickness", 0.02, "m"), (MODULUS, "Young's modulus", 800000, "kN/m2"),
            (SOIL, "soil stiffness", 20000, "kN/m3, pushes only"), (PRESSURE, "pressure of the ground above", 10, "kN/m2"),
            (REQUIRED, "factor of safety required", 2, "")]
    for cell, name, value, unit in rows:
        sheet.put("A" + cell[1:], name)
        sheet.put(cell, value, INPUT)
        sheet.put("C" + cell[1:], unit)
    sheet.put("A13", "1. Request", HEAD)
    sheet.put("A14", "JSON, made of the inputs")
    sheet.put(REQUEST, "=" + request_formula(), LINE)
    sheet.put("D14", "Hand it in: Power Query, curl, or the JSON panel of the page (docs/howto/use-in-a-spreadsheet.md).")
    sheet.put("A16", "2. Answer", HEAD)
    sheet.put("A17", "job (its id)")
    sheet.put(JOB, "", INPUT)
    sheet.put("D17", "The answer is read from the job: allow the links of the workbook, and recalculate everything.")
    sheet.put("A18", "critical points of the path")
    sheet.put("B18", f'=IF({JOB}="","",IFERROR(' + web(f'"/v1/jobs/"&{JOB}&"/table.csv?table=critical_points"') + ',"no answer"))', LINE)
    sheet.put("A19", "first of them")
    first = 'IFERROR(FIND(CHAR(10),B18),0)'
    sheet.put("B19", f'=IF({first}=0,"",MID(B18,{first}+1,IFERROR(FIND(CHAR(13),B18,{first}),LEN(B18))-{first}-1))', LINE)
    sheet.put("A20", "critical load factor")
    header = 'LEFT(B18,FIND(CHAR(13),B18)-1)'
    sheet.put("B20", "=" + number(field("B19", column_of("load_factor", header))), NUMBER)
    sheet.put("A21", "kind")
    sheet.put("B21", f'=IFERROR({field("B19", column_of("type", header))},"")')
    sheet.put("A22", "critical pressure (kN/m2)")
    sheet.put("B22", f'=IF(B20="","",B20*{PRESSURE})', NUMBER)
    sheet.put("A23", "verdict")
    sheet.put("B23", f'=IF(B20="","",IF(B20>={REQUIRED},"enough","too little")&": "&TEXT(B20/{REQUIRED},"0.00")&" of what is required")')
    sheet.put("A25", "3. Sweep", HEAD)
    sheet.put("A26", "sweep (its id)")
    sheet.put(SWEEP, "", INPUT)
    sheet.put("D26", "Its table is in the sheet Sweep.")
    return sheet


def line_rows(sheet, source, rows):
    """Cuts a text into lines: column A has where each line of it begins, B the line. Row 3 is the first line."""
    sheet.put("A2", "begins at", HEAD)
    sheet.put("B2", "line", HEAD)
    for row in range(3, 3 + rows):
        begin = "=1" if row == 3 else f'=IFERROR(FIND(CHAR(10),{source},A{row - 1})+1,"")'
        sheet.put(f"A{row}", begin)
        line = f'MID({source},A{row},FIND(CHAR(10),{source},A{row})-A{row})'
        sheet.put(f"B{row}", f'=IF(A{row}="","",IFERROR(SUBSTITUTE({line},CHAR(13),""),""))', LINE)


def path_sheet():
    """The points of the path."""
    sheet = Sheet([12, 30, 16, 18])
    path = f'"/v1/jobs/"&Pipe!${JOB[0]}${JOB[1:]}&"/table.csv?table=points"'
    sheet.put("A1", f'=IF(Pipe!{JOB}="","",IFERROR({web(path)},"no answer"))', LINE)
    line_rows(sheet, "$A$1", PATH_ROWS)
    for column, name in (("C", "crown"), ("D", "load_factor")):
        sheet.put(f"{column}1", "=" + f'IFERROR({column_of(name, "B3")},0)')
    sheet.put("C2", "displacement of the crown (m)", HEAD)
    sheet.put("D2", "load factor", HEAD)
    for row in range(4, 3 + PATH_ROWS):
        for column in "CD":
            text = field(f"$B{row}", f"{column}$1")
            # An empty cell of a chart is no point where it is an error.
            sheet.put(f"{column}{row}", f'=IF($B{row}="",NA(),IFERROR(_xlfn.NUMBERVALUE({text},"."),NA()))', NUMBER)
    return sheet


def sweep_sheet():
    """The table of a sweep."""
    sheet = Sheet([12, 30] + [22] * SWEEP_COLUMNS)
    path = f'"/v1/sweeps/"&Pipe!${SWEEP[0]}${SWEEP[1:]}&"/table.csv"'
    sheet.put("A1", f'=IF(Pipe!{SWEEP}="","",IFERROR({web(path)},"no answer"))', LINE)
    line_rows(sheet, "$A$1", SWEEP_ROWS)
    for row in range(3, 3 + SWEEP_ROWS):
        for i in range(SWEEP_COLUMNS):
            text = field(f"$B{row}", i + 1)
            value = text if row == 3 else f'IFERROR(_xlfn.NUMBERVALUE({text},"."),{text})'
            sheet.put(f"{chr(ord('C') + i)}{row}", f'=IF({text}="","",{value})', HEAD if row == 3 else NUMBER)
    return sheet


def chart():
    """Load factor over displacement, points of the sheet Path."""
    last = 2 + PATH_ROWS

    def values(tag, column):
        return f"<c:{tag}><c:numRef><c:f>Path!${column}$4:${column}${last}</c:f></c:numRef></c:{tag}>"

    def title(text):
        return (f'<c:title><c:tx><c:rich><a:bodyPr/><a:p><a:r><a:rPr lang="en" sz="1000"/><a:t>{text}</a:t></a:r></a:p></c:rich>'
                '</c:tx><c:overlay val="0"/></c:title>')

    def axis(number_, crossing, place, text):
        return (f'<c:valAx><c:axId val="{number_}"/><c:scaling><c:orientation val="minMax"/></c:scaling><c:delete val="0"/>'
                f'<c:axPos val="{place}"/>{title(text)}<c:numFmt formatCode="General" sourceLinked="0"/>'
                f'<c:tickLblPos val="low"/><c:crossAx val="{crossing}"/></c:valAx>')

    return (f'{XML}<c:chartSpace xmlns:c="{DRAWING}/chart" xmlns:a="{DRAWING}/main"><c:chart>'
            '<c:autoTitleDeleted val="1"/><c:plotArea><c:layout/><c:scatterChart><c:scatterStyle val="lineMarker"/>'
            '<c:varyColors val="0"/><c:ser><c:idx val="0"/><c:order val="0"/><c:spPr><a:ln w="19050"><a:solidFill>'
            '<a:srgbClr val="1F4E79"/></a:solidFill></a:ln></c:spPr><c:marker><c:symbol val="none"/></c:marker>'
            + values("xVal", "C") + values("yVal", "D") +
            '<c:smooth val="0"/></c:ser><c:axId val="1"/><c:axId val="2"/></c:scatterChart>'
            + axis(1, 2, "b", "displacement of the crown (m)") + axis(2, 1, "l", "load factor") +
            '</c:plotArea><c:plotVisOnly val="1"/><c:dispBlanksAs val="gap"/></c:chart></c:chartSpace>')


def drawing():
    """Where the chart stands on the sheet Pipe."""
    return (f'{XML}<xdr:wsDr xmlns:xdr="{DRAWING}/spreadsheetDrawing" xmlns:a="{DRAWING}/main"><xdr:twoCellAnchor>'
            "<xdr:from><xdr:col>0</xdr:col><xdr:colOff>0</xdr:colOff><xdr:row>27</xdr:row><xdr:rowOff>0</xdr:rowOff></xdr:from>"
            "<xdr:to><xdr:col>3</xdr:col><xdr:colOff>0</xdr:colOff><xdr:row>50</xdr:row><xdr:rowOff>0</xdr:rowOff></xdr:to>"
            '<xdr:graphicFrame macro=""><xdr:nvGraphicFramePr><xdr:cNvPr id="2" name="Path"/><xdr:cNvGraphicFramePr/>'
            '</xdr:nvGraphicFramePr><xdr:xfrm><a:off x="0" y="0"/><a:ext cx="0" cy="0"/></xdr:xfrm><a:graphic>'
            f'<a:graphicData uri="{DRAWING}/chart"><c:chart xmlns:c="{DRAWING}/chart" xmlns:r="{RELATIONS}" r:id="rId1"/>'
            "</a:graphicData></a:graphic></xdr:graphicFrame><xdr:clientData/></xdr:twoCellAnchor></xdr:wsDr>")


STYLES = (f'{XML}<styleSheet xmlns="{MAIN}"><fonts count="2"><font><sz val="11"/><name val="Calibri"/></font>'
          '<font><b/><sz val="11"/><name val="Calibri"/></font></fonts><fills count="3"><fill><patternFill patternType="none"/>'
          '</fill><fill><patternFill patternType="gray125"/></fill><fill><patternFill patternType="solid">'
          '<fgColor rgb="FFFFF2CC"/></patternFill></fill></fills><borders count="1"><border/></borders>'
          '<cellStyleXfs count="1"><xf/></cellStyleXfs><cellXfs count="5"><xf xfId="0"/>'
          '<xf xfId="0" fillId="2" applyFill="1"/><xf xfId="0" fontId="1" applyFont="1"/><xf xfId="0"/>'
          '<xf xfId="0" applyAlignment="1"><alignment horizontal="fill"/></xf></cellXfs></styleSheet>')


def relations(*targets):
    """A list of relations rId1, rId2, ..., each a kind and a target."""
    rows = "".join(f'<Relationship Id="rId{i}" Type="{RELATIONS}/{kind}" Target="{target}"/>'
                   for i, (kind, target) in enumerate(targets, 1))
    return f'{XML}<Relationships xmlns="{PACKAGE}/relationships">{rows}</Relationships>'


def documents():
    """The documents of the workbook by name."""
    names = ["Pipe", "Path", "Sweep"]
    sheets = [pipe_sheet(), path_sheet(), sweep_sheet()]
    listed = "".join(f'<sheet name="{name}" sheetId="{i}" r:id="rId{i}"/>' for i, name in enumerate(names, 1))
    defined = "".join(f'<definedName name="{name}">Pipe!${cell[0]}${cell[1:]}</definedName>'
                      for name, cell in (("request", REQUEST), ("service", ADDRESS)))
    kinds = [("xl/workbook.xml", f"{OFFICE}.spreadsheetml.sheet.main+xml"), ("xl/styles.xml", f"{OFFICE}.spreadsheetml.styles+xml"),
             ("xl/drawings/drawing1.xml", f"{OFFICE}.drawing+xml"), ("xl/charts/chart1.xml", f"{OFFICE}.drawingml.chart+xml")]
    kinds += [(f"xl/worksheets/sheet{i}.xml", f"{OFFICE}.spreadsheetml.worksheet+xml") for i in (1, 2, 3)]
    types = "".join(f'<Override PartName="/{part}" ContentType="{kind}"/>' for part, kind in kinds)
    made = {
        "[Content_Types].xml": f'{XML}<Types xmlns="{PACKAGE}/content-types"><Default Extension="rels" '
                               f'ContentType="application/vnd.openxmlformats-package.relationships+xml"/>{types}</Types>',
        "_rels/.rels": relations(("officeDocument", "xl/workbook.xml")),
        "xl/workbook.xml": f'{XML}<workbook xmlns="{MAIN}" xmlns:r="{RELATIONS}"><sheets>{listed}</sheets>'
                           f'<definedNames>{defined}</definedNames><calcPr fullCalcOnLoad="1"/></workbook>',
        "xl/_rels/workbook.xml.rels": relations(*[("worksheet", f"worksheets/sheet{i}.xml") for i in (1, 2, 3)],
                                                ("styles", "styles.xml")),
        "xl/styles.xml": STYLES,
        "xl/worksheets/_rels/sheet1.xml.rels": relations(("drawing", "../drawings/drawing1.xml")),
        "xl/drawings/drawing1.xml": drawing(),
        "xl/drawings/_rels/drawing1.xml.rels": relations(("chart", "../charts/chart1.xml")),
        "xl/charts/chart1.xml": chart(),
    }
    for i, sheet in enumerate(sheets, 1):
        made[f"xl/worksheets/sheet{i}.xml"] = sheet.xml(drawing=i == 1)
    return made


def write(path):
    """Writes the archive; entries have a fixed date."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in documents().items():
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            archive.writestr(entry, text.encode(), zipfile.ZIP_DEFLATED, 9)


def is_current(path):
    """Whether a workbook has the documents that this program writes."""
    with zipfile.ZipFile(path) as archive:
        return {name: archive.read(name).decode() for name in archive.namelist()} == documents()


if __name__ == "__main__":
    if sys.argv[1:] == ["--check"]:
        sys.exit(0 if is_current(HERE / "snapthrough.xlsx") else "clients/spreadsheet/snapthrough.xlsx is out of date")
    write(sys.argv[1] if len(sys.argv) > 1 else HERE / "snapthrough.xlsx")
