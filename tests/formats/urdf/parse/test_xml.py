"""Elements are what lxml reads of any text: tags, attributes, and the lines where start tags begin."""

from __future__ import annotations

from collections.abc import Mapping

from hypothesis import given, settings
from hypothesis import strategies as st
from lxml import etree

from urdfsync.formats.urdf.parse import xml

ESCAPES = (
    "&amp; &#38; &lt; &#x3c; &gt; &quot; &apos; &#34; &#10; &#13; &#9; &#228; &#x1F600; #38; amp; %e; ]]> --".split()
)
VALUES = st.lists(st.sampled_from([*ESCAPES, "a", "ä", " ", "\t", "\n", ">", "/"]), max_size=6).map("".join)
TAGS = st.sampled_from(["e", "p:e", "é", "e-e", "e.e"])
BETWEEN = st.sampled_from(["", "\n", "text", "<!-- <e> -->", "<![CDATA[<e>]]>", "<?e <e>?>", "&lt;e>"])


def element(tag: str, attributes: Mapping[str, str], blank: str, inside: list[str]) -> str:
    """An element of its own if there is nothing inside."""
    given = "".join(f' {name}="{value}"' for name, value in attributes.items())
    start = f"{tag}{given}{blank}"
    return f"<{start}>{''.join(inside)}</{tag}{blank}>" if inside else f"<{start}/>"


ATTRIBUTES = st.dictionaries(st.sampled_from(["a", "b", "p:a"]), VALUES, max_size=2)
BLANKS = st.sampled_from(["", " ", "\n"])
TREES = st.recursive(
    BETWEEN, lambda inner: st.builds(element, TAGS, ATTRIBUTES, BLANKS, st.lists(inner, max_size=3)), max_leaves=6
)


@settings(deadline=None)
@given(st.lists(TREES, max_size=3).map("".join))
def test_elements_are_those_that_lxml_reads(inside: str) -> None:
    before = '<!DOCTYPE r [<!-- <e> --><!ATTLIST e a NMTOKENS #IMPLIED b CDATA "default">]>\n<r xmlns:p="u">'
    text = f"{before}{inside}</r><!-- </r> -->".encode()
    document = xml.parse(text)
    assert document.warnings == []
    other = etree.fromstring(text, etree.XMLParser(resolve_entities=False))
    wanted = [
        (str(one.tag).replace("{u}", "p:"), {name.replace("{u}", "p:"): value for name, value in one.items()})
        for one in other.iter("*")
    ]
    found = [(one.tag, {k: v for k, v in one.items() if k != "xmlns:p"}) for one in document.root.iter()]
    assert found == wanted
    assert "".join(document.root.itertext()) == "".join(other.itertext("*", with_tail=True))
