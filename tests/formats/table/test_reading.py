"""Tables as they are read: the values in SI, and one finding for each fault."""

from __future__ import annotations

import datetime
import io
import json
import zipfile
from collections.abc import Callable
from typing import Any

import openpyxl
import pytest

from urdfsync.domain import Companion, Reading
from urdfsync.formats.table.model import Table, TableOptions
from urdfsync.formats.table.reading import read

HEADER = "name,mass [kg]\n"


def reading(content: str | bytes, file: str = "parts.csv", links: str = "", **options: Any) -> Reading:
    """The reading of a table, perhaps with connections in a CSV of their own."""
    companions = [Companion("connections", "links.csv", links.encode())] if links else []
    return read(content.encode() if isinstance(content, str) else content, file, TableOptions(**options), *companions)


def table(content: str | bytes, file: str = "parts.csv", links: str = "", **options: Any) -> Table:
    found = reading(content, file, links, **options)
    assert isinstance(found.snapshot, Table), list(map(str, found.diagnostics))
    return found.snapshot


def workbook(fill: Callable[[Any, Any], object]) -> bytes:
    book, content = openpyxl.Workbook(), io.BytesIO()
    fill(book.active, book)
    book.save(content)
    return content.getvalue()


def rows(*rows: list[Any]) -> bytes:
    return workbook(lambda sheet, _: [sheet.append(row) for row in rows])


@pytest.mark.parametrize(
    ("file", "content"),
    [
        ("a.csv", "name,mass [g],made\nM2,250,yes\nM1,1500,\n"),
        ("a.csv", "\ufeffname;mass [g];made\r\nM2;250;yes\r\n\r\nM1;1500;\r\n"),
        ("a.tsv", "name\tmass [g]\tmade\nM2\t2.5e2\tyes\nM1\t1500\t\n"),
        ("a.toml", '[M2]\n"mass [g]" = 250\nmade = "yes"\n[M1]\n"mass [g]" = 1500.0\n'),
        ("a.json", '{"elements": [{"name": "M2", "mass [g]": 250, "made": "yes"}, {"name": "M1", "mass [g]": 1500}]}'),
        ("a.yaml", "- {name: M2, 'mass [g]': 250, made: 'yes'}\n- {name: M1, 'mass [g]': 1500}\n"),
        ("a.xlsx", rows(["name", "mass [g]", "made"], ["M2", 250, "yes"], [], ["M1", 1500.0])),
    ],
)
def test_each_format_gives_the_same_table(file: str, content: str | bytes) -> None:
    found = table(content, file)
    assert found.elements == {"M1": {"mass": 1.5}, "M2": {"mass": 0.25, "made": "yes"}}
    assert found.columns == {"name": "text", "mass": "kg", "made": "text"}


def test_connections_have_a_list_a_sheet_or_a_file_of_their_own() -> None:
    def fill(sheet: Any, book: Any) -> None:
        for row in (["name", "mass [kg]"], ["a", 1], ["b", 2]):
            sheet.append(row)
        for row in (["from", "to", "length [mm]"], ["a", "b", 20], ["a", "b", 30]):
            other = book["Connections"] if "Connections" in book.sheetnames else book.create_sheet("Connections")
            other.append(row)

    links = "from,to,length [mm]\na,b,20\na,b,30\n"
    entries = '[{"from": "a", "to": "b", "length [mm]": 20}, {"from": "a", "to": "b", "length [mm]": 30}]'
    sources: list[tuple[str | bytes, str, str]] = [
        (HEADER + "a,1\nb,2\n", "a.csv", links),
        (f'{{"elements": {{"a": {{}}, "b": {{}}}}, "connections": {entries}}}', "a.json", ""),
        (workbook(fill), "a.xlsx", ""),
    ]
    for source in sources:
        assert table(*source).connections == {
            "a b": {"from": "a", "to": "b", "length": 0.02},
            "a b 2": {"from": "a", "to": "b", "length": 0.03},
        }


def test_types_and_units_may_stand_in_the_configuration() -> None:
    columns = {"mass": "g", "poles": "integer", "sealed": "boolean", "maker": "text"}
    found = table("name,mass,poles,sealed,maker\nM1,250,4,TRUE,12\n", columns=columns)
    assert found.elements == {"M1": {"mass": 0.25, "poles": 4, "sealed": True, "maker": "12"}}


@pytest.mark.parametrize(
    ("content", "finding"),
    [
        (HEADER + "a,1\nb,2\na,3\n", "parts.csv:4: error: the key `a` stands in line 2, too; rename one"),
        (HEADER + ",1\n", "parts.csv:2: error: the row has no key; fill its column `name`"),
        ("name,max p [m],max-p [m]\na,1,2\n", "parts.csv:1: error: columns `max p` and `max-p` have one name"),
        (HEADER + 'a,"1,5"\n', "parts.csv:2: error: column `mass`: `1,5` is no number: write 1.5"),
        (HEADER + 'a,"60,000"\n', "parts.csv:2: error: column `mass`: `60,000` is no number: write 60.000 or 6"),
        ("mass [kg],name\n1,a\n", "parts.csv:1: error: column `mass` has the unit kg: it can"),
        (HEADER + "a,1e999\n", "parts.csv:2: error: column `mass`: 1e999 is too large"),
        (HEADER + "a,1,2\n", "parts.csv:2: error: the row has 3 cells, but the header has 2"),
        ("name,mass\na,1\n", "parts.csv:1: error: column `mass` has numbers but no unit; write `mass [kg]`"),
        ("name,mass [stone age]\na,1\n", "parts.csv:1: error: column `mass`: `stone age` is no unit; write a unit"),
        ("name,n [integer]\na,2.5\n", "parts.csv:2: error: column `n`: 2.5 is no integer"),
        ("name,is [boolean]\na,yes\n", "parts.csv:2: error: column `is`: `yes` is neither true nor false"),
        ("name,mass [kg],mass [g]\na,1,2\n", "parts.csv:1: error: there are two columns `mass`; rename one"),
        ("name,\na,1\n", "parts.csv:1: error: column 2 has no name; name the column in the header"),
        (HEADER + '"a,1\n', "parts.csv:2: error: this is no CSV"),
        (HEADER.encode() + b"\xe4,1\n", "parts.csv:2: error: the file is not UTF-8; save the file as `CSV UTF-8`"),
        ("name,mass [kg],\na,1,2\n", "parts.csv:1: error: column 3 has no name"),
        ("", "parts.csv: error: the table has no rows"),
    ],
)  # fmt: skip
def test_one_finding_for_a_fault_at_its_line(content: str | bytes, finding: str) -> None:
    (found,) = reading(content).diagnostics
    assert str(found).startswith(finding)


def test_empty_last_columns_are_none() -> None:
    assert reading("name,mass [kg],,\na,1,,\nb,2,,\n").snapshot == reading(HEADER + "a,1\nb,2\n").snapshot


@pytest.mark.parametrize(
    ("cells", "finding"),
    [
        (["b", "=B2*2"], "a.xlsx:3: error: the formula in B3 has no result"),
        (["b", datetime.date(2026, 1, 5)], "a.xlsx:3: error: column `mass`: 2026-01-05 00:00:00 is a date"),
        (["b", "1,5"], "a.xlsx:3: error: column `mass`: `1,5` is no number"),
        (["b", 1, "more"], "a.xlsx:3: error: the row has 3 cells, but the header has 2"),
    ],
)  # fmt: skip
def test_cells_of_workbooks(cells: list[Any], finding: str) -> None:
    (found,) = reading(rows(["name", "mass [kg]"], ["a", 1.5], cells), "a.xlsx").diagnostics
    assert str(found).startswith(finding)


@pytest.mark.parametrize(
    ("file", "content", "words"),
    [
        ("a.yaml", "- {name: a, 'mass [kg]': 100:1}\n", "column `mass`: `100:1` is no number"),
        ("a.json", '[{"name": "a", "mass [kg]": NaN}]', "column `mass`: `nan` is no number"),
        ("a.toml", '[a]\n"mass [kg]" = inf\n', "column `mass`: `inf` is no number"),
        ("a.json", '[{"name": "a\\ud800", "mass [kg]": 1}]', "column `name`: 'utf-8' codec can't encode"),
    ],
)
def test_numbers_and_texts_that_only_some_formats_have(file: str, content: str, words: str) -> None:
    assert words in str(reading(content, file).diagnostics[0])


def test_a_fault_in_a_connection_is_at_its_line() -> None:
    links = '{"from": "a", "to": "b"},\n{"from": "a", "to": "c"}'
    source = f'{{"elements": [\n{{"name": "a"}},\n{{"name": "b"}}],\n"connections": [\n{links}]}}'
    assert str(reading(source, "a.json").diagnostics[0]).startswith("a.json:6: error: there is no element `c`")


def test_numbers_in_yaml_are_decimal() -> None:
    assert table("- {name: a, 'mass [kg]': 010}\n", "a.yaml").elements == {"a": {"mass": 10.0}}


def test_merged_cells_are_refused() -> None:
    def fill(sheet: Any, _: Any) -> None:
        sheet.append(["name", "mass [kg]"])
        sheet.merge_cells("A2:B2")

    assert "sheet `Sheet` has merged cells: A2:B2" in str(reading(workbook(fill), "a.xlsx").diagnostics[0])


@pytest.mark.parametrize(
    ("content", "file", "words"),
    [
        ("a: [", "a.yaml", "this is no YAML"),
        ("a = ", "a.toml", "this is no TOML"),
        ("{", "a.json", "this is no JSON"),
        ("[1, 2]", "a.json", "neither a list nor a table of entries"),
        ('{"elements": [], "x": 1}', "a.json", "`x` is unknown"),
        ('{"a": {}, "a": {}}', "a.json", "the key `a` stands there twice"),
        ("a: {}\na: {}\n", "a.yaml", "the key `a` stands there twice"),
        ("? [a]\n: {}\n", "a.yaml", "this is no YAML"),
        ("a: &a [1]\nb: {m: [*a, *a]}\n", "a.yaml", "neither a list nor a table of entries"),
        ("b: {m: [1, 2]}\n", "a.yaml", "column `m`: a cell can't be a list or a table"),
        ("b: {'m [kg]': [1, 2]}\n", "a.yaml", "column `m`: a cell can't be a list or a table"),
        (b"PK", "a.xlsx", "this is no workbook"),
        (b"PK", "a.ods", "`.ods` is no format of tables"),
    ],
)
def test_files_that_are_no_tables(content: str | bytes, file: str, words: str) -> None:
    (found,) = reading(content, file).diagnostics
    assert (found.file, words in found.message) == (file, True)


@pytest.mark.parametrize(
    ("links", "words"),
    [
        ("from,to\na,c\n", "links.csv:2: error: there is no element `c`"),
        ("x,y\na,a\n", "links.csv: error: the connections have no column `from`"),
        ("from,to,from\na,a,a\n", "links.csv:1: error: there are two columns `from`"),
    ],
)
def test_connections_name_elements(links: str, words: str) -> None:
    assert words in str(reading(HEADER + "a,1\n", links=links).diagnostics[0])


@pytest.mark.parametrize(
    ("content", "mass"),
    [
        ("name;mass [kg];note\na;1,5;2,5 mm\n", 1.5),
        ("name;mass, net [kg];note\na;-1,5E-3;x,y\n", -0.0015),
        ('"name";"mass [kg]";"note"\n"a";"0,125";"x"\n', 0.125),
        ("name\tmass [kg]\tnote\na\t12,5\tx\n", 12.5),
        ("name;mass [kg];note\na;1.5;x\n", 1.5),
        ("name;mass [kg];note\na;1,234;x\nb;0,5;x\n", 1.234),
        ("name;mass [kg];note\na;1.234;x\nb;0.5;x\n", 1.234),
        ("name;mass [kg];note\na;1234;x\n", 1234),
        ('name,"mass; net [kg]",note\na,1.234,x\n', 1.234),
        ("sep=;\nname;mass [kg];note\na;1,5;x\n", 1.5),
        ("\ufeffSEP=,\r\nname,mass [kg],note\r\na,1.5,x;y\r\n", 1.5),
        ("sep=\t\nname\tmass [kg]\tnote\na\t1,5\tx;y\n", 1.5),
    ],
)
def test_numbers_of_european_and_english_files(content: str, mass: float) -> None:
    found = table(content)
    assert next(iter(found.elements["a"].values())) == mass
    assert found.columns["note"] == "text"


@pytest.mark.parametrize(
    ("content", "finding"),
    [
        ("a;1.234,5\n", "2: error: `1.234,5` has more than one mark; write no marks of thousands"),
        ("a;1,234,567\n", "2: error: `1,234,567` has more than one mark; write no marks of thousands"),
        ("a;1,234\n", "2: error: `1,234` may mean 1.234 or 1234; write 1,2340 or 1234"),
        ("a;12\nb;1.234\n", "3: error: `1.234` may mean 1.234 or 1234; write 1.2340 or 1234"),
        ("a;1.5\nb;0,5\n", "3: error: `0,5` has a comma, but `1.5` in line 2 has a point; write one decimal mark"),
        ("a;1 234,5\n", "2: error: column `mass`: `1 234,5` is no number"),
        ("a;1'234\n", "2: error: column `mass`: `1'234` is no number"),
    ],
)
def test_a_number_is_never_read_by_another_mark(content: str, finding: str) -> None:
    (found,) = reading(f"name;mass [kg]\n{content}").diagnostics
    assert str(found).startswith(f"parts.csv:{finding}")


def test_a_line_that_tells_excel_the_separator_counts_as_a_line() -> None:
    (found,) = reading("sep=;\nname;mass [kg]\na;x\n").diagnostics
    assert str(found).startswith("parts.csv:3: error: column `mass`: `x` is no number")


def test_numbers_without_a_unit_are_told_with_commas_too() -> None:
    (found,) = reading("name;mass\na;1,5\n").diagnostics
    assert "column `mass` has numbers but no unit" in found.message


def test_an_equal_connection_is_told_with_the_line_of_the_other() -> None:
    links = "from,to,length [m]\na,a,1\na,a,2\na,a,1\n"
    found = reading(HEADER + "a,1\n", links=links)
    (finding,) = found.diagnostics
    assert str(finding).startswith("links.csv:4: warning: the connection `a a` stands in line 2, too; delete one")
    assert len(found.snapshot.connections) == 3


@pytest.mark.parametrize(
    ("options", "option"), [({"key": "id"}, "key"), ({"kind": "Mass"}, "kind"), ({"columns": {"m": "kg"}}, "columns")]
)
def test_options_name_columns(options: dict[str, Any], option: str) -> None:
    ((found, finding),) = reading(HEADER + "a,1\n", **options).option_findings
    assert (found, "there is no column" in finding.message) == (option, True)


def test_a_unit_of_another_kind_is_refused() -> None:
    (found,) = reading(HEADER + "a,1\n", columns={"mass": "N"}).diagnostics
    assert "column `mass` is in kg, but the configuration says N" in found.message


def test_a_kind_names_a_template() -> None:
    (found,) = reading("name,kind\na,../x\n", kind="kind").diagnostics
    assert "the kind `../x` of `a` can't be a template" in found.message


def test_elements_under_keys_may_have_a_column_name() -> None:
    assert table("[M1]\nname = 'Motor one'\n", "a.toml").elements == {"M1": {"name": "Motor one"}}


def test_a_large_workbook_is_refused() -> None:
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("xl/workbook.xml", b"0" * 20_000_001)
    assert "more than 20,000,000 bytes" in str(reading(content.getvalue(), "a.xlsx").diagnostics[0])


# --- small files that would take long ---------------------------------------------------------------------------------


def replaced(content: bytes, old: str, new: str) -> bytes:
    """A workbook with another text in its first sheet; openpyxl can't write each workbook that it reads."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    files["xl/worksheets/sheet1.xml"] = files["xl/worksheets/sheet1.xml"].replace(old.encode(), new.encode())
    changed = io.BytesIO()
    with zipfile.ZipFile(changed, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in files.items():
            archive.writestr(name, text)
    return changed.getvalue()


PARTS = rows(["name", "mass [kg]"], ["a", 1])
LAST = '<row r="1048576"><c r="XFD1048576"><v>1</v></c></row></sheetData>'


@pytest.mark.slow
def test_of_a_workbook_only_cells_that_exist_are_read() -> None:
    """A cell in the last corner made openpyxl fill 17 billion cells, a merged range or a link of the sheet as well."""
    found = reading(replaced(PARTS, "</sheetData>", LAST), "a.xlsx").diagnostics
    assert [str(each).partition(";")[0] for each in found] == [
        "a.xlsx:1048576: error: the row has 16384 cells, but the header has 2"
    ]
    merged = replaced(PARTS, "</sheetData>", '</sheetData><mergeCells><mergeCell ref="A1:XFD1048576"/></mergeCells>')
    assert "has merged cells: A1:XFD1048576" in str(reading(merged, "a.xlsx").diagnostics[0])
    linked = '</sheetData><hyperlinks><hyperlink ref="A1:XFD1048576" location="A1"/></hyperlinks>'
    for harmless in (linked, "</sheetData>"):
        same = replaced(replaced(PARTS, "A1:B2", "A1:XFD1048576"), "</sheetData>", harmless)
        assert table(same, "a.xlsx").elements == {"a": {"mass": 1.0}}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("content", "file"),
    [
        (replaced(PARTS, "</sheetData>", '<row r="99999999999"><c><v>1</v></c></row></sheetData>'), "a.xlsx"),
        (
            replaced(
                PARTS,
                "</sheetData>",
                "".join(f'<row r="{r}"><c r="XFD{r}"/></row>' for r in range(3, 400)) + "</sheetData>",
            ),
            "a.xlsx",
        ),
        (json.dumps([{f"column{number}": "a"} for number in range(3000)]), "a.json"),
    ],
    ids=["a row far outside", "wide rows", "a column for each element"],
)
def test_a_table_has_a_greatest_number_of_cells(content: bytes | str, file: str) -> None:
    assert "more than 5,000,000 cells" in str(reading(content, file).diagnostics[0])


@pytest.mark.slow
def test_the_places_of_escaped_names_are_not_searched_for_ever() -> None:
    """Names with escaped letters are not found as written; the lines of later entries are those of entries before."""
    names = [f"Stück {number}" for number in range(60_000)]
    found = reading(json.dumps({name: {"m [kg]": 1} for name in names}, indent=0), "a.json")
    assert isinstance(found.snapshot, Table)
    assert len(found.snapshot.elements) == 60_000


def test_many_equal_connections_are_numbered_at_once() -> None:
    found = table(HEADER + "a,1\n", links="from,to\n" + 20_000 * "a,a\n")
    assert [*found.connections][-1] == "a a 20000"
    assert len(found.connections) == 20_000


@pytest.mark.parametrize(("header", "words"), [
    ("mass [" + " " * 6_000 + "x", "has numbers but no unit"),
    ("mass" + " " * 120_000 + "[kg", "has numbers but no unit"),
    ("mass [" + "k" * 110_000 + "]", "is no unit"),
    ("mass [" + "kg." * 40_000 + "]", "is no unit"),
])  # fmt: skip
def test_a_header_that_is_no_name_and_unit_takes_no_time(header: str, words: str) -> None:
    (found,) = reading(f"name,{header}\na,1\n").diagnostics
    assert words in found.message


@pytest.mark.slow
def test_only_the_first_unknown_names_get_hints() -> None:
    links = "".join(f"part{number},parts{number}x\n" for number in range(3000))
    parts = "".join(f"part{number},1\n" for number in range(3000))
    found = reading(HEADER + parts, links=f"from,to\n{links}").diagnostics
    assert len(found) == 3000
    assert sum("did you mean" in finding.hint for finding in found) == 20


@pytest.mark.parametrize("curve", [
    "c 1500 250\nc 0 100\nc 3000 400\n",  # wntr takes a logarithm of a negative number
    "c 0 100\nc 1 200\nc 2 300\n",  # wntr has a message of its own
    "c 0 100\nc 1 100\nc 2 100\n",  # wntr divides by zero
])  # fmt: skip
def test_a_pump_curve_that_does_not_fall_is_one_error_of_the_source(curve: str) -> None:
    """Such a curve has no coefficients, since its head has to fall as the flow rises."""
    pytest.importorskip("wntr", reason="wntr is not installed")
    network = "[RESERVOIRS]\na 1\n[JUNCTIONS]\nb 0 1\n[PUMPS]\np a b HEAD c\n[CURVES]\n{}[OPTIONS]\nUnits LPS\n[END]\n"
    (found,) = reading(network.format(curve), "town.inp").diagnostics
    assert found.code == "table-file"
    assert "the curve of pump `p` is no head that falls with the flow" in found.message
