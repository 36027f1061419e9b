model A
  annotation (Documentation(info = "<p>m</p>
"));
end A;
