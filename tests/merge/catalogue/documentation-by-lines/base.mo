model A
  annotation (Documentation(info = "<p>a</p>
<p>b</p>
<p>c</p>
"));
end A;
