model A
  annotation (Documentation(info = "<p>m</p>
<p>b</p>
<p>\"g\"</p>
"));
end A;
