model A
  annotation (Documentation(info = "<p>m</p>
<p>b</p>
<p>c</p>
"));
end A;
