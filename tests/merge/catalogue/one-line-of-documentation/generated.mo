model A
  annotation (Documentation(info = "<p>g</p>
"));
end A;
