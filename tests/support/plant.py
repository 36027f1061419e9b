"""A package of a crane and models of a user, for tests of names."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from support.corpus import REPOSITORY
from urdfsync.analysis.checks import libraries
from urdfsync.modelica.stored import StoredClasses

MARKED_PLANT = """\
package Plant "A crane of two links"
  package Parts
    connector Pin
      Real u;
      flow Real i;
    end Pin;
    record Friction
      parameter Real damping = 0;
    end Friction;
    record Numbers
      parameter Real mass(min = 0) = 1;
      parameter ~Friction friction;
    end Numbers;
    partial model PartialPart
      replaceable parameter ~Numbers numbers;
      ~Pin pin;
    end PartialPart;
    type Shape = enumeration(round, flat);
    function twice
      input Real u;
      output Real y;
    algorithm
      y := 2*~u;
    end twice;
  end Parts;
  package Links
    record BoomNumbers = ~Parts.~Numbers(~mass = 4);
    model Boom
      extends ~Parts.~PartialPart(redeclare ~BoomNumbers ~numbers);
      parameter ~Parts.~Shape shape = ~Parts.~Shape.~round;
      Real x(~start = 0, fixed = true);
    equation
      der(~x) = ~Parts.~twice(~numbers.~mass)*~pin.~u + time;
      for k in 1:3 loop
        assert(k*~x < 1, "too far");
      end for;
    end Boom;
  end Links;
  model Crane
    parameter Real g = 9.81;
    ~Parts.~Pin boomPin;
    replaceable ~Links.~Boom boom constrainedby ~Parts.~PartialPart(~numbers(~mass = 2));
  equation
    connect(~boom.~pin, ~boomPin);
  end Crane;
  model Test
    replaceable ~Crane crane(~g = 1) constrainedby ~Crane;
  equation
    ~crane.~boomPin.~u = 0;
  end Test;
end Plant;
"""


MARKED_USER = """\
package User
  import Plant.~Parts;
  import F = Plant.~Parts.~Friction;
  import Plant.~Links.*;
  model Telescope
    extends ~Parts.~PartialPart;
    Real length = sum(step for step in {1, 2});
  end Telescope;
  model MyCrane
    extends Plant.~Crane(redeclare ~Telescope ~boom(~length(~start = 1)));
    ~Boom spare(~numbers(~friction(~damping = 3)), ~shape = ~Parts.~Shape.~flat);
    ~F friction;
  equation
    connect(~boom.~pin, ~spare.~pin);
    ~boom.~length = ~friction.~damping;
  end MyCrane;
  model MyTest
    extends Plant.~Test(redeclare ~MyCrane ~crane);
    Real way = ~crane.~boom.~length;
  end MyTest;
  model Heavy
    extends Plant.~Test(~crane(~boom(~numbers(~mass = 7))));
  end Heavy;
end User;
"""


PLANT, USER = MARKED_PLANT.replace("~", ""), MARKED_USER.replace("~", "")
"""Return a text without the marks before each use of a name."""


def classes_in(*texts: str) -> StoredClasses:
    """Classes in texts, beside a library that can't be read."""
    files = {Path(f"/nowhere/{number}.mo"): text.encode() for number, text in enumerate(texts)}
    return StoredClasses("None", Path("None"), {}, files, lambda name: Path("Gone.mo") if name == "Modelica" else None)


def library_classes(top: str) -> StoredClasses:
    """The classes of UrdfSync and of the installed libraries; skips the test without the library `top`."""
    places = [REPOSITORY / "modelica", *libraries.library_folders()]
    if libraries.find_library(top, places) is None:
        pytest.skip(f"there is no library {top}")
    return StoredClasses("None", Path("None"), {}, {}, lambda name: libraries.find_library(name, places))


def stored_below(sources: StoredClasses, name: tuple[str, ...]) -> Iterator[tuple[str, ...]]:
    yield name
    for inner in sources.names_in(name):
        yield from stored_below(sources, (*name, inner))
