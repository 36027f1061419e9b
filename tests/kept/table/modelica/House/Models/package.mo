within House;

package Models "Models of the elements"

  annotation (
    Documentation(info = "<html><p>Models of the elements. Every file can be edited: urdfsync keeps what you changed.</p></html>"),
    __urdfsync(id = "0d4fc4a7-c6b6", base = "4869562623ca0752"));
end Models;
