"""A package is generated anew where its model, options, templates or the program changed, and nowhere else."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import msgspec
import pytest
from support.networks import edit, resistor, run, source
from support.networks import inner_kinds as kinds
from support.networks import set_keys as configure

from urdfsync.domain import registry
from urdfsync.engine.actions import Reason


def test_a_changed_option_or_template_renders_again(project: Path) -> None:
    run()
    configure(prefix='"pin"')
    assert kinds(run()) == {"Ladder.mo": Reason.UPDATE}
    template = project / "own/element/parameters.mo.jinja"
    template.parent.mkdir(parents=True)
    template.write_text(
        "within << package >>.Elements;\nrecord << element.name >>Parameters\nend << element.name >>Parameters;\n"
    )
    configure(prefix='"pin"', templates='"own"')
    assert set(kinds(run())) == {f"Elements/{name}Parameters.mo" for name in ("C1", "C2", "R1", "R2")}
    template.with_name(".parameters.mo.jinja.swp").write_text("of an editor")
    assert run().in_step
    edit(template, "record", "record  ")
    assert set(kinds(run()).values()) == {Reason.UPDATE}
    assert run().in_step


def test_changes_are_those_since_the_last_build(project: Path) -> None:
    assert run().changes is None
    resistor(120)
    source('"C2"', '"C8"')
    changes = run().changes
    assert changes is not None
    assert dict(changes.renames) == {("element", "C2"): "C8"}
    assert ("R1", "ohm") in [change.path for change in changes.changes]
    assert (changes.generator, changes.options) == (False, ())
    configure(prefix='"pin"')
    changes = run().changes
    assert changes is not None
    assert (list(changes.changes), changes.generator, changes.options) == ([], True, ("prefix",))


def test_texts_are_compared_whatever_is_recorded(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As after a change of the program, which nobody has to announce."""
    run()
    domain = type(registry.domain("rcnetwork"))
    real = domain.artifacts

    def artifacts(self: Any, model: Any, *others: Any) -> Any:
        elements = tuple(msgspec.structs.replace(element, ohm=7) for element in model.elements)
        return real(self, msgspec.structs.replace(model, elements=elements), *others)

    monkeypatch.setattr(domain, "artifacts", artifacts)
    assert kinds(run(dry=True))["Elements/R1Parameters.mo"] is Reason.UPDATE


def test_a_recorded_model_that_this_version_can_not_generate_stops_nothing(
    project: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run()
    domain = type(registry.domain("rcnetwork"))
    real = domain.artifacts

    def artifacts(self: Any, model: Any, *others: Any) -> Any:
        if next(element.ohm for element in model.elements if element.name == "R1") == 100:
            raise KeyError("siemens")
        return real(self, model, *others)

    monkeypatch.setattr(domain, "artifacts", artifacts)
    resistor(120)
    assert kinds(run()) == {"Elements/R1Parameters.mo": Reason.UPDATE}
    assert run().in_step
