within House;

package Records "Numbers of the elements"

  annotation (
    Documentation(info = "<html><p>Numbers of the elements. Every file can be edited: urdfsync keeps what you changed.</p></html>"),
    __urdfsync(id = "0d4fc4a7-c6b6", base = "ed82e93fe0ed76ed"));
end Records;
