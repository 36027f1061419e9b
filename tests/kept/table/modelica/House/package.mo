within;

package House "Made by urdfsync from the table House"

  annotation (
    uses(
      Modelica(version = "4.0.0")),
    Documentation(info = "<html><p>Made by urdfsync from the table House. Every file can be edited: urdfsync keeps what you changed.</p></html>"),
    __urdfsync(id = "0d4fc4a7-c6b6", base = "39bb3ac76511f6ce"));
end House;
