"""Elements without a tree are what a tree of lxml's has: tags, attributes, and the places where they stand."""

from __future__ import annotations

from collections.abc import Mapping

from hypothesis import given, settings
from hypothesis import strategies as st
from urdfsync.urdf.reader import xml


class Collector:
    """Takes all elements in document order, with their lines in the file."""

    def root(self, root: xml.Node, namespaces: Mapping[str, str]) -> None:
        self.found = [(root.tag, dict(root.attributes), root.line)]
        self.namespaces = namespaces

    def take(self, node: xml.Node) -> None:
        assert node.child is not None
        for number, below in enumerate(node.walk()):
            assert below.number == number
            self.found.append((below.tag, dict(below.attributes), node.child.line + below.line))

    def end(self, line: int, offset: int) -> None:
        self.last = line, offset


def collected(text: str) -> Collector:
    taker = Collector()
    assert xml.parse(text, taker) == {}
    return taker


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
def test_elements_are_those_of_a_tree(inside: str) -> None:
    before = '<!DOCTYPE r [<!-- <e> --><!ATTLIST e a NMTOKENS #IMPLIED>]>\n<r xmlns:p="u">'
    text = f"{before}{inside}</r><!-- </r> -->"
    taker, wanted = collected(text), list(xml.tree(text.encode()).iter("*"))
    tags = [str(element.tag).replace("{u}", "p:") for element in wanted]
    assert [(tag, attributes) for tag, attributes, _ in taker.found] == [
        (tag, dict(element.items())) for tag, element in zip(tags, wanted, strict=True)
    ]
    assert taker.namespaces == {"p": "u"}
    assert taker.last == (text.rpartition("</r><!")[0].count("\n") + 1, text.rindex("</r><!"))


def test_lines_are_those_of_the_start_tags() -> None:
    taker = collected('<r>\n<a\n b="1"\n><b/>\n\n<c/></a><!--\n--><d/></r>')
    assert [(tag, line) for tag, _, line in taker.found] == [("r", 1), ("a", 2), ("b", 4), ("c", 6), ("d", 7)]
