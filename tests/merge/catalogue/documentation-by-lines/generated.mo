model A
  annotation (Documentation(info = "<p>a</p>
<p>b</p>
<p>\"g\"</p>
"));
end A;
